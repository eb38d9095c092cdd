"""IPC Toolkit with the certified path behind it, in two ways.

    pip install ./python -r examples/ipctk/requirements.txt
    python examples/ipctk/ccd.py

**A whole mesh at once.** :func:`compute_collision_free_stepsize` takes the place of the toolkit's function. It uses all
cores. No contact is missed, and the positions ``x0 + step * (x1 - x0)``, as NumPy computes them below a step of 1, are
proved to keep more than ``min_distance``. At a step of 1 store ``x1`` itself.

**A narrow phase.** :class:`CertifiedCCD` is a ``NarrowPhaseCCD`` for every function of the toolkit that takes one. Each
pair is decided without error, but it is decided alone: rounding of stored positions is accounted for in the pair that
ends the step, not in the others. The toolkit calls it from Python, pair by pair, so it is slow.

What both do with a pair near ``min_distance``:

- A pair that would come within ``min_distance`` keeps a ``share`` of what it has beyond it, 0.2 by default. So does the
  toolkit's ``TightInclusionCCD``, but at most 1e-4: give a smaller share to come nearer in a step.
- A pair that **starts** within ``min_distance`` keeps nine tenths of its distance, and is free to part. The toolkit's own
  methods answer 0 here. Then no step is made at all, not even one that would part the pair.
- The step is **0** only if a pair touches at the start, or if rounding leaves no room to move. Do not ask again with the
  same motion.
"""

import ipctk
import numpy as np
import tunnelproof


def compute_collision_free_stepsize(mesh, x0, x1, min_distance=0.0, *, share=0.2) -> float:
    """As ``ipctk.compute_collision_free_stepsize``, of a mesh without planes, all of whose parts may collide."""
    if len(mesh.planes) > 0:
        raise ValueError("the mesh has planes: give them as large faces")
    whole = tunnelproof.Mesh(mesh.edges, mesh.faces, vertex_count=mesh.num_vertices)
    return whole.step(in_space(x0), in_space(x1), min_distance, share=share).step


class CertifiedCCD(ipctk.NarrowPhaseCCD):
    """The certified path as a narrow phase of the toolkit, which is set to one thread.

    With more threads it would stop for good: its functions hold the lock of the interpreter while they wait for
    threads, and these wait for that lock to call Python.
    """

    def __init__(self, share: float = 0.2) -> None:
        super().__init__()
        ipctk.set_num_threads(1)
        self.share = share

    def point_triangle_ccd(self, p0, a0, b0, c0, p1, a1, b1, c1, min_distance=0.0, tmax=1.0):
        return self._ccd("vertex-face", [p0, a0, b0, c0, p1, a1, b1, c1], min_distance, tmax)

    def edge_edge_ccd(self, a0, b0, c0, d0, a1, b1, c1, d1, min_distance=0.0, tmax=1.0):
        return self._ccd("edge-edge", [a0, b0, c0, d0, a1, b1, c1, d1], min_distance, tmax)

    def point_edge_ccd(self, p0, a0, b0, p1, a1, b1, min_distance=0.0, tmax=1.0):
        return self._ccd("edge-edge", [p0, p0, a0, b0, p1, p1, a1, b1], min_distance, tmax)

    def point_point_ccd(self, p0, q0, p1, q1, min_distance=0.0, tmax=1.0):
        return self._ccd("edge-edge", [p0, p0, q0, q0, p1, p1, q1, q1], min_distance, tmax)

    def _ccd(self, kind, points, min_distance, tmax):
        """Whether the pair comes within ``min_distance`` up to ``tmax``, and how far it may go."""
        points = in_space(points)[None]
        hits = tunnelproof.decide(kind, points, min_distance)
        if not hits.hit[0] or hits.toi_above[0] > tmax:
            return False, tmax
        moved = tunnelproof.advance(kind, points, min_distance, share=self.share)
        # It starts within the distance, and parts.
        if moved.blocked[0] == tunnelproof.Blocked.NOT:
            return False, tmax
        return True, min(float(moved.step[0]), tmax)


def in_space(x) -> np.ndarray:
    """Points in the plane get a third coordinate of 0."""
    x = np.asarray(x, dtype=np.float64)
    return np.pad(x, [(0, 0), (0, 3 - x.shape[1])])


def main() -> None:
    """A sheet is thrown at itself, folded: the step by the toolkit and in both ways."""
    n = 12
    u, v = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    x0 = np.stack([np.abs(u - 0.5), v, 0.1 + 0.2 * (u > 0.5) + 0.05 * np.sin(9 * v)], axis=-1).reshape(-1, 3)
    a = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + n], 1), np.stack([a + 1, a + n + 1, a + n], 1)])
    edges = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    mesh = ipctk.CollisionMesh(x0, edges.astype(np.int32), faces.astype(np.int32))
    x1 = x0 + np.random.default_rng(1).uniform(-0.1, 0.1, x0.shape)
    x1[:, 2] *= -1
    whole = tunnelproof.Mesh(edges, faces)
    for distance in [0.0, 1e-3]:
        certified = compute_collision_free_stepsize(mesh, x0, x1, distance)
        theirs = ipctk.compute_collision_free_stepsize(mesh, x0, x1, distance)
        ours = ipctk.compute_collision_free_stepsize(mesh, x0, x1, distance, None, CertifiedCCD())
        print(f"min_distance {distance}: {certified:.6f} for the mesh, {ours:.6f} pair by pair, {theirs:.6f} by the toolkit")
        for step in (certified, ours):
            assert 0 < step < 1 and whole.is_free(x0, x0 + step * (x1 - x0), distance)
        assert abs(certified - ours) < 1e-9


if __name__ == "__main__":
    main()
