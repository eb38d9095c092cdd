"""IPC Toolkit's continuous collision detection: `tight-inclusion` or `additive`, with the number of iterations."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "common"))

import ipctk
import numpy as np
from frames import SKIN, serve, timed

# What it logs goes to the standard output.
ipctk.set_logger_level(ipctk.LoggerLevel.off)

METHODS = {"tight-inclusion": ipctk.TightInclusionCCD, "additive": ipctk.AdditiveCCD}
name, iterations = sys.argv[1:]
ccd = METHODS[name](max_iterations=int(iterations))


def answer(kind, points, radii):
    decide = ccd.edge_edge_ccd if kind == "edge-edge" else ccd.point_triangle_ccd
    # The minimum distance is one number. Of a cast the sum of two radii is exact.
    points = list(np.array(points))
    hit, toi = timed(decide, *points, min_distance=sum(radii) + SKIN)
    return toi if hit else None


serve(answer)
