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
nothing. :func:`decide_pairs` and :func:`advance_pairs` take queries that share points by their
indices. :class:`Mesh` does the same for whole meshes, whose pairs it finds itself.
:func:`decide_rigid` is the certified path for rigid bodies that turn within the step. :func:`exact`
is the oracle in exact arithmetic, by another method. :func:`certify` judges a method of your own
against it on :func:`families` of queries, each of which aims at a weakness. :func:`explain` says
what happens in one :class:`Query`, :func:`shrink` finds the smallest one on which a method is still
wrong, and :func:`gap` says how near a miss was. :func:`simulate` runs scenes of wires. Notebooks draw
queries and results, and ``plot()`` gives the picture of what has one.

All functions release the global interpreter lock and use all cores. Ctrl-C ends a call on many
queries soon. Arrays of other types are converted to ``float64``; complex numbers are refused.
Arguments are copied, but for positions of meshes and of pairs by index: these may be ``float32``, and
are read where they are, so no other thread may change them during a call. The proofs assume rounding to nearest and
gradual underflow. Each function sets that for itself, on x86 with SSE2 and AArch64, and restores
what the calling thread had: a library that switches on flush-to-zero changes no answer.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _tunnelproof
from ._arrays import (
    Bools,
    Codes,
    Floats,
    Kind,
    Places,
    index_array,
    position_arrays,
    query_arrays,
    radius_array,
    whole,
)
from ._hits import Case, ContactPoints, Hits
from ._html import Picture, frame
from ._kinds import Blocked, ContactKind, Feature
from ._mesh import Mesh, MeshContacts, MeshLimits, MeshStep, NearPairs, Pairs
from ._pairs import ListedPairs, NearListedPairs, PairsLimits, PairsStep, advance_pairs
from ._query import Explanation, Method, Query, Shrunk, checked, explain, gap, query, shrink
from ._simulate import Simulation, scenes, simulate
from ._step import Advances, advance
from ._turning import decide_rigid

__all__ = [
    "Advances",
    "Blocked",
    "Case",
    "Certificate",
    "ContactKind",
    "ContactPoints",
    "ExactHits",
    "Explanation",
    "Family",
    "Feature",
    "Hits",
    "ListedPairs",
    "Mesh",
    "MeshContacts",
    "MeshLimits",
    "MeshStep",
    "NearListedPairs",
    "NearPairs",
    "Pairs",
    "PairsLimits",
    "PairsStep",
    "Picture",
    "Query",
    "Shrunk",
    "Simulation",
    "advance",
    "advance_pairs",
    "certify",
    "decide",
    "decide_pairs",
    "decide_rigid",
    "exact",
    "explain",
    "families",
    "gap",
    "merge",
    "queries",
    "query",
    "scenes",
    "shrink",
    "simulate",
]

__version__ = _tunnelproof.VERSION


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
    return Hits._of(_tunnelproof.decide(kind, *query_arrays(points, radius)))


def decide_pairs(
    kind: Kind,
    start: npt.ArrayLike,
    end: npt.ArrayLike,
    indices: npt.ArrayLike,
    radius: npt.ArrayLike = 0.0,
) -> tuple[Places, Hits]:
    """Which pairs of points that are shared touch, and when: candidate pairs as a broad phase of
    your own delivers them. :func:`advance_pairs` gives positions to store.

    :param kind: ``"edge-edge"`` or ``"vertex-face"``.
    :param start: the points at the start of the step, of shape ``(m, 3)``, in metres: float64 or
        float32, of the same type as ``end``.
    :param end: the same at its end.
    :param indices: A, B, C and D of each pair, integers of shape ``(n, 4)``.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :returns: the places of the pairs that touch, intp of shape ``(k,)``, in order, and the hits of
        these, which are those of :func:`decide`, to the last bit.
    :raises ValueError: for other kinds and shapes, and for a number that is not finite, a radius
        below 0 or an index that there is not, which is named.

    Points are read where they are, so no other thread may change them during a call.

    >>> start = [[-1, 0, 0], [1, 0, 0], [-1, 2, 0], [1, 2, 0], [0.5, -1, 1], [0.5, 1, 1]]
    >>> end = np.array(start)
    >>> end[4:, 2] -= 4
    >>> pairs, hits = decide_pairs("edge-edge", start, end, [[2, 3, 4, 5], [0, 1, 4, 5]])
    >>> pairs, hits.toi
    (array([1]), array([0.25]))
    """
    of_indices = index_array("indices", indices, (-1, 4))
    places, columns = _tunnelproof.decide_pairs(
        kind,
        position_arrays(start, end),
        of_indices,
        radius_array(radius, len(of_indices), same=True),
    )
    return places, Hits._of(columns)


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
    :raises ValueError: if there is no such family, or for a number below 0.
    :raises MemoryError: if there is no room for so many.
    """
    return _tunnelproof.family(family, whole("seed", seed), whole("start", start), whole("count", count))


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

    def _repr_html_(self) -> str:
        return frame(self.html, 560)


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

    if isinstance(families, str):
        raise TypeError(f'families is "{families}", not a list of names')
    rows = [
        (key, kind, *query_arrays(points, radius)) for key, (kind, points, radius) in (own or {}).items()
    ]
    return Certificate(
        *_tunnelproof.certify(
            checked(method),
            name,
            near,
            late,
            None if families is None else list(families),
            rows,
            whole("count", count),
            whole("seed", seed),
            (whole("shard", shard[0]), whole("shard", shard[1])),
        )
    )


def merge(parts: Iterable[str]) -> Certificate:
    """The certificate of the whole, from :attr:`Certificate.json` of all its parts, in any order.

    It is the result of :func:`certify` without parts, to the last byte.

    :raises ValueError: if a part is of another certification, given twice, or missing.
    """
    texts = list(parts)
    if not texts:
        raise ValueError("no parts are given")
    return Certificate(*_tunnelproof.merge(texts))
