"""A cloth falls on a ball. What touches sticks; every step is proved to touch nothing.

    pip install ./python
    python examples/cloth.py

Writes `cloth.obj`; `python examples/picture.py cloth.obj cloth.png 576` draws it.
"""

import sys

import numpy as np
import tunnelproof

N, THICKNESS, DT = 24, 0.01, 0.01
STEPS = int(sys.argv[1]) if len(sys.argv) > 1 else 100


def grid(rows, columns, first):
    """The triangles between the vertices of a grid."""
    a = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel() + first
    b, c, d = a + 1, a + columns, a + columns + 1
    return np.concatenate([np.stack([a, b, c], axis=1), np.stack([b, d, c], axis=1)])


# A square of 1 m, and a ball of radius 0.3 m that stays where it is: a group left out with itself.
u, v = np.meshgrid(np.linspace(-0.5, 0.5, N), np.linspace(-0.5, 0.5, N))
cloth = np.stack([u, v, np.full((N, N), 0.35)], axis=-1).reshape(-1, 3)
t, p = np.meshgrid(np.linspace(0.1, 3.0, 12), np.linspace(0, 2 * np.pi, 25), indexing="ij")
ball = 0.3 * np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], axis=-1).reshape(-1, 3)
x = np.concatenate([cloth, ball])
is_cloth = np.arange(len(x)) < len(cloth)
faces = np.concatenate([grid(N, N, 0), grid(12, 25, len(cloth))])
mesh = tunnelproof.Mesh(faces=faces, groups=is_cloth.astype(int), left_out=[(0, 0)])

a, b = mesh.edges[(mesh.edges < len(cloth)).all(axis=1)].T
rest = np.linalg.norm(x[a] - x[b], axis=1)
velocity, touched, made = np.zeros_like(x), 0, 0.0
for _ in range(STEPS):
    velocity[is_cloth, 2] -= 9.81 * DT
    wanted = x + DT * velocity
    for _ in range(20):  # each spring goes a part of the way to its length
        way = wanted[b] - wanted[a]
        pull = way * ((1 - rest / np.linalg.norm(way, axis=1)) / 8)[:, None]
        np.add.at(wanted, a, pull)
        np.add.at(wanted, b, -pull)
    for _ in range(4):  # what would touch stays where it is
        hit = mesh.all_contacts(x, wanted, THICKNESS)
        wanted[hit.vertices] = x[hit.vertices]
    moved = mesh.step(x, wanted, THICKNESS, share=0.2)
    touched += not mesh.is_free(x, moved.positions, THICKNESS)
    made += moved.step
    velocity, x = 0.98 * (moved.positions - x) / DT, moved.positions

print(f"{STEPS} steps of {len(faces)} triangles, {made:.1f} of them made; {touched} touched")
print(f"the cloth lies between {x[is_cloth, 2].min():.2f} m and {x[is_cloth, 2].max():.2f} m")
with open("cloth.obj", "w") as file:
    file.writelines(f"v {p[0]} {p[1]} {p[2]}\n" for p in x)
    file.writelines(f"f {f[0]} {f[1]} {f[2]}\n" for f in faces + 1)
sys.exit(touched)
