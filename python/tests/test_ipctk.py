"""The example that puts the certified path behind IPC Toolkit, with all kinds of pairs."""

import sys
from pathlib import Path

import numpy as np
import pytest

import tunnelproof

ipctk = pytest.importorskip("ipctk")
sys.path.insert(0, str(Path(__file__).parents[2] / "examples" / "ipctk"))
import ccd  # noqa: E402

EDGES, FACES = [[0, 1], [2, 3], [4, 5], [5, 6], [6, 4]], [[4, 5, 6]]


@pytest.mark.parametrize("seed", range(30))
def test_steps_of_the_toolkit_are_those_of_the_mesh(seed):
    # Edges, a face, and two points in no edge.
    random = np.random.default_rng(seed)
    x0 = random.uniform(-1, 1, (9, 3))
    x1 = x0 + random.uniform(-2, 2, (9, 3))
    mesh = ipctk.CollisionMesh(x0, np.array(EDGES, np.int32), np.array(FACES, np.int32))
    assert mesh.num_codim_vertices == 2
    whole = tunnelproof.Mesh(EDGES, FACES, vertex_count=9)
    for distance in [0.0, 0.01]:
        narrow = ccd.CertifiedCCD()
        expected = ccd.compute_collision_free_stepsize(mesh, x0, x1, distance)
        found = ipctk.compute_collision_free_stepsize(mesh, x0, x1, distance, None, narrow)
        assert abs(found - expected) < 1e-9
        end = x1 if expected == 1 else x0 + expected * (x1 - x0)
        # Some start within the distance, and keep nine tenths of theirs.
        is_near = not whole.is_free(x0, x0, distance)
        assert whole.is_free(x0, end, 0.0 if is_near else distance) and expected > 0
        free = ipctk.is_step_collision_free(mesh, x0, x1, distance, None, narrow)
        assert is_near or free == whole.is_free(x0, x1, distance)


def test_a_mesh_in_the_plane_is_one():
    x0 = np.array([[0, 0], [1, 0], [0.5, 1], [0.6, 2]])
    x1 = x0 - [[0, 0], [0, 0], [0, 2], [0, 2]]
    edges = np.array([[0, 1], [2, 3]], np.int32)
    mesh = ipctk.CollisionMesh(x0, edges, np.zeros((0, 3), np.int32))
    found = ipctk.compute_collision_free_stepsize(mesh, x0, x1, 0.0, None, ccd.CertifiedCCD(0.5))
    assert abs(found - 0.25) < 1e-9
    assert abs(ccd.compute_collision_free_stepsize(mesh, x0, x1, share=0.5) - found) < 1e-9


def test_near_pairs_follow_the_written_policy():
    narrow = ccd.CertifiedCCD()
    face = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], float)

    def falls(start, end, **settings):
        points = [np.array([0.2, 0.2, z]) for z in (start, end)]
        return narrow.point_triangle_ccd(points[0], *face, points[1], *face, **settings)

    # The contact is at 1/2; 0.2 of the distance are kept.
    hit, toi = falls(1, -1)
    assert hit and abs(toi - 0.4) < 1e-9
    assert falls(1, -1, tmax=0.4999) == (False, 0.4999)
    assert falls(1, -1, tmax=0.5)[0]
    # From within the distance: nine tenths on the way in, all of the way out, nothing at a touch.
    hit, toi = falls(0.1, -0.1, min_distance=0.5)
    assert hit and abs(toi - 0.05) < 1e-9
    assert falls(0.1, 1, min_distance=0.5) == (False, 1)
    assert falls(0, 1) == (True, 0)
