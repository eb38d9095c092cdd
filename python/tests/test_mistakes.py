"""What cannot be asked is refused in words, and what takes long can be ended."""

import signal
import threading
import time

import numpy as np
import pytest

import tunnelproof

POINTS, RADII = tunnelproof.queries("uniform", 4)
WIRE = [[[1, 1, -1], [1, 1, 1], [1, 1, -1], [1, 1, 1]]]
POSES = [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 1]]


@pytest.mark.parametrize("name", ["count", "seed", "start"])
def test_a_number_below_0_counts_nothing(name):
    numbers = {"count": 1, name: -1}
    with pytest.raises(ValueError, match=f"{name} is -1, not a number from 0"):
        tunnelproof.queries("uniform", **numbers)


def test_more_queries_than_there_is_memory_for_are_refused():
    for count in (2**57, 2**63, 2**64 - 1):
        with pytest.raises(MemoryError, match=f"no memory for {count} queries"):
            tunnelproof.queries("uniform", count)
    with pytest.raises(ValueError, match="count is"):
        tunnelproof.queries("uniform", 2**64)
    with pytest.raises(ValueError, match="below 2"):
        tunnelproof.queries("uniform", 3, start=2**64 - 2)
    points, radii = tunnelproof.queries("uniform", 0)
    assert points.shape == (0, 8, 3) and radii.shape == (0, 2)
    points, _ = tunnelproof.queries("uniform", 2500, start=2**60)
    assert (points[2499] == tunnelproof.queries("uniform", 1, start=2**60 + 2499)[0][0]).all()


def test_numbers_of_certifications_are_checked():
    def right(kind, points, radii):
        hits = tunnelproof.decide(kind, points, radii)
        return hits.hit, hits.toi

    for name in ("count", "seed"):
        with pytest.raises(ValueError, match=f"{name} is -1"):
            tunnelproof.certify(right, families=["uniform"], **{name: -1})
    with pytest.raises(ValueError, match="shard is -1"):
        tunnelproof.certify(right, families=["uniform"], shard=(-1, 2))
    with pytest.raises(ValueError, match="calls is -1"):
        tunnelproof.shrink("lattice:1:4", right, calls=-1)


@pytest.mark.parametrize("wrong", [lambda x: np.asarray(x) + 1j, lambda x: np.asarray(x).astype(str)])
def test_what_are_no_real_numbers_is_refused(wrong):
    mesh = tunnelproof.Mesh(faces=[[0, 1, 2]], vertex_count=4)
    places = np.zeros((4, 3))
    asked = [
        ("points", lambda: tunnelproof.decide("edge-edge", wrong(POINTS))),
        ("radius", lambda: tunnelproof.decide("edge-edge", POINTS, wrong(RADII))),
        ("points", lambda: tunnelproof.exact("edge-edge", wrong(POINTS))),
        ("points", lambda: tunnelproof.gap("edge-edge", wrong(POINTS))),
        ("points", lambda: tunnelproof.advance("edge-edge", wrong(POINTS))),
        ("points", lambda: tunnelproof.Query("edge-edge", wrong(POINTS[0]))),
        ("radius", lambda: tunnelproof.Query("edge-edge", POINTS[0], wrong(1.0))),
        ("local", lambda: tunnelproof.decide_rigid("edge-turning-edge", WIRE, wrong(np.ones((1, 2, 3))), POSES)),
        ("poses", lambda: tunnelproof.decide_rigid("edge-turning-edge", WIRE, np.ones((1, 2, 3)), wrong(POSES))),
        ("start", lambda: mesh.first_contact(wrong(places), places)),
        ("thickness", lambda: mesh.first_contact(places, places, wrong(0.1))),
    ]
    for name, ask in asked:
        with pytest.raises(ValueError, match=f"{name}: .* is no type of real numbers"):
            ask()


def test_other_real_numbers_are_taken():
    expected = tunnelproof.decide("edge-edge", np.round(8 * POINTS)).toi
    for dtype in (np.int32, np.float32, object):
        found = tunnelproof.decide("edge-edge", np.round(8 * POINTS).astype(dtype)).toi
        assert np.array_equal(found, expected, equal_nan=True)


def hard(count):
    """Queries that take milliseconds each: a subnormal radius beside coordinates near 1."""
    points, _ = tunnelproof.queries("thick_lattice", 50)
    return "edge-edge", np.tile(points, (count // 50, 1, 1)), 5e-324


def slow(kind, points, radii):
    time.sleep(0.01)
    return np.zeros(len(points), bool), np.zeros(len(points))


@pytest.mark.parametrize(
    "work",
    [
        pytest.param(lambda: tunnelproof.exact(*hard(400_000)), id="exact"),
        pytest.param(lambda: tunnelproof.decide(*hard(400_000)), id="decide"),
        pytest.param(lambda: tunnelproof.advance(*hard(400_000)), id="advance"),
        pytest.param(lambda: tunnelproof.gap(*hard(400_000)), id="gap"),
        pytest.param(lambda: tunnelproof.queries("thick_lattice", 20_000_000), id="queries"),
        pytest.param(lambda: tunnelproof.shrink("uniform:1:9", slow, calls=100_000), id="shrink"),
    ],
)
def test_ctrl_c_ends_what_takes_long(work):
    sent = []

    def send():
        sent.append(time.monotonic())
        signal.raise_signal(signal.SIGINT)

    timer = threading.Timer(1.0, send)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
        assert time.monotonic() - sent[0] < 3.0
    finally:
        timer.cancel()


def test_a_signal_after_which_it_goes_on_changes_no_answer():
    seen = []
    before = signal.signal(signal.SIGALRM, lambda *_: seen.append(1))
    try:
        kind, points, radius = hard(2_000)
        signal.setitimer(signal.ITIMER_REAL, 0.05, 0.05)
        found = tunnelproof.exact(kind, points, radius)
        signal.setitimer(signal.ITIMER_REAL, 0)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert seen
    few = [tunnelproof.exact(kind, points[k : k + 1], radius) for k in range(50)]
    assert np.array_equal(found.toi[:50], np.concatenate([one.toi for one in few]), equal_nan=True)
    assert np.array_equal(found.toi, np.tile(found.toi[:50], (40, 1)), equal_nan=True)
