"""Times of a mesh's step: this project beside IPC Toolkit, on the same arrays, in one process.

    pip install ./python ipctk meshio
    RAYON_NUM_THREADS=1 python examples/ipctk/bench.py [START.ply END.ply]

Without files: a rolled-up sheet of cloth of 50 by 50 and of 200 by 200 vertices. One thread each;
the best of five.
"""

import os
import sys
import time

os.environ.setdefault("RAYON_NUM_THREADS", "1")

import ipctk
import numpy as np
import tunnelproof


def rolled_sheet(side):
    """A square sheet rolled up in turns 7.5 cm apart, that falls and trembles."""
    random = np.random.default_rng(1)
    spacing = 1 / side
    i, j = np.divmod(np.arange(side * side), side)
    angle = 12 * i * spacing
    radius = 0.2 + 0.012 * angle
    start = np.stack([radius * np.cos(angle), radius * np.sin(angle), j * spacing], axis=1)
    start += random.uniform(-0.05, 0.05, start.shape) * spacing
    end = start * [0.98, 1, 1] + [0, 0.01, -0.5 * spacing]
    end += random.uniform(-0.15, 0.15, start.shape) * spacing
    a = (np.arange(side - 1)[:, None] * side + np.arange(side - 1)).ravel()
    b = a + side
    faces = np.concatenate([np.stack([a, a + 1, b], 1), np.stack([a + 1, b + 1, b], 1)])
    return start, end, faces


def best(ask):
    times = []
    for _ in range(5):
        clock = time.perf_counter()
        answer = ask()
        times.append(time.perf_counter() - clock)
    return 1e3 * min(times), answer


def compare(name, start, end, faces):
    ours = tunnelproof.Mesh(faces=faces)
    step_ms, step = best(lambda: ours.step(start, end))
    free_ms, is_free = best(lambda: ours.is_free(start, end))
    print(f"{name}: {len(start)} vertices, {len(faces)} faces")
    print(f"  tunnelproof  step {step_ms:7.1f} ms, {step.step:.10f}   free? {free_ms:7.1f} ms, {is_free}")
    start, end = np.asfortranarray(start), np.asfortranarray(end)
    faces = faces.astype(np.int32)
    theirs = ipctk.CollisionMesh(start, ipctk.edges(faces), faces)
    for phase in [ipctk.LBVH, ipctk.HashGrid]:
        how = dict(broad_phase=phase())
        ms, step = best(lambda: ipctk.compute_collision_free_stepsize(theirs, start, end, **how))
        free, is_free = best(lambda: ipctk.is_step_collision_free(theirs, start, end, **how))
        print(f"  {phase.__name__:12} step {ms:7.1f} ms, {step:.10f}   free? {free:7.1f} ms, {is_free}")


ipctk.set_num_threads(1)
if sys.argv[1:]:
    import meshio

    first, second = (meshio.read(path) for path in sys.argv[1:])
    start, end = (mesh.points.astype(float) for mesh in (first, second))
    compare(sys.argv[1], start, end, first.cells_dict["triangle"])
else:
    for side in [50, 200]:
        compare("rolled sheet", *rolled_sheet(side))
