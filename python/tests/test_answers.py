"""The certified path against the oracle, shapes, and what is refused."""

import threading
import time

import numpy as np
import pytest

import tunnelproof

FALLING = np.array(
    [
        [[-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1]],
        [[-1, 0, 0], [1, 0, 0], [0.5, -1, -3], [0.5, 1, -3]],
    ],
    dtype=float,
).reshape(1, 8, 3)


def test_edge_edge_of_two_that_cross_is_exact():
    contacts = tunnelproof.edge_edge(FALLING)
    assert contacts.hit.tolist() == [True]
    assert contacts.toi.tolist() == contacts.toi_above.tolist() == [0.25]
    assert contacts.first.tolist() == [[0.75, 0.5]]
    assert np.isnan(contacts.second).all() and contacts.second.shape == (1, 2)
    assert contacts.crosses.tolist() == [True]
    assert contacts.side.tolist() == [1]


def test_radius_is_taken_in_every_shape_and_as_an_exact_sum():
    for radius in [0.5, [0.5], [[0.25, 0.25]], np.float32(0.5)]:
        assert tunnelproof.edge_edge(FALLING, radius).toi.tolist() == [0.125]
    # The step starts at a distance of 0.1 + 0.2, rounded up, which the two radii do not reach.
    still = FALLING.copy()
    still[:, [2, 3, 6, 7], 2] = 0.1 + 0.2
    assert tunnelproof.edge_edge(still, [[0.1, 0.2]]).hit.tolist() == [False]
    assert tunnelproof.edge_edge(still, 0.1 + 0.2).hit.tolist() == [True]


@pytest.mark.parametrize("family", tunnelproof.families(), ids=lambda family: family.name)
def test_certified_path_is_what_the_oracle_says(family):
    points, radii = tunnelproof.queries(family.name, 500, seed=5)
    exact = tunnelproof.exact(points, radii, family.kind)
    if family.kind == "edge-edge":
        found = tunnelproof.edge_edge(points, radii)
        u, v = found.first.T
        error = found.parameter_error
    else:
        found = tunnelproof.vertex_face(points, radii)
        _, u, v = found.weights.T
        error = found.weight_error
    assert (found.hit == exact.hit).all()
    toi = np.stack([found.toi, found.toi_above], axis=1)
    assert np.array_equal(toi, exact.toi, equal_nan=True)
    assert (found.crosses == exact.is_crossing).all()
    assert (found.side == exact.side).all()
    for value, enclosure in [(u, exact.u), (v, exact.v)]:
        near = (value >= enclosure[:, 0] - error) & (value <= enclosure[:, 1] + error)
        assert near[exact.hit].all()
    assert exact.hit.any()


def test_queries_are_the_same_every_time_and_continue():
    points, radii = tunnelproof.queries("thick_uniform", 10, seed=3)
    assert points.shape == (10, 8, 3) and radii.shape == (10, 2)
    rest, _ = tunnelproof.queries("thick_uniform", 4, seed=3, start=6)
    assert np.array_equal(points[6:], rest)


def test_no_queries_have_no_answers():
    contacts = tunnelproof.edge_edge(np.zeros((0, 8, 3)))
    assert contacts.hit.shape == (0,) and contacts.first.shape == (0, 2)


def test_what_is_no_query_is_named():
    bad = np.concatenate([FALLING, FALLING])
    bad[1, 6, 2] = np.nan
    with pytest.raises(ValueError, match="query 1: .*NaN"):
        tunnelproof.edge_edge(bad)
    with pytest.raises(ValueError, match="query 0: radius is -1"):
        tunnelproof.vertex_face(FALLING, -1)
    with pytest.raises(ValueError, match=r"points have the shape \(8, 3\), not \(n, 8, 3\)"):
        tunnelproof.edge_edge(FALLING[0])
    with pytest.raises(ValueError, match=r"radius has the shape \(3,\)"):
        tunnelproof.exact(FALLING, [1, 2, 3])
    with pytest.raises(ValueError, match="kind is \"edges\""):
        tunnelproof.exact(FALLING, kind="edges")
    with pytest.raises(ValueError, match="there is no family \"none\""):
        tunnelproof.queries("none", 1)


def test_other_threads_run_meanwhile():
    points, radii = tunnelproof.queries("uniform", 20_000)
    done = threading.Event()
    ticks = 0

    def work():
        for _ in range(3):
            tunnelproof.exact(points, radii)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        ticks += 1
        time.sleep(0.001)
    thread.join()
    assert ticks > 5
