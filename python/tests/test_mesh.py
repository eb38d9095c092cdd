"""Meshes and certified steps against queries pair by pair, and what is refused."""

import itertools
import threading

import numpy as np
import pytest

import tunnelproof
from tunnelproof import Blocked, ContactKind, Feature


def soup(seed, count=12, integers=False):
    """Edges and faces between random vertices, and positions at both ends of a step."""
    random = np.random.default_rng(seed)
    edges = [random.choice(count, 2, replace=False) for _ in range(6)]
    faces = [random.choice(count, 3, replace=False) for _ in range(4)]
    if integers:
        start, end = random.integers(-3, 4, (2, count, 3)).astype(float)
    else:
        start = random.uniform(-1, 1, (count, 3))
        end = start + random.uniform(-1, 1, (count, 3)) / 4
    return tunnelproof.Mesh(edges, faces, vertex_count=count), start, end


def all_pairs(mesh):
    """The vertices of all pairs, edges first, as the mesh orders them."""
    used = set(mesh.edges.flatten().tolist())
    points = [vertex for vertex in range(mesh.vertex_count) if vertex not in used]
    segments = [*mesh.edges.tolist(), *([point] * 2 for point in points)]
    edges = [[*first, *second] for first, second in itertools.combinations(segments, 2)]
    faces = [[vertex, *face] for vertex in range(mesh.vertex_count) for face in mesh.faces.tolist()]
    apart = lambda pairs, n: [pair for pair in pairs if not set(pair[:n]) & set(pair[n:])]
    return {"edge-edge": apart(edges, 2), "vertex-face": apart(faces, 1)}


def brute(mesh, start, end, thickness=0.0, decide=tunnelproof.decide):
    """The vertices of the pairs that touch, and their first time of impact."""
    found = []
    for kind, vertices in all_pairs(mesh).items():
        points = np.concatenate([start[vertices], end[vertices]], axis=1)
        hits = decide(kind, points, thickness)
        toi = hits.toi if hits.toi.ndim == 1 else hits.toi[:, 0]
        found += [(v, t) for v, hit, t in zip(vertices, hits.hit, toi) if hit]
    return found


@pytest.mark.parametrize("integers", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_contacts_are_those_of_all_pairs(seed, integers):
    mesh, start, end = soup(seed, integers=integers)
    for thickness, decide in [(0.0, tunnelproof.exact), (0.05, tunnelproof.decide)]:
        expected = brute(mesh, start, end, thickness, decide)
        found = mesh.all_contacts(start, end, thickness)
        assert found.vertices.tolist() == [vertices for vertices, _ in expected]
        assert found.toi.tolist() == [toi for _, toi in expected]
        assert mesh.is_free(start, end, thickness) == (not expected)
        first = mesh.first_contact(start, end, thickness)
        assert len(first) == min(len(expected), 1)
        if expected:
            row = int(np.argmin(found.toi))
            for name, column in vars(first).items():
                assert np.array_equal(column[0], getattr(found, name)[row]), name


@pytest.mark.parametrize("settings", [{}, {"clearance": 0.01}, {"share": 0.2}])
@pytest.mark.parametrize("seed", range(20))
def test_positions_of_a_step_touch_nothing_by_the_oracle(seed, settings):
    mesh, start, end = soup(seed)
    thickness = 0.0 if seed % 2 else 0.02
    if not mesh.is_free(start, start, thickness):
        thickness = 0.0
    step = mesh.step(start, end, thickness, **settings)
    assert brute(mesh, start, step.positions, thickness, tunnelproof.exact) == []
    free = mesh.is_free(start, end, thickness)
    if free and "clearance" not in settings:
        assert step.step == 1 and np.array_equal(step.positions, end)
    assert (step.step == 1) == (len(step.limits) == 0)
    assert step.step > 0 and set(step.limits.blocked) <= {Blocked.AHEAD, Blocked.ROUNDING}


def test_pairs_name_their_features():
    # A triangle, an edge across it, and a point above both.
    start = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 1], [1, 5, 1], [1, 1, 3]], float)
    end = start.copy()
    end[3:, 2] -= 4
    mesh = tunnelproof.Mesh([[3, 4]], [[0, 1, 2]], vertex_count=6)
    contacts = mesh.all_contacts(start, end)
    kinds = list(zip(contacts.first_feature, contacts.first, contacts.second_feature, contacts.second))
    assert kinds == [
        (Feature.EDGE, 0, Feature.EDGE, 2),
        (Feature.VERTEX, 3, Feature.FACE, 0),
        (Feature.VERTEX, 5, Feature.FACE, 0),
    ]
    assert contacts.toi.tolist() == [0.25, 0.25, 0.75]
    assert contacts.kind.tolist() == [ContactKind.CROSSING] * 3
    assert contacts.point[2].tolist() == [1, 1, 0] and contacts.weights[2, 0] == 1
    assert np.allclose(contacts.normal[2], [0, 0, -1])
    assert mesh.edges.tolist() == [[3, 4], [0, 1], [1, 2], [2, 0]]
    assert repr(mesh) == "<Mesh: 6 vertices, 4 edges, 1 faces>"


def test_a_step_names_what_ends_it_and_what_is_near():
    start = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, 0.5]])
    end = start.copy()
    end[3, 2] = -0.5
    mesh = tunnelproof.Mesh([], [[0, 1, 2]], vertex_count=4)
    step = mesh.step(start, end, 0.25)
    assert step.limits.vertices.tolist() == [[3, 0, 1, 2]] and len(step.near) == 0
    assert step.limits.blocked.tolist() == [Blocked.AHEAD] and 0.2499 < step.step <= 0.25
    step = mesh.step(start, end, 1.0)
    # The vertex is a point: it is near the edges as well.
    assert step.near.vertices.tolist()[-1] == [3, 0, 1, 2] and len(step.near) == 4
    assert step.positions[3, 2] > 0.4499 and abs(step.near.kept[-1].sum() - 0.45) < 1e-12
    start[3, 2] = 0
    step = mesh.step(start, end)
    assert step.step == 0 and step.limits.blocked.tolist() == [Blocked.TOUCHING]
    assert np.array_equal(step.positions, start) and step.candidates[1] == 1


def test_groups_are_left_out_and_have_a_thickness_each():
    start = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, 1]])
    end = start.copy()
    end[3, 2] = -1
    settings = {"faces": [[0, 1, 2]], "groups": [0, 0, 0, 1]}
    mesh = tunnelproof.Mesh(**settings)
    assert mesh.vertex_count == 4 and mesh.group_count == 2
    assert mesh.first_contact(start, end, [0.5, 0.0]).toi.tolist() == [0.375]
    assert tunnelproof.Mesh(**settings, left_out=[(1, 0)]).is_free(start, end)
    assert not tunnelproof.Mesh(**settings, left_out=[(0, 0)]).is_free(start, end)


def is_single(numbers):
    return numbers.astype(np.float32).astype(np.float64) == numbers


@pytest.mark.parametrize("kind", ["edge-edge", "vertex-face"])
def test_points_stored_in_f32_keep_what_they_say(kind):
    family = "thick_uniform" if kind == "edge-edge" else "thick_face_uniform"
    points, radii = tunnelproof.queries(family, 2000, seed=4)
    points[:, :4] = points[:, :4].astype(np.float32)
    moved = tunnelproof.advance(kind, points, radii, precision="f32")
    assert is_single(moved.points).all()
    assert not is_single(tunnelproof.advance(kind, points, radii).points).all()
    proved = ~np.isnan(moved.kept[:, 0])
    assert proved.sum() > 1000
    stored = np.concatenate([points[:, :4], moved.points], axis=1)
    assert not tunnelproof.exact(kind, stored[proved], moved.kept[proved]).hit.any()


def test_meshes_store_f32_where_that_is_asked():
    mesh = tunnelproof.Mesh(faces=[[0, 1, 2], [3, 4, 5]])
    start = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, 1], [2, 1, 1], [1, 2, 1]], float)
    start[:3, 2] = np.float32(0.1)
    end = start.copy()
    end[3:, 2] = np.float32(-1.7)
    single = mesh.step(start, end, precision="f32")
    double = mesh.step(start, end)
    assert single.positions.dtype == np.float32 and not is_single(double.positions).all()
    assert 0 < single.step < double.step and double.step - single.step < 1e-5
    assert mesh.is_free(start, single.positions)
    for refused in [
        lambda: mesh.step(start, end, precision="f16"),
        lambda: tunnelproof.advance("edge-edge", np.zeros((0, 8, 3)), precision="f16"),
    ]:
        with pytest.raises(ValueError, match="precision is \"f16\""):
            refused()
    # What it starts from is never rounded.
    start[4, 1] = 0.1
    with pytest.raises(ValueError, match=r"start\[4\]\[1\] is 0.1, which is no float32"):
        mesh.step(start, end, precision="f32")
    points = np.zeros((2, 8, 3))
    points[1, 3, 2] = 1e39
    with pytest.raises(ValueError, match=r"points\[1\]\[3\]\[2\] is 1e\+39, which is no float32"):
        tunnelproof.advance("edge-edge", points, precision="f32")
    end[5, 0] = -1e39
    with pytest.raises(ValueError, match=r"end\[5\]\[0\] is -inf, not a finite number"):
        mesh.step(start.astype(np.float32), end, precision="f32")


@pytest.mark.parametrize("settings", [{}, {"clearance": 0.01}, {"share": 0.5}])
@pytest.mark.parametrize("seed", range(10))
def test_float32_arrays_are_answered_in_float32(seed, settings):
    mesh, *ends = soup(seed)
    start, end = (positions.astype(np.float32) for positions in ends)
    double = [start.astype(np.float64), end.astype(np.float64)]
    thickness = 0.0 if seed % 2 else 0.02
    moved = mesh.step(start, end, thickness, **settings)
    same = mesh.step(*double, thickness, **settings, precision="f32")
    assert moved.positions.dtype == same.positions.dtype == np.float32
    assert np.array_equal(moved.positions, same.positions) and moved.step == same.step
    assert np.array_equal(moved.limits.vertices, same.limits.vertices)
    wide = mesh.step(start, end, thickness, **settings, precision="f64")
    assert wide.positions.dtype == np.float64 and abs(wide.step - moved.step) < 1e-4
    # By the oracle, the motion to what is stored is free.
    if moved.step > 0 and not len(moved.near):
        assert not brute(mesh, double[0], moved.positions.astype(np.float64), thickness, tunnelproof.exact)
    for ask in [mesh.all_contacts, mesh.first_contact]:
        found, expected = ask(start, end, thickness), ask(*double, thickness)
        assert np.array_equal(found.vertices, expected.vertices)
        assert np.array_equal(found.toi, expected.toi) and np.array_equal(found.normal, expected.normal)
    assert mesh.is_free(start, end, thickness) == mesh.is_free(*double, thickness)


@pytest.mark.parametrize("kind", ["edge-edge", "vertex-face"])
def test_points_that_are_float32_are_stored_as_such(kind):
    family = "thick_uniform" if kind == "edge-edge" else "thick_face_uniform"
    points, radii = tunnelproof.queries(family, 200, seed=8)
    points = points.astype(np.float32)
    moved = tunnelproof.advance(kind, points, radii)
    same = tunnelproof.advance(kind, points.astype(np.float64), radii, precision="f32")
    wide = tunnelproof.advance(kind, points, radii, precision="f64")
    assert moved.points.dtype == same.points.dtype == np.float32 and wide.points.dtype == np.float64
    assert np.array_equal(moved.points, same.points) and np.array_equal(moved.step, same.step)
    assert not is_single(wide.points).all()


@pytest.mark.parametrize("kind", ["edge-edge", "vertex-face"])
@pytest.mark.parametrize("settings", [{}, {"clearance": 0.01}, {"share": 0.5}])
def test_stored_points_of_a_pair_keep_what_they_say(kind, settings):
    family = "thick_uniform" if kind == "edge-edge" else "thick_face_uniform"
    points, radii = tunnelproof.queries(family, 2000, seed=3)
    moved = tunnelproof.advance(kind, points, radii, **settings)
    proved = ~np.isnan(moved.kept[:, 0])
    assert proved.sum() > 1000 and (moved.step[~proved] == 0).all()
    stored = np.concatenate([points[:, :4], moved.points], axis=1)
    kept = tunnelproof.exact(kind, stored[proved], moved.kept[proved])
    assert not kept.hit.any()
    whole = moved.step == 1
    assert (whole == (moved.blocked == Blocked.NOT)).all() and (whole | (moved.step < 1)).all()
    assert np.array_equal(moved.points[whole], points[whole, 4:])
    # Whether they have to stop is what the certified path says.
    free = ~tunnelproof.decide(kind, points, radii).hit
    if "clearance" not in settings:
        assert whole[free].all()


def test_arrays_in_order_are_read_where_they_are():
    mesh, start, end = soup(1)
    for kind in [np.float64, np.float32]:
        first, last = start.astype(kind), end.astype(kind)
        found = tunnelproof._arrays.position_arrays(first, last)
        assert found[0] is first and found[1] is last
    expected = mesh.step(start, end)
    for same in [np.asfortranarray, lambda x: np.repeat(x, 2, axis=0)[::2], lambda x: x.astype(">f8")]:
        found = mesh.step(same(start), same(end))
        assert found.step == expected.step
        assert np.array_equal(found.positions, expected.positions)
    mixed = mesh.step(start.astype(np.float32), end.tolist())
    assert mixed.positions.dtype == np.float64


def test_what_is_no_mesh_is_named():
    mesh, start, end = soup(1)
    refused = lambda match: pytest.raises(ValueError, match=match)
    with refused(r"edges\[1\]\[0\] is vertex 9, and there are 4 vertices"):
        tunnelproof.Mesh([[0, 1], [9, 1]], vertex_count=4)
    with refused(r"faces\[0\]\[2\] is -1"):
        tunnelproof.Mesh(faces=[[0, 1, -1]])
    with refused(r"edges have the shape \(1, 3\), not \(n, 2\)"):
        tunnelproof.Mesh([[0, 1, 2]])
    with refused("edges are of type float64"):
        tunnelproof.Mesh([[0.0, 1.0]])
    with refused("groups has 2 entries, and there are 3 vertices"):
        tunnelproof.Mesh(vertex_count=3, groups=[0, 0])
    with refused("groups has 2 entries, and there are 3 vertices"):
        tunnelproof.Mesh(faces=[[0, 1, 2]], groups=[0, 0])
    with refused("thickness has 4 entries, and there is 1 group"):
        tunnelproof.Mesh(faces=[[0, 1, 2]]).is_free(np.zeros((3, 3)), np.zeros((3, 3)), np.ones(4))
    with refused("there is no group 1; the largest is 0"):
        tunnelproof.Mesh(vertex_count=3, left_out=[(0, 1)])
    with refused("vertex_count is -1"):
        tunnelproof.Mesh(vertex_count=-1)
    with refused("end has 11 entries, and there are 12 vertices"):
        mesh.is_free(start, end[:-1])
    with refused(r"start has the shape \(12, 2\), not \(n, 3\)"):
        mesh.is_free(start[:, :2], end)
    bad = end.copy()
    bad[7, 1] = np.nan
    with refused(r"end\[7\]\[1\] is NaN"):
        mesh.step(start, bad)
    with refused("thickness is -1"):
        mesh.step(start, end, -1)
    with refused(r"thickness\[0\] is inf"):
        mesh.all_contacts(start, end, [np.inf])
    with refused(r"thickness has the shape \(1, 1\)"):
        mesh.all_contacts(start, end, [[0.1]])
    with refused("the share is 1"):
        mesh.step(start, end, share=1)
    with refused("the clearance is -1"):
        mesh.step(start, end, clearance=-1)
    with refused("give one of them"):
        mesh.step(start, end, clearance=0.1, share=0.5)
    with refused("query 0: .*NaN"):
        tunnelproof.advance("edge-edge", np.full((1, 8, 3), np.nan))
    with refused("the clearance is NaN"):
        tunnelproof.advance("edge-edge", np.zeros((1, 8, 3)), clearance=np.nan)


def test_a_mesh_without_parts_is_free():
    mesh = tunnelproof.Mesh()
    nothing = np.zeros((0, 3))
    assert mesh.is_free(nothing, nothing) and len(mesh.all_contacts(nothing, nothing)) == 0
    assert mesh.step(nothing, nothing).positions.shape == (0, 3)
    assert tunnelproof.advance("edge-edge", np.zeros((0, 8, 3))).points.shape == (0, 4, 3)


def test_a_mesh_serves_several_threads():
    mesh, start, end = soup(4)
    expected = mesh.step(start, end).positions
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(mesh.step(start, end).positions))
        for _ in range(8)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 8 and all(np.array_equal(positions, expected) for positions in found)
