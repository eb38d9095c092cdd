"""A picture of a mesh: `python examples/picture.py cloth.obj cloth.png [VERTICES]`.

Triangles of the first VERTICES vertices are red, the others grey. Every pixel shows what is nearest
to the eye there, which plots of triangles sorted by depth get wrong where cloth folds.
"""

import struct
import sys
import zlib

import numpy as np

WIDTH, HEIGHT, FINE = 960, 720, 2
RED, GREY, WHITE = (0.80, 0.25, 0.20), (0.62, 0.66, 0.70), (1.0, 1.0, 1.0)


def read(path):
    """The vertices and the triangles of an OBJ file."""
    lines = [line.split() for line in open(path)]
    vertices = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=float)
    faces = np.array([line[1:4] for line in lines if line[:1] == ["f"]], dtype=int) - 1
    return vertices, faces


def turned(vertices):
    """To the right, upward and towards the eye, which looks from the front and from above."""
    turn, tilt = np.radians(30), np.radians(28)
    right = np.array([np.cos(turn), np.sin(turn), 0])
    back = np.array([-np.sin(turn), np.cos(turn), 0])
    up = np.cos(tilt) * np.array([0, 0, 1]) + np.sin(tilt) * back
    return (vertices - vertices.mean(axis=0)) @ np.stack([right, up, np.cross(right, up)], axis=1)


def draw(vertices, faces, colours):
    """The pixels, with the nearest triangle at each."""
    width, height = WIDTH * FINE, HEIGHT * FINE
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    scale = 0.92 * min(width / (high - low)[0], height / (high - low)[1])
    middle = (low + high) / 2
    points = (vertices - middle) * [scale, -scale, scale] + [width / 2, height / 2, 0]
    pixels = np.ones((height, width, 3))
    depth = np.full((height, width), -np.inf)
    light = np.array([-0.3, -0.6, 0.75]) / np.linalg.norm([-0.3, -0.6, 0.75])
    for face, colour in zip(faces, colours):
        a, b, c = points[face]
        normal = np.cross(b - a, c - a)
        if normal[2] == 0:
            continue
        left, top = np.maximum(np.floor(np.min([a, b, c], axis=0))[:2], 0).astype(int)
        right, bottom = np.ceil(np.max([a, b, c], axis=0))[:2].astype(int) + 1
        y, x = np.mgrid[top : min(bottom, height), left : min(right, width)] + 0.5
        weight = [
            ((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0])) / normal[2]
            for p, q in ((b, c), (c, a), (a, b))
        ]
        z = weight[0] * a[2] + weight[1] * b[2] + weight[2] * c[2]
        part = np.s_[top : top + y.shape[0], left : left + y.shape[1]]
        shown = (np.min(weight, axis=0) >= 0) & (z > depth[part])
        bright = 0.35 + 0.65 * abs(normal @ light) / np.linalg.norm(normal)
        line = np.min(np.array(weight) * abs(normal[2]), axis=0) < 1.2 * FINE * scale / 90
        depth[part][shown] = z[shown]
        shade = np.where(line, 0.8, 1.0)[..., None] * bright * np.array(colour)
        pixels[part][shown] = shade[shown]
    fine = pixels.reshape(HEIGHT, FINE, WIDTH, FINE, 3)
    return (255 * fine.mean(axis=(1, 3)) + 0.5).astype(np.uint8)


def write(path, pixels):
    """The pixels as a PNG file."""

    def chunk(name, data):
        check = struct.pack(">I", zlib.crc32(name + data))
        return struct.pack(">I", len(data)) + name + data + check

    head = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    parts = [chunk(b"IHDR", head), chunk(b"IDAT", zlib.compress(rows, 9)), chunk(b"IEND", b"")]
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + b"".join(parts))


if __name__ == "__main__":
    vertices, faces = read(sys.argv[1])
    count = int(sys.argv[3]) if len(sys.argv) > 3 else len(vertices)
    colours = [RED if face.max() < count else GREY for face in faces]
    write(sys.argv[2], draw(turned(vertices), faces, colours))
