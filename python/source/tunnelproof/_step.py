"""The certified step of pairs."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from . import _tunnelproof
from ._arrays import Codes, Floats, Kind, Precision, Singles, is_single, query_arrays, singles
from ._html import table
from ._kinds import Blocked


@dataclass(frozen=True, eq=False)
class Advances:
    """The certified steps of ``n`` queries of either kind."""

    step: Floats
    """How much of the step is made, in ``[0, 1]``, float64 of shape ``(n,)``."""
    points: Floats | Singles
    """A, B, C and D to store, in metres, float64 or float32 of shape ``(n, 4, 3)``: at a step of 1
    the end, at 0 the start, bit for bit."""
    kept: Floats
    """Straight motion from the start to ``points`` keeps a distance above this, in metres, exactly.

    Float64 of shape ``(n, 2)``: the exact sum of two numbers, as a radius is. NaN where no step is
    proved, so that the points stay."""
    blocked: Codes
    """Values of :class:`Blocked`, int8 of shape ``(n,)``; 0 where the step is a whole one."""

    def _repr_html_(self) -> str:
        names = [Blocked(code).name.lower() for code in self.blocked]
        rows = zip(range(len(names)), (f"{step:.6g}" for step in self.step), names)
        return table(["query", "step", "blocked"], list(rows)[:20], f"{len(names)} queries")


def advance(
    kind: Kind,
    points: npt.ArrayLike,
    radius: npt.ArrayLike = 0.0,
    *,
    clearance: float = 0.0,
    share: float | None = None,
    precision: Precision | None = None,
) -> Advances:
    """The largest step, within rounding, that keeps the two sides of each query apart, and the
    positions to store.

    Straight motion from the start to these positions keeps a distance above ``kept``, exactly, in
    real arithmetic. The next step starts at them. So nothing ever passes through anything, however
    many steps follow.

    Two sides that start nearer than the radius and the clearance keep nine tenths of what they have
    beyond the radius, or of their distance if they start within the radius; where rounding leaves
    no room even for that, they keep the radius, or do not touch. They are free to part.

    :param kind: ``"edge-edge"`` or ``"vertex-face"``.
    :param points: shape ``(n, 8, 3)``: A, B, C, D at the start, then at the end, in metres.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :param clearance: what is kept beyond the radius, in metres.
    :param share: instead of a clearance. Two sides that would come within the radius keep this
        share of what they have beyond it at the start; from 0 to below 1.
    :param precision: the numbers that positions are stored in. Without it these are float32 if the
        positions that come in are, at both ends, else float64. With ``"f32"`` the end is rounded to
        float32 first, and the start has to be float32 numbers, of whatever type. The guarantee is
        about the numbers that are returned. In float32 there is less room: two sides that are nearer
        than some 2**-21 of their coordinates, beyond what they keep, may be :attr:`Blocked.ROUNDING`.
    :raises ValueError: as :func:`decide`, for a clearance or a share that means nothing, for another
        precision, and for a start that is not in it.

    >>> falling = [[-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1],
    ...            [-1, 0, 0], [1, 0, 0], [0.5, -1, -3], [0.5, 1, -3]]
    >>> moved = advance("edge-edge", [falling], clearance=0.2)
    >>> moved.step.round(9), moved.points[0, 2].round(9)
    (array([0.2]), array([ 0.5, -1. ,  0.2]))
    """
    single = is_single(precision, points)
    of_points, of_radii = query_arrays(points, radius)
    if single:
        singles("points", of_points[:, :4])
    name: Precision = "f32" if single else "f64"
    columns = _tunnelproof.advance(kind, of_points, of_radii, float(clearance), share, name)
    stored = columns.pop("points").reshape(-1, 4, 3)
    # What starts at a float32 is stored as one.
    stored = stored.astype(np.float32) if single else stored
    return Advances(points=stored, **columns)
