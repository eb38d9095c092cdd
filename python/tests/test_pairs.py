"""Pairs by index: the answers of one by one, steps as those of a mesh, and what is refused."""

import dataclasses

import numpy as np
import pytest

import tunnelproof
from test_mesh import all_pairs, soup
from tunnelproof import Blocked

RANDOM = np.random.default_rng(3)
START = RANDOM.uniform(-1, 1, (60, 3))
END = RANDOM.uniform(-1, 1, (60, 3))
# More than a thread takes at a time.
INDICES = RANDOM.integers(0, 60, (9000, 4))


def rows(hits, which):
    """The columns of some hits."""
    for field in dataclasses.fields(hits):
        column = getattr(hits, field.name)
        if field.name in ("first", "second"):
            yield from (column.weights[which], column.point[which])
        else:
            yield column[which]


@pytest.mark.parametrize("kind", ["edge-edge", "vertex-face"])
@pytest.mark.parametrize("radius", [0.0, 0.05, "each", "sums"])
def test_pairs_are_decided_as_queries(kind, radius):
    if radius == "each":
        radius = RANDOM.uniform(0, 0.1, len(INDICES))
    elif radius == "sums":
        radius = RANDOM.uniform(0, 0.1, (len(INDICES), 2))
    points = np.concatenate([START[INDICES], END[INDICES]], axis=1)
    expected = tunnelproof.decide(kind, points, radius)
    pairs, hits = tunnelproof.decide_pairs(kind, START, END, INDICES, radius)
    assert (pairs == expected.hit.nonzero()[0]).all() and 100 < len(pairs) < 9000
    for found, column in zip(rows(hits, slice(None)), rows(expected, pairs)):
        assert np.array_equal(found, column)


@pytest.mark.parametrize("kind", ["edge-edge", "vertex-face"])
def test_positions_in_float32_are_decided_as_they_are(kind):
    start, end = START.astype(np.float32), END.astype(np.float32)
    pairs, hits = tunnelproof.decide_pairs(kind, start, end, INDICES, 0.05)
    double = [start.astype(np.float64), end.astype(np.float64)]
    expected, same = tunnelproof.decide_pairs(kind, *double, INDICES, 0.05)
    assert np.array_equal(pairs, expected) and len(pairs) > 100
    for found, column in zip(rows(hits, slice(None)), rows(same, slice(None))):
        assert np.array_equal(found, column)
    # Of one float32 and one float64 both are float64.
    expected, _ = tunnelproof.decide_pairs(kind, double[0], END, INDICES, 0.05)
    pairs, _ = tunnelproof.decide_pairs(kind, start, END, INDICES, 0.05)
    assert np.array_equal(pairs, expected)


def test_there_may_be_no_pairs():
    for indices in ([], np.zeros((0, 4), int)):
        for radius in (0.0, 0.1, []):
            pairs, hits = tunnelproof.decide_pairs("edge-edge", START, END, indices, radius)
            assert pairs.shape == (0,) and hits.toi.shape == (0,)


def test_positions_may_lie_in_any_order():
    expected, _ = tunnelproof.decide_pairs("edge-edge", START, END, INDICES)
    for change in (np.asfortranarray, lambda x: np.repeat(x, 2, axis=0)[::2], list):
        pairs, _ = tunnelproof.decide_pairs("edge-edge", change(START), change(END), INDICES)
        assert np.array_equal(pairs, expected)


@pytest.mark.parametrize(
    "change, message",
    [
        ({"kind": "faces"}, "kind is"),
        ({"start": START[:5]}, "end has 60 entries, and start has 5"),
        ({"end": np.full((60, 3), np.nan)}, r"end\[0\]\[0\] is NaN"),
        ({"start": START.T}, r"start has the shape \(3, 60\)"),
        ({"start": START + 1j}, "start: complex128 is no type of real numbers"),
        ({"indices": [[0, 1, 2, 60]]}, "pair 0: point D is position 60, and there are 60, counted from 0"),
        ({"indices": [[0, 1, 2, -1]]}, r"indices\[0\]\[3\] is -1"),
        ({"indices": [[0.0, 1, 2, 3]]}, "indices are of type float64"),
        ({"indices": [[0, 1, 2]]}, r"indices have the shape \(1, 3\)"),
        ({"radius": -1.0}, "radius"),
        ({"radius": [0.0, -1.0]}, "pair 1: .*-1"),
        ({"radius": [0.0, 1.0, 2.0]}, r"radius has the shape \(3,\)"),
    ],
)
def test_what_is_no_pair_is_named(change, message):
    asked = {"kind": "edge-edge", "start": START, "end": END, "indices": INDICES[:2], "radius": 0.0}
    with pytest.raises(ValueError, match=message):
        tunnelproof.decide_pairs(**asked | change)


@pytest.mark.parametrize("precision", ["f64", "f32"])
@pytest.mark.parametrize("settings", [{}, {"clearance": 0.01}, {"clearance": 0.5}, {"share": 0.2}])
@pytest.mark.parametrize("seed", range(10))
def test_a_step_of_all_pairs_of_a_mesh_is_that_of_the_mesh(seed, settings, precision):
    mesh, start, end = soup(seed, integers=seed == 9)
    start = start.astype(np.float32)
    listed = all_pairs(mesh)
    radius = 0.0 if seed % 2 else 0.02
    of_mesh = mesh.step(start, end, radius, **settings, precision=precision)
    moved = tunnelproof.advance_pairs(
        start,
        end,
        listed["edge-edge"],
        listed["vertex-face"],
        edge_radius=radius,
        face_radius=np.full(len(listed["vertex-face"]), radius),
        **settings,
        precision=precision,
    )
    assert moved.step == of_mesh.step and np.array_equal(moved.positions, of_mesh.positions)
    assert moved.positions.dtype == (np.float32 if precision == "f32" else np.float64)
    for found, expected in [(moved.limits, of_mesh.limits), (moved.near, of_mesh.near)]:
        vertices = [listed[kind][index] for kind, index in zip(found.kind, found.index)]
        assert vertices == expected.vertices.tolist() and len(found) == len(expected)
    assert np.array_equal(moved.limits.blocked, of_mesh.limits.blocked)
    assert np.array_equal(moved.near.kept, of_mesh.near.kept)
    assert (moved.step == 1) == (len(moved.limits) == 0)


@pytest.mark.parametrize("precision", ["f64", "f32"])
@pytest.mark.parametrize("settings", [{}, {"clearance": 0.01}, {"share": 0.5}])
@pytest.mark.parametrize("kind", ["edge-edge", "vertex-face"])
def test_a_step_of_one_pair_is_that_of_the_query(kind, settings, precision):
    family = "thick_uniform" if kind == "edge-edge" else "thick_face_uniform"
    points, radii = tunnelproof.queries(family, 200, seed=7)
    points[:, :4] = points[:, :4].astype(np.float32)
    expected = tunnelproof.advance(kind, points, radii, **settings, precision=precision)
    name, other = ("edge", "face") if kind == "edge-edge" else ("face", "edge")
    for i in range(200):
        lists = {f"{name}s": [[0, 1, 2, 3]], f"{other}s": [], f"{name}_radius": radii[i : i + 1]}
        moved = tunnelproof.advance_pairs(
            points[i, :4], points[i, 4:], **lists, **settings, precision=precision
        )
        assert moved.step == expected.step[i]
        assert np.array_equal(moved.positions, expected.points[i])
        assert moved.limits.blocked.tolist() == [code for code in expected.blocked[i : i + 1] if code]
        assert moved.limits.kind.tolist() == [kind] * len(moved.limits)


def test_a_step_names_what_ends_it_and_what_is_near():
    start = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, 0.5], [0, 5, 0], [1, 5, 0]])
    end = start.copy()
    end[3, 2] = -0.5
    ask = lambda **settings: tunnelproof.advance_pairs(start, end, [[0, 1, 4, 5]], [[3, 0, 1, 2]], **settings)
    moved = ask(face_radius=0.25)
    assert moved.limits.kind.tolist() == ["vertex-face"] and moved.limits.index.tolist() == [0]
    assert moved.limits.blocked.tolist() == [Blocked.AHEAD] and len(moved.near) == 0
    assert 0.2499 < moved.step <= 0.25 and moved.positions.shape == (6, 3)
    moved = ask(edge_radius=[0.1], face_radius=[[0.5, 0.5]])
    assert moved.near.kind.tolist() == ["vertex-face"] and moved.near.index.tolist() == [0]
    assert moved.positions[3, 2] > 0.4499 and abs(moved.near.kept.sum() - 0.45) < 1e-12
    assert "vertex-face" in moved._repr_html_() and "start nearer" in moved._repr_html_()
    start[3, 2] = 0
    moved = ask()
    assert moved.step == 0 and moved.limits.blocked.tolist() == [Blocked.TOUCHING]
    assert np.array_equal(moved.positions, start)
    nothing = tunnelproof.advance_pairs(np.zeros((0, 3)), np.zeros((0, 3)), [], [])
    assert nothing.step == 1 and nothing.positions.shape == (0, 3) and len(nothing.limits) == 0


@pytest.mark.parametrize(
    "change, message",
    [
        ({"start": START[:5]}, "^end has 60 entries, and start has 5"),
        ({"end": np.full((60, 3), np.nan)}, r"^end\[0\]\[0\] is NaN"),
        ({"start": START.T}, r"start has the shape \(3, 60\)"),
        ({"edges": [[0, 1, 2, 60]]}, "edges: pair 0: point D is position 60, and there are 60"),
        ({"faces": [[0, 1, 2, 3], [60, 1, 2, 0]]}, "faces: pair 1: point A is position 60"),
        ({"faces": [[0, 1, 2, -1]]}, r"faces\[0\]\[3\] is -1"),
        ({"edges": [[0, 1]]}, r"edges have the shape \(1, 2\), not \(n, 4\)"),
        ({"edge_radius": -1.0}, "edges: .*-1"),
        ({"face_radius": [0.0, -1.0]}, "faces: pair 1: .*-1"),
        ({"face_radius": [0.0]}, r"face_radius has the shape \(1,\)"),
        ({"edge_radius": "thin"}, "edge_radius: .* is no type of real numbers"),
        ({"clearance": -1.0}, "the clearance is -1"),
        ({"share": 1.0}, "the share is 1"),
        ({"clearance": 0.1, "share": 0.5}, "give one of them"),
        ({"precision": "f16"}, 'precision is "f16"'),
    ],
)
def test_what_is_no_step_is_named(change, message):
    asked = {"start": START, "end": END, "edges": INDICES[:2], "faces": INDICES[:2]}
    with pytest.raises(ValueError, match=message):
        tunnelproof.advance_pairs(**asked | change)
