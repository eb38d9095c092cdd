"""The certified step of pairs by the indices of their points."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _tunnelproof
from ._arrays import (
    Codes,
    Floats,
    Places,
    Precision,
    Singles,
    index_array,
    position_arrays,
    radius_array,
)
from ._rows import Rows, blocked_column, kept_column, step_html

_KINDS = np.array(["edge-edge", "vertex-face"])
"""The kinds of pairs by their codes."""


@dataclass(frozen=True, eq=False)
class ListedPairs(Rows):
    """``n`` pairs by their places in two lists. ``len()`` is ``n``."""

    kind: npt.NDArray[np.str_]
    """Which list: ``"edge-edge"`` or ``"vertex-face"``, of shape ``(n,)``."""
    index: Places
    """The place in it, from 0, intp of shape ``(n,)``."""

    def __len__(self) -> int:
        return len(self.index)

    def _pairs(self) -> dict[str, list[str]]:
        return {"kind": self.kind.tolist(), "pair": [str(index) for index in self.index]}


@dataclass(frozen=True, eq=False)
class PairsLimits(ListedPairs):
    """The pairs that end a step."""

    blocked: Codes
    """Why they do: values of :class:`Blocked`, int8 of shape ``(n,)``."""

    def _columns(self) -> dict[str, list[str]]:
        return blocked_column(self.blocked)


@dataclass(frozen=True, eq=False)
class NearListedPairs(ListedPairs):
    """The pairs that keep less than they should."""

    kept: Floats
    """They keep a distance above this, in metres: the exact sum of two numbers, float64 of shape
    ``(n, 2)``."""

    def _columns(self) -> dict[str, list[str]]:
        return kept_column(self.kept)


@dataclass(frozen=True, eq=False)
class PairsStep:
    """A step of all points of pairs that is proved."""

    step: float
    """How much of the step is made, from 0 to 1."""
    positions: Floats | Singles
    """The positions to store, of all points, in metres, float64 or float32 of shape ``(m, 3)``: at a
    step of 1 the end, at 0 the start, bit for bit."""
    limits: PairsLimits
    """The pairs for which the step is no larger, edges first, in order; none if it is a whole one."""
    near: NearListedPairs
    """The pairs that keep less than the radius and the clearance, in order, as they start nearer or
    as rounding leaves no room for more."""

    def _repr_html_(self) -> str:
        return step_html(self.step, self.limits, self.near)


def advance_pairs(
    start: npt.ArrayLike,
    end: npt.ArrayLike,
    edges: npt.ArrayLike,
    faces: npt.ArrayLike,
    *,
    edge_radius: npt.ArrayLike = 0.0,
    face_radius: npt.ArrayLike = 0.0,
    clearance: float = 0.0,
    share: float | None = None,
    precision: Precision | None = None,
) -> PairsStep:
    """The largest step, within rounding, of all points that keeps all pairs apart by more than their
    radius and the clearance, and the positions to store.

    Straight motion of all points from ``start`` to these positions keeps each pair that does not
    touch at the start farther apart than that, exactly, in real arithmetic. A pair that starts nearer
    keeps nine tenths of what it has beyond the radius, or of its distance if it starts within the
    radius; where rounding leaves no room even for that, it keeps the radius, or does not touch. It is
    free to part, and named in :attr:`PairsStep.near`.

    A pair that is in neither list stays apart as well, if the boxes around its two sides are farther
    apart, along an axis, than its radius and the clearance. The box of a side is around all its
    points, at the start and at the end together. Your broad phase has to see to that, with its
    rounding outward. The next step starts at the stored positions, with new lists. So nothing passes
    through anything in these pairs, however many steps follow. Steps of parts of the lists are no
    step of the whole.

    The step is 0 if a pair touches at the start, radius or not, or if rounding leaves no room to any
    step tried. :attr:`PairsStep.limits` names the pairs. Two sides that share a point touch always:
    leave them out. Where :attr:`Blocked.ROUNDING` ends a step, it may be as small as some rounding errors,
    so do not wait for 0. Part these pairs, or let them move otherwise.

    :param start: all points at the start of the step, of shape ``(m, 3)``, in metres. If they and
        those of ``end`` are float32, so are the positions to store.
    :param end: the same at its end.
    :param edges: pairs of edges: A, B, C and D of each, integers of shape ``(n, 4)``. ``[]`` if there
        are none.
    :param faces: the same of pairs of a vertex and a face.
    :param edge_radius: the radius of pairs of edges: a number, shape ``(n,)``, or shape ``(n, 2)`` for
        exact sums of two, in metres.
    :param face_radius: the same of pairs of a vertex and a face.
    :param clearance: what is kept beyond the radius, in metres.
    :param share: instead of a clearance. A pair that would come within the radius keeps this share of
        what it has beyond it at the start; from 0 to below 1.
    :param precision: the numbers that positions are stored in, as for :func:`advance`.
    :raises ValueError: for other shapes, for a number that is not finite, a radius below 0, an index
        that there is not, a clearance or a share that means nothing, and for another precision; says
        which.

    Points are read where they are, so no other thread may change them during a call.

    >>> # A hair above another one, and a vertex above a face, all of which fall.
    >>> start = np.array([[-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1],
    ...                   [2, 0, 0], [3, 0, 0], [2, 1, 0], [2.2, 0.3, 0.7]])
    >>> end = start.copy()
    >>> end[[2, 3, 7], 2] -= 1.5
    >>> radii = {"edge_radius": 0.01, "face_radius": 0.01}
    >>> moved = advance_pairs(start, end, [[0, 1, 2, 3]], [[7, 4, 5, 6]], **radii)
    >>> round(moved.step, 6), moved.positions[7].round(6)
    (0.46, array([2.2 , 0.3 , 0.01]))
    >>> print(moved.limits.kind, moved.limits.index)
    ['vertex-face'] [0]
    """
    of_edges, of_faces = index_array("edges", edges, (-1, 4)), index_array("faces", faces, (-1, 4))
    fields = _tunnelproof.advance_pairs(
        position_arrays(start, end, precision),
        of_edges,
        of_faces,
        radius_array(edge_radius, len(of_edges), same=True, name="edge_radius"),
        radius_array(face_radius, len(of_faces), same=True, name="face_radius"),
        float(clearance),
        share,
    )
    limits, near = _named(fields.pop("limits")), _named(fields.pop("near"))
    return PairsStep(limits=PairsLimits(**limits), near=NearListedPairs(**near), **fields)


def _named(columns: dict[str, Any]) -> dict[str, Any]:
    return {**columns, "kind": _KINDS[columns["kind"]]}
