"""What is said of the first contacts of many queries."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Any

from ._arrays import Bools, Codes, Floats


class Case(IntEnum):
    """How the two sides move relative to each other during the whole step. If several hold, the
    last here."""

    GENERAL = 1
    """None of those below."""
    COPLANAR = 2
    """All four points share a plane."""
    PARALLEL = 3
    """The edges are parallel, on two lines."""
    COLLINEAR = 4
    """All four points of two edges share a line."""
    SHARED_START = 5
    """A and C, of two edges, are the same point."""
    DEGENERATE = 6
    """An edge is a point, or the face has no area."""


@dataclass(frozen=True, eq=False)
class ContactPoints:
    """A point of contact of each of ``n`` queries, NaN where there is no hit."""

    weights: Floats
    """The weights of A, B, C and D, in ``[0, 1]``, float64 of shape ``(n, 4)``.

    Of two edges they are ``1 - u, u, 1 - v, v`` with u on AB and v on CD. Of a vertex and a face
    they are 1 and the weights of B, C and D."""
    point: Floats
    """The point on the first side at ``toi``, in metres, rounded, float64 of shape ``(n, 3)``."""


@dataclass(frozen=True, eq=False)
class Hits:
    """The first contacts of ``n`` queries of either kind, by the certified path.

    Where ``hit`` is false, floats are NaN, integers 0 and the rest is false.
    """

    hit: Bools
    """Whether they touch in the step, bool of shape ``(n,)``. No hit is false, no contact is
    missed."""
    toi: Floats
    """The largest float that is not above the time of impact, in ``[0, 1]``, float64 of shape
    ``(n,)``.

    Positions at this time are rounded to floats, and may already be past the contact."""
    toi_above: Floats
    """The smallest float that is not below the time of impact, float64 of shape ``(n,)``."""
    kind: Codes
    """Values of :class:`ContactKind`, of the first contact, exact, int8 of shape ``(n,)``."""
    side: Codes
    """The sign of f just before the contact, exact, int8 of shape ``(n,)``; 0 if always 0, or at
    time 0.

    Of two edges ``f = ((B - A) x (D - C)) . (C - A)``, of a vertex and a face
    ``f = ((C - B) x (D - B)) . (A - B)``."""
    case: Codes
    """Values of :class:`Case`, exact, int8 of shape ``(n,)``."""
    temporarily_parallel: Bools
    """Whether the edges are parallel at the time of impact, or the face is a segment, though not
    for the whole step; bool of shape ``(n,)``."""
    temporarily_point: Bools
    """Whether an edge, or the face, is a point at the time of impact, though not for the whole
    step; bool of shape ``(n,)``."""
    first: ContactPoints
    """Where they touch, or with a radius are nearest."""
    has_second: Bools
    """Whether two edges touch, or are nearest, along a segment from ``first`` to ``second``; bool
    of shape ``(n,)``."""
    second: ContactPoints
    """The other end of that segment; ``first`` again where there is none."""
    place_error: Floats
    """Neither u, v nor a weight of a face's corner is farther from the exact one than this, at
    most ``2**-32``, float64 of shape ``(n,)``."""
    normal: Floats
    """The unit vector along which they touch, from the first side to the second as they are just
    before the contact, float64 of shape ``(n, 3)``; 0 where they share a point at the start of the
    step."""
    normal_error: Floats
    """The distance of ``normal`` from the exact one is at most this, at most ``2**-32``, float64 of
    shape ``(n,)``."""

    @classmethod
    def _of(cls, columns: dict[str, Any]) -> Hits:
        first, second = (
            ContactPoints(columns.pop(f"{name}_weights"), columns.pop(f"{name}_point"))
            for name in ("first", "second")
        )
        return cls(first=first, second=second, **columns)
