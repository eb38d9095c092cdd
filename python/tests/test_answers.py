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


THROUGH = np.array(
    [
        [[0, 0, 1], [-1, -1, 0], [3, -1, 0], [-1, 3, 0]],
        [[0, 0, -3], [-1, -1, 0], [3, -1, 0], [-1, 3, 0]],
    ],
    dtype=float,
).reshape(1, 8, 3)


def is_normal(hits, expected):
    near = np.linalg.norm(hits.normal - np.array([expected]), axis=1) <= hits.normal_error
    return near.all() and (hits.normal_error <= 2.0**-32).all()


def test_two_edges_that_cross_have_every_column():
    hits = tunnelproof.decide("edge-edge", FALLING)
    assert hits.hit.tolist() == [True]
    assert hits.toi.tolist() == hits.toi_above.tolist() == [0.25]
    assert hits.kind.tolist() == [tunnelproof.ContactKind.CROSSING]
    assert hits.side.tolist() == [1]
    assert hits.case.tolist() == [tunnelproof.Case.GENERAL]
    assert not (hits.temporarily_parallel | hits.temporarily_point | hits.has_second).any()
    assert hits.first.weights.tolist() == [[0.25, 0.75, 0.5, 0.5]]
    assert hits.first.point.tolist() == [[0.5, 0, 0]]
    assert np.array_equal(hits.second.weights, hits.first.weights)
    assert is_normal(hits, [0, 0, 1])


def test_a_vertex_and_a_face_have_the_same_columns():
    hits = tunnelproof.decide("vertex-face", THROUGH)
    assert hits.toi.tolist() == [0.25] and hits.side.tolist() == [1]
    assert hits.first.weights.tolist() == [[1, 0.5, 0.25, 0.25]]
    assert hits.first.point.tolist() == [[0, 0, 0]]
    assert is_normal(hits, [0, 0, -1])


def test_edges_that_overlap_have_a_second_point():
    overlap = FALLING.copy()
    overlap[0, 2:4] = [[0, 0, 1], [2, 0, 1]]
    overlap[0, 6:8] = [[0, 0, -1], [2, 0, -1]]
    hits = tunnelproof.decide("edge-edge", overlap)
    assert hits.case.tolist() == [tunnelproof.Case.PARALLEL] and hits.has_second.tolist() == [True]
    assert hits.first.point.tolist() == [[0, 0, 0]] and hits.second.point.tolist() == [[1, 0, 0]]
    assert is_normal(hits, [0, 0, 1])


def test_a_miss_has_no_numbers_and_a_contact_at_the_start_no_normal():
    both = np.concatenate([FALLING, FALLING])
    both[0, 6:8, 2] = 0.5
    both[1, 2:4, 2] = 0
    hits = tunnelproof.decide("edge-edge", both)
    assert hits.hit.tolist() == [False, True]
    assert hits.kind.tolist() == [0, tunnelproof.ContactKind.GRAZE]
    assert np.isnan(hits.toi[0]) and np.isnan(hits.first.weights[0]).all()
    assert np.isnan(hits.normal[0]).all() and hits.case[0] == 0
    assert hits.toi[1] == 0 and hits.normal[1].tolist() == [0, 0, 0]


def test_radius_is_taken_in_every_shape_and_as_an_exact_sum():
    for radius in [0.5, [0.5], [[0.25, 0.25]], np.float32(0.5)]:
        assert tunnelproof.decide("edge-edge", FALLING, radius).toi.tolist() == [0.125]
    # The step starts at a distance of 0.1 + 0.2, rounded up, which the two radii do not reach.
    still = FALLING.copy()
    still[:, [2, 3, 6, 7], 2] = 0.1 + 0.2
    assert tunnelproof.decide("edge-edge", still, [[0.1, 0.2]]).hit.tolist() == [False]
    assert tunnelproof.decide("edge-edge", still, 0.1 + 0.2).hit.tolist() == [True]


@pytest.mark.parametrize("family", tunnelproof.families(), ids=lambda family: family.name)
def test_certified_path_is_what_the_oracle_says(family):
    points, radii = tunnelproof.queries(family.name, 500, seed=5)
    exact = tunnelproof.exact(family.kind, points, radii)
    found = tunnelproof.decide(family.kind, points, radii)
    weights = found.first.weights[:, [1, 3] if family.kind == "edge-edge" else [2, 3]]
    error = found.place_error
    assert (found.hit == exact.hit).all()
    toi = np.stack([found.toi, found.toi_above], axis=1)
    assert np.array_equal(toi, exact.toi, equal_nan=True)
    assert (found.kind == exact.kind).all()
    assert (found.side == exact.side).all()
    for i in range(2):
        low, high = exact.weights[:, i].T
        near = (weights[:, i] >= low - error) & (weights[:, i] <= high + error)
        assert near[exact.hit].all()
    length = np.linalg.norm(found.normal[exact.hit], axis=1)
    assert (np.isclose(length, 1) | (length == 0) & (found.toi[exact.hit] == 0)).all()
    assert exact.hit.any()


def test_queries_are_the_same_every_time_and_continue():
    points, radii = tunnelproof.queries("thick_uniform", 10, seed=3)
    assert points.shape == (10, 8, 3) and radii.shape == (10, 2)
    rest, _ = tunnelproof.queries("thick_uniform", 4, seed=3, start=6)
    assert np.array_equal(points[6:], rest)


def test_no_queries_have_no_answers():
    hits = tunnelproof.decide("edge-edge", np.zeros((0, 8, 3)))
    assert hits.hit.shape == (0,) and hits.first.weights.shape == (0, 4)


def test_what_is_no_query_is_named():
    bad = np.concatenate([FALLING, FALLING])
    bad[1, 6, 2] = np.nan
    with pytest.raises(ValueError, match="query 1: .*NaN"):
        tunnelproof.decide("edge-edge", bad)
    with pytest.raises(ValueError, match="query 0: the radius is -1"):
        tunnelproof.decide("vertex-face", FALLING, -1)
    with pytest.raises(ValueError, match=r"points have the shape \(8, 3\), not \(n, 8, 3\)"):
        tunnelproof.decide("edge-edge", FALLING[0])
    with pytest.raises(ValueError, match=r"radius has the shape \(3,\)"):
        tunnelproof.exact("edge-edge", FALLING, [1, 2, 3])
    with pytest.raises(ValueError, match="kind is \"edges\""):
        tunnelproof.exact("edges", FALLING)
    with pytest.raises(ValueError, match="kind is \"edges\""):
        tunnelproof.decide("edges", FALLING)
    with pytest.raises(ValueError, match="there is no family \"none\""):
        tunnelproof.queries("none", 1)


def test_other_threads_run_meanwhile():
    points, radii = tunnelproof.queries("uniform", 20_000)
    done = threading.Event()
    ticks = 0

    def work():
        for _ in range(3):
            tunnelproof.exact("edge-edge", points, radii)
        done.set()

    thread = threading.Thread(target=work)
    thread.start()
    while not done.is_set():
        ticks += 1
        time.sleep(0.001)
    thread.join()
    assert ticks > 5
