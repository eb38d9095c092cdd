"""Continuous collision detection that does not tunnel, on NumPy arrays.

A query is one time step of four points that move on straight lines. ``points``, of shape
``(n, 8, 3)``, holds A, B, C, D of each query at the start of the step, then at its end, in metres.

- ``"edge-edge"``: the moving edges AB and CD. The first side is AB, the second is CD.
- ``"vertex-face"``: the moving vertex A and the moving face BCD. The first side is A, the
  second is BCD.

``radius`` is the distance within which there is contact: one number for all queries, one for each
of shape ``(n,)``, or two of shape ``(n, 2)``, whose sum is meant exactly, such as the radii of two
wires. With 0 contact is a common point.

:func:`decide` is the certified path, for simulators: it misses no contact and invents none, and its
time of impact is the exact one rounded down. Positions at that time are rounded, and may already be
past the contact. :func:`advance` gives positions to store instead: straight motion to them touches
nothing. :class:`Mesh` does the same for whole meshes, whose pairs it finds itself. :func:`exact` is
the oracle in exact arithmetic, by another method. :func:`certify` judges a method of your own
against it on :func:`families` of queries, each of which aims at a weakness; :func:`explain` says
what happens in a query.

All functions release the global interpreter lock and use all cores. Arrays of other types are
converted to ``float64``. Arguments are copied, but for positions of meshes: these are read where
they are, so no other thread may change them during a call. The proofs assume rounding to nearest
and gradual underflow. Each function sets that for itself, on x86-64 and AArch64, and restores what
the calling thread had: a library that switches on flush-to-zero changes no answer.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _tunnelproof
from ._arrays import Bools, Codes, Floats, Kind, query_arrays
from ._kinds import Blocked, ContactKind, Feature
from ._mesh import Mesh, MeshContacts, MeshLimits, MeshStep, NearPairs, Pairs
from ._step import Advances, advance

__all__ = [
    "Advances",
    "Blocked",
    "Case",
    "Certificate",
    "ContactKind",
    "ContactPoints",
    "ExactHits",
    "Family",
    "Feature",
    "Hits",
    "Mesh",
    "MeshContacts",
    "MeshLimits",
    "MeshStep",
    "NearPairs",
    "Pairs",
    "advance",
    "certify",
    "decide",
    "exact",
    "explain",
    "families",
    "merge",
    "queries",
]

__version__ = _tunnelproof.VERSION

Method = Callable[[Kind, Floats, Floats], "tuple[npt.ArrayLike, npt.ArrayLike] | None"]


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
    """The distance of ``normal`` from the exact one is at most this, float64 of shape ``(n,)``."""


@dataclass(frozen=True, eq=False)
class ExactHits:
    """The first contacts of ``n`` queries by the oracle, without the points in space and the
    normal.

    Each exact number is given as the two floats around it, which are equal if it is a float. Where
    ``hit`` is false, floats are NaN, integers 0 and the rest is false. """

    hit: Bools
    """Whether they touch in the step, bool of shape ``(n,)``."""
    toi: Floats
    """The time of impact, float64 of shape ``(n, 2)``."""
    kind: Codes
    """Values of :class:`ContactKind`, of the first contact, int8 of shape ``(n,)``."""
    crosses: Bools
    """Whether any contact of the step, the first or a later one, is a crossing, bool of shape
    ``(n,)``.

    Then a method that reports no contact lets them tunnel."""
    side: Codes
    """The side they come from, as in :class:`Hits`, int8 of shape ``(n,)``."""
    weights: Floats
    """Where they touch, float64 of shape ``(n, 2, 2)``: of two edges the weights of B and of D,
    which are u and v; of a face those of C and of D."""


class Family(NamedTuple):
    """A seeded, endless sequence of queries that probe one property."""

    name: str
    kind: Kind
    description: str


def decide(kind: Kind, points: npt.ArrayLike, radius: npt.ArrayLike = 0.0) -> Hits:
    """Whether and when the two sides of each query touch, by the certified path.

    :param kind: ``"edge-edge"`` or ``"vertex-face"``.
    :param points: shape ``(n, 8, 3)``: A, B, C, D at the start, then at the end, in metres.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :raises ValueError: for other kinds and shapes, and for a number that is not finite or a radius
        below 0, which is named.

    >>> falling = [[-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1],
    ...            [-1, 0, 0], [1, 0, 0], [0.5, -1, -3], [0.5, 1, -3]]
    >>> hits = decide("edge-edge", [falling])
    >>> hits.hit, hits.toi, hits.first.point
    (array([ True]), array([0.25]), array([[0.5, 0. , 0. ]]))
    >>> hits.normal.round(9) + 0.0
    array([[0., 0., 1.]])
    """
    columns = _tunnelproof.decide(kind, *query_arrays(points, radius))
    first, second = (
        ContactPoints(columns.pop(f"{name}_weights"), columns.pop(f"{name}_point"))
        for name in ("first", "second")
    )
    return Hits(first=first, second=second, **columns)


def exact(kind: Kind, points: npt.ArrayLike, radius: npt.ArrayLike = 0.0) -> ExactHits:
    """The exact answers, by the oracle: rational and real algebraic numbers, some microseconds
    each.

    :param kind: ``"edge-edge"`` or ``"vertex-face"``.
    :param points: shape ``(n, 8, 3)``: A, B, C, D at the start, then at the end, in metres.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :raises ValueError: for other kinds and shapes, and for a number that is not finite or a radius
        below 0, which is named. """
    columns = _tunnelproof.exact(kind, *query_arrays(points, radius))
    weights = columns.pop("weights").reshape(-1, 2, 2)
    return ExactHits(weights=weights, **columns)


def families() -> list[Family]:
    """All families of queries."""
    return [Family(*family) for family in _tunnelproof.families()]


def queries(family: str, count: int, *, seed: int = 1, start: int = 0) -> tuple[Floats, Floats]:
    """Queries ``start`` to ``start + count - 1`` of a family.

    :returns: points of shape ``(count, 8, 3)`` and radii of shape ``(count, 2)``; the same
        everywhere.
    :raises ValueError: if there is no such family.
    """
    return _tunnelproof.family(family, seed, start, count)


@dataclass(frozen=True, eq=False)
class Certificate:
    """The result of :func:`certify`."""

    json: str
    """All that was found, as ``tunnelproof certify --json`` writes it."""
    text: str
    """The summary: a line for each subject, and the worst witness of each fault."""
    details: str
    """The same with every family."""
    html: str
    """A page without other files, with pictures of the worst."""

    @property
    def results(self) -> dict[str, Any]:
        """:attr:`json` as Python objects; ``reference/schema/certificate.json`` is its schema."""
        results: dict[str, Any] = json.loads(self.json)
        return results

    @property
    def failures(self) -> list[str]:
        """Why the method fails within its tolerance; empty if it passes."""
        failures: list[str] = self.results["failures"]
        return failures

    @property
    def exact_failures(self) -> list[str]:
        """Why the method would fail without a tolerance; empty if it would pass."""
        failures: list[str] = self.results["exact_failures"]
        return failures


def certify(
    method: Method,
    *,
    name: str = "method",
    families: Iterable[str] | None = None,
    own: Mapping[str, tuple[Kind, npt.ArrayLike, npt.ArrayLike]] | None = None,
    count: int = 1000,
    seed: int = 1,
    near: float = 0.0,
    late: float = 0.0,
    shard: tuple[int, int] = (1, 1),
) -> Certificate:
    """Judges a method against the exact answers.

    :param method: called as ``method(kind, points, radii)`` with some queries, ``points`` of shape
        ``(n, 8, 3)`` and ``radii`` of shape ``(n, 2)``, from any thread. Returns ``hit`` and
        ``toi``, each of shape ``(n,)``; ``toi`` counts where ``hit`` is true. ``None`` says that
        it does not take such queries. An exception counts as no answer to the query that raises it
        by itself.
    :param name: its name in tables.
    :param families: names of :func:`families`; by default those of edges without a radius, or, for
        a method that does not take these, all that it takes; none if there are queries of your
        own.
    :param own: queries of your own by a name: kind, points and radius, as :func:`exact` takes
        them.
    :param count: how many queries of each family.
    :param seed: the seed of the families.
    :param near: the tolerance that the method declares: a hit of two that come only within this
        distance, in metres, does not fail it.
    :param late: the same for times of impact that are late by no more than this part of the step.
    :param shard: the part to judge, ``(i, n)`` with ``i`` from 1 to ``n``; :func:`merge` puts all
        parts together.
    :raises ValueError: if there is no such family or part, a tolerance is not a number from 0, or
        one of your own queries is not valid.

    >>> def blind(kind, points, radii):
    ...     return np.zeros(len(points), bool), np.zeros(len(points))
    >>> certify(blind, name="blind", families=["uniform"], count=100).failures
    ['blind: 19 tunnels']
    """

    rows = [
        (key, kind, *query_arrays(points, radius)) for key, (kind, points, radius) in (own or {}).items()
    ]
    return Certificate(
        *_tunnelproof.certify(
            _checked(method),
            name,
            near,
            late,
            None if families is None else list(families),
            rows,
            count,
            seed,
            shard,
        )
    )


def explain(query: str, method: Method | None = None) -> str:
    """A query explained in words and numbers, and what every subject says of it.

    :param query: its name, such as ``"lattice:1:4711"``, or the query as a line of JSON.
    :param method: a method to ask besides, as :func:`certify` takes it.
    :raises ValueError: if there is no such query.

    >>> print(explain("lattice:1:4711").splitlines()[0])
    lattice:1:4711
    """
    name = getattr(method, "__name__", "method")
    return _tunnelproof.explain(query, None if method is None else (name, _checked(method)))


def _checked(method: Method) -> Callable[..., tuple[Bools, Floats] | None]:
    """The method, its answers converted, with an error for other shapes."""

    def call(kind: Kind, points: Floats, radii: Floats) -> tuple[Bools, Floats] | None:
        answer = method(kind, points, radii)
        if answer is None:
            return None
        hit = np.asarray(answer[0], dtype=np.bool_)
        toi = np.asarray(answer[1], dtype=np.float64)
        if hit.shape != (len(points),) or toi.shape != hit.shape:
            raise ValueError(
                f"hit and toi have the shapes {hit.shape} and {toi.shape}, not ({len(points)},)"
            )
        return hit, toi

    return call


def merge(parts: Iterable[str]) -> Certificate:
    """The certificate of the whole, from :attr:`Certificate.json` of all its parts, in any order.

    It is the result of :func:`certify` without parts, to the last byte.

    :raises ValueError: if a part is of another certification, given twice, or missing.
    """
    return Certificate(*_tunnelproof.merge(list(parts)))
