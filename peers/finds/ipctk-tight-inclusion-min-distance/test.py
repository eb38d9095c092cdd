# pip install ipctk==1.6.1 numpy, then: python test.py
import ipctk
import numpy as np

ipctk.set_logger_level(ipctk.LoggerLevel.off)
# A B C D at the start, then at the end: AB is at rest, CD moves without turning.
points = np.array([[0, 0, 0], [0.02, 0.55, 0.11], [0.87, 0.61, -0.7], [0.36, 0.78, 0.15],
                   [0, 0, 0], [0.02, 0.55, 0.11], [-0.02, 0.97, -1.94], [-0.53, 1.14, -1.09]])
for t in [0, 0.02, 0.11]:
    at = (1 - t) * points[:4] + t * points[4:]
    print(f"distance at {t}: {ipctk.edge_edge_distance(*at) ** 0.5:.4f}")
for method in [ipctk.AdditiveCCD(), ipctk.TightInclusionCCD()]:
    print(type(method).__name__, method.edge_edge_ccd(*points, min_distance=0.4))
