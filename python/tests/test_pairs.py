"""Pairs by index: the answers of one by one, and what is refused."""

import dataclasses

import numpy as np
import pytest

import tunnelproof

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
