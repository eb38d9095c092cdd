"""Bodies that turn: against the oracle as the command line asks it, known answers, and what is refused."""

import json
import math
import os
import subprocess
from fractions import Fraction

import numpy as np
import pytest

import tunnelproof

PROGRAM = os.environ.get("TUNNELPROOF_PROGRAM")

STILL = [0, 0, 0, 1, 0, 0, 0]
WIRE = [[1, 1, -1], [1, 1, 1]]
ROD = [[0, 0, 0], [2, 0, 0]]
QUARTER = [STILL, [0, 0, 0, 1, 0, 0, 1]]


def drawn(kind, count, seed, lattice):
    """Queries in random numbers, or in small integers, in which degenerate ones are frequent."""
    rng = np.random.default_rng(seed)
    world = 2 if kind == "edge-turning-edge" else 1

    def numbers(*shape):
        if lattice:
            return rng.integers(-2, 3, shape).astype(float)
        return rng.uniform(-1, 1, shape)

    points, local = numbers(count, 2 * world, 3), numbers(count, 4 - world, 3)
    poses = numbers(count, 2, 7)
    poses[:, :, :3] /= 2
    axis = poses[:, 0, 3:]
    axis[(axis == 0).all(axis=1)] = 1
    # Not far from the start, either sign.
    poses[:, 1, 3:] = 2 * axis + poses[:, 1, 3:] / 2
    poses[:, 1, 3:] *= rng.choice([1, -1], (count, 1))
    radii = np.where(rng.random((count, 2)) < 0.5, 0, rng.integers(0, 3, (count, 2)) / 8)
    degrees = 2 * np.degrees(np.arccos(cosine(poses)))
    taken = degrees < 89.9
    return points[taken], local[taken], poses[taken], radii[taken]


def cosine(poses):
    q0, q1 = poses[:, 0, 3:], poses[:, 1, 3:]
    lengths = np.linalg.norm(q0, axis=1) * np.linalg.norm(q1, axis=1)
    return np.abs((q0 * q1).sum(axis=1)).clip(0, lengths) / lengths


def asked(kind, queries, tmp_path):
    """What the oracle says by the command line."""
    path = tmp_path / "queries.jsonl"
    rows = zip(*(array.tolist() for array in queries))
    lines = [
        json.dumps(dict(zip(("points", "local", "poses", "radius"), row), kind=kind, id=str(index)))
        for index, row in enumerate(rows)
    ]
    path.write_text("\n".join(lines))
    command = [PROGRAM, "eval", "--turning", path]
    said = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    return [json.loads(line) for line in said.splitlines()]


def is_between(value, bounds, error):
    return bounds["below"] - error <= value <= bounds["above"] + error


@pytest.mark.skipif(PROGRAM is None, reason="TUNNELPROOF_PROGRAM is not set")
@pytest.mark.parametrize("lattice", [False, True])
@pytest.mark.parametrize("kind", ["edge-turning-edge", "vertex-turning-face"])
def test_answers_are_those_of_the_oracle_to_the_last_bit(kind, lattice, tmp_path):
    queries = drawn(kind, 500, 29, lattice)
    hits = tunnelproof.decide_rigid(kind, *queries)
    said = asked(kind, queries, tmp_path)
    assert len(said) == len(hits.hit) > 300 and 20 < hits.hit.sum() < len(said)
    for i, exact in enumerate(said):
        assert hits.hit[i] == exact["hit"]
        if not exact["hit"]:
            assert np.isnan(hits.toi[i]) and hits.kind[i] == 0
            continue
        assert {"below": hits.toi[i], "above": hits.toi_above[i]} == exact["toi"]
        names = {"crossing": 1, "graze": 2}
        assert hits.kind[i] == names[exact["kind_of_contact"]]
        assert hits.side[i] == exact["side"]
        assert tunnelproof.Case(hits.case[i]).name.lower() == exact["case"].replace("-", "_")
        assert hits.temporarily_parallel[i] == exact["temporarily_parallel"]
        assert hits.temporarily_point[i] == exact["temporarily_point"]
        error, weights = hits.place_error[i], hits.first.weights[i]
        assert 0 <= error <= 2.0**-50
        # Of a face, u and v are the weights of C and D.
        places = [1, 3] if kind == "edge-turning-edge" else [2, 3]
        for place, name in zip(places, "uv"):
            assert is_between(weights[place], exact[name], error + 2.0**-53)
    length = np.linalg.norm(hits.normal[hits.hit], axis=1)
    has_normal = length > 0
    # There is none where they share a point at the start.
    assert (has_normal | (hits.toi_above[hits.hit] == 0)).all() and has_normal.any()
    assert np.abs(length[has_normal] - 1).max() < 1e-15
    error = hits.normal_error[hits.hit]
    assert (error <= 2.0**-32).all() and ((error > 0) == has_normal).all()


def test_a_rod_that_turns_through_a_wire_has_every_column():
    hits = tunnelproof.decide_rigid("edge-turning-edge", [WIRE + WIRE], [ROD], QUARTER)
    assert hits.hit.tolist() == [True]
    # The square root of 2, less 1.
    below, above = Fraction(hits.toi[0]), Fraction(hits.toi_above[0])
    assert (below + 1) ** 2 < 2 < (above + 1) ** 2
    assert np.nextafter(hits.toi[0], 1) == hits.toi_above[0]
    assert hits.kind.tolist() == [tunnelproof.ContactKind.CROSSING]
    assert np.abs(hits.first.weights - [0.5, 0.5, 1 - math.sqrt(0.5), math.sqrt(0.5)]).max() < 1e-15
    assert np.abs(hits.first.point - [1, 1, 0]).max() < 1e-15
    assert not hits.has_second.any()
    # From the wire to the rod, which comes from the x axis.
    off = np.linalg.norm(hits.normal - np.array([[1, -1, 0]]) * math.sqrt(0.5))
    assert off <= hits.normal_error[0] <= 1e-14
    thick = tunnelproof.decide_rigid("edge-turning-edge", [WIRE + WIRE], [ROD], QUARTER, [[0.1, 0.2]])
    assert thick.hit.all() and thick.toi[0] < hits.toi[0] - 0.1


def test_without_a_turn_the_answer_is_that_of_the_linear_query():
    points, radii = tunnelproof.queries("lattice", 300)
    # CD moves with the body, whose frame is that of space at the start.
    points[:, 6:8] = points[:, 2:4] + points[:, 6:7]
    poses = np.zeros((300, 2, 7))
    poses[:, 0, 3], poses[:, 1, 3] = 1, -1
    poses[:, 1, :3] = points[:, 6] - points[:, 2]
    linear = tunnelproof.decide("edge-edge", points, radii)
    turning = tunnelproof.decide_rigid(
        "edge-turning-edge", points[:, [0, 1, 4, 5]], points[:, 2:4], poses, radii
    )
    assert 50 < linear.hit.sum() < 300
    for name in ("hit", "toi", "toi_above", "kind", "side", "case", "has_second"):
        assert getattr(turning, name).tobytes() == getattr(linear, name).tobytes(), name
    off = np.linalg.norm(turning.normal - linear.normal, axis=1)
    near = off <= turning.normal_error + linear.normal_error
    assert (near | ~linear.hit).all()
    # Sides that touch at the start have none; others have.
    assert 10 < (np.linalg.norm(linear.normal, axis=1) > 0.5).sum() < linear.hit.sum()
    for end in ("first", "second"):
        found, expected = getattr(turning, end), getattr(linear, end)
        assert np.nanmax(np.abs(found.weights - expected.weights)) < 1e-9
        assert np.nanmax(np.abs(found.point - expected.point)) < 1e-8


@pytest.mark.parametrize(
    "change, message",
    [
        ({"kind": "edge-edge"}, 'kind is "edge-edge", not "edge-turning-edge"'),
        ({"kind": "vertex-turning-face"}, r"points have the shape \(1, 4, 3\), not \(n, 2, 3\)"),
        ({"local": [ROD, ROD]}, r"local have the shape \(2, 2, 3\), not \(1, 2, 3\)"),
        ({"poses": [STILL]}, r"poses have the shape \(1, 7\), not \(1, 2, 7\)"),
        ({"poses": [STILL, [0] * 7]}, "query 0: the quaternion at t = 1 is 0"),
        ({"poses": [STILL, [0, 0, 0, 0, 1, 0, 0]]}, "turns by 180.000 degrees"),
        ({"poses": [[0, np.inf, 0, 1, 0, 0, 0], STILL]}, "y of the centre at t = 0 is inf"),
        ({"poses": [STILL, [0, 0, 0, 1, 0, np.nan, 0]]}, "y of the quaternion at t = 1 is NaN"),
        ({"points": [[*WIRE, [np.nan, 0, 0], [0, 0, 0]]]}, "x of point A at t = 1 is NaN"),
        ({"local": [[[0, 0, 0], [0, 0, np.inf]]]}, "z of point D in the body's frame is inf"),
        ({"radius": [[0.5, -1]]}, "radius"),
        ({"radius": [1, 2]}, r"radius has the shape \(2,\)"),
    ],
)
def test_what_is_no_query_is_refused_by_name(change, message):
    query = {
        "kind": "edge-turning-edge",
        "points": [WIRE + WIRE],
        "local": [ROD],
        "poses": QUARTER,
        "radius": 0.0,
    }
    with pytest.raises(ValueError, match=message):
        tunnelproof.decide_rigid(**{**query, **change})


def test_the_query_that_is_refused_is_named():
    poses = np.array([QUARTER] * 5)
    poses[3, 1] = 0
    with pytest.raises(ValueError, match="query 3: the quaternion at t = 1 is 0"):
        tunnelproof.decide_rigid("edge-turning-edge", [WIRE + WIRE] * 5, [ROD] * 5, poses)
    none = tunnelproof.decide_rigid(
        "edge-turning-edge", np.zeros((0, 4, 3)), np.zeros((0, 2, 3)), QUARTER
    )
    assert none.hit.shape == (0,)


def test_two_bodies_meet_where_one_of_them_rests_as_a_wire():
    poses = [STILL, STILL, *QUARTER]
    hits = tunnelproof.decide_rigid("turning-edge-turning-edge", None, [WIRE + ROD], poses)
    other = tunnelproof.decide_rigid("edge-turning-edge", [WIRE + WIRE], [ROD], QUARTER)
    assert hits.hit.tolist() == [True] and hits.toi[0] == other.toi[0]
    assert np.allclose(hits.first.point, [[1, 1, 0]], atol=1e-15)
    # Both turn alike: they rest against each other.
    alike = tunnelproof.decide_rigid(
        "turning-edge-turning-edge", None, [WIRE + ROD], QUARTER + QUARTER
    )
    assert not alike.hit.any()


def test_two_bodies_have_no_points_in_space():
    with pytest.raises(ValueError, match="has none in space"):
        tunnelproof.decide_rigid(
            "turning-edge-turning-edge", [WIRE + WIRE], [WIRE + ROD], QUARTER + QUARTER
        )
    with pytest.raises(ValueError, match="has some in space"):
        tunnelproof.decide_rigid("edge-turning-edge", None, [ROD], QUARTER)
    with pytest.raises(ValueError, match=r"local have the shape"):
        tunnelproof.decide_rigid("turning-vertex-turning-face", None, [ROD], QUARTER + QUARTER)
    with pytest.raises(ValueError, match="turning-vertex-turning-face"):
        tunnelproof.decide_rigid("edge-edge", None, [ROD], QUARTER)
