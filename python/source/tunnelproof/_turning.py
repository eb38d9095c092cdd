"""Bodies that turn within the step."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from . import _tunnelproof
from ._arrays import Floats, TurningKind, radius_array, reals
from ._hits import Hits

_SHAPES = {
    "edge-turning-edge": (4, 2, 2),
    "vertex-turning-face": (2, 3, 2),
    "turning-edge-turning-edge": (0, 4, 4),
    "turning-vertex-turning-face": (0, 4, 4),
}
"""How many points there are in space, at both ends of the step, how many of bodies, and how many poses."""


def decide_rigid(
    kind: TurningKind,
    points: npt.ArrayLike | None,
    local: npt.ArrayLike,
    poses: npt.ArrayLike,
    radius: npt.ArrayLike = 0.0,
) -> Hits:
    """Whether and when an edge or a vertex touches an edge or a face of a rigid body that turns, by
    the certified path. It may be of another body that turns.

    A point p of the body's frame is at ``c + R(q) p``. Within the step the centre c and the
    quaternion q both change at constant rates, so that the body passes through both poses exactly
    as they are given. Quaternions may have any length but 0; q and -q mean the same, and the
    shorter turn is taken.

    :param kind: ``"edge-turning-edge"``: the edge AB moves on straight lines, the edge CD is one of
        the body. ``"vertex-turning-face"``: the vertex A moves on a straight line, the face BCD is
        one of the body.
        ``"turning-edge-turning-edge"`` and ``"turning-vertex-turning-face"``: AB or A is of a body too.
    :param points: those in space at the start, then at the end, in metres: shape ``(n, 4, 3)``, A, B,
        A, B; or ``(n, 2, 3)``, A, A. Of two bodies ``None``.
    :param local: those in the body's frame, in metres: shape ``(n, 2, 3)``, C and D; or
        ``(n, 3, 3)``, B, C and D. Of two bodies ``(n, 4, 3)``, each in the frame of its own.
    :param poses: shape ``(n, 2, 7)``, or ``(2, 7)`` for one body of all queries: at the start, then at
        the end, x, y, z of the centre in metres and w, x, y, z of the quaternion. Of two bodies
        ``(n, 4, 7)`` or ``(4, 7)``: those of the first one, then those of the second one.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :returns: as :func:`decide`, points and normals in space. The error of a place is at most
        ``2**-50``.
    :raises ValueError: for other kinds and shapes, for a number that is not finite, a radius below 0,
        a quaternion that is 0, and a body that turns by more than 90 degrees; says which.

    A rod turns by 90 degrees about z, through a wire at 45:

    >>> wire = [[1, 1, -1], [1, 1, 1]]
    >>> rod = [[0, 0, 0], [2, 0, 0]]
    >>> poses = [[0, 0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0, 1]]
    >>> hits = decide_rigid("edge-turning-edge", [wire + wire], [rod], poses)
    >>> hits.hit, hits.first.point
    (array([ True]), array([[1., 1., 0.]]))
    >>> hits.normal.round(9) + 0.0
    array([[ 0.70710678, -0.70710678,  0.        ]])
    >>> float(hits.toi[0])      # the square root of 2, less 1, rounded down
    0.41421356237309503
    """
    if kind not in _SHAPES:
        *names, last = (f'"{name}"' for name in _SHAPES)
        raise ValueError(f'kind is "{kind}", not {", ".join(names)} or {last}')
    in_space, of_bodies, number_of_poses = _SHAPES[kind]
    if in_space == 0:
        if points is not None:
            raise ValueError(f"points are given, but {kind} has none in space: give None")
        of_local = _array("local", local, (of_bodies, 3))
        count = len(of_local)
        of_points = np.empty((count, 0, 3))
    else:
        if points is None:
            raise ValueError(f"points are None, but {kind} has some in space")
        of_points = _array("points", points, (in_space, 3))
        count = len(of_points)
        of_local = _array("local", local, (of_bodies, 3), count)
    of_poses = reals("poses", poses)
    if of_poses.shape == (number_of_poses, 7):
        of_poses = np.broadcast_to(of_poses, (count, number_of_poses, 7))
    of_poses = _array("poses", of_poses, (number_of_poses, 7), count)
    radii = radius_array(radius, count)
    return Hits._of(_tunnelproof.decide_rigid(kind, of_points, of_local, of_poses, radii))


def _array(
    name: str, values: npt.ArrayLike, shape: tuple[int, int], count: int | None = None
) -> Floats:
    array = reals(name, values)
    first = array.shape[0] if count is None and array.ndim == 3 else count
    if array.shape != (first, *shape):
        rows = "n" if count is None else count
        raise ValueError(
            f"{name} have the shape {array.shape}, not ({rows}, {shape[0]}, {shape[1]})"
        )
    return array
