"""Continuous collision detection that does not tunnel, on NumPy arrays.

A query is one time step of four points that move on straight lines: ``points`` of shape ``(n, 8, 3)`` holds, for each of
``n`` queries, A, B, C, D at the start of the step and then at its end, in metres.

- Edge-edge: the moving edges AB and CD.
- Vertex-face: the moving vertex A and the moving face BCD.

``radius`` is the distance within which there is contact: one number for all queries, one for each of shape ``(n,)``, or
two of shape ``(n, 2)``, whose sum is meant exactly, as of two wires. With 0 contact is a common point.

:func:`edge_edge` and :func:`vertex_face` are the certified path, for simulators: never wrong, and fast. :func:`exact`
is the oracle in rational arithmetic, by another method. :func:`certify` judges a method of your own against it on
:func:`families` of queries, each of which aims at a weakness.

All functions run without the global interpreter lock and on all cores. What comes in is copied; arrays of other types
are converted to ``float64``.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _tunnelproof

__all__ = [
    "Certificate",
    "EdgeContacts",
    "ExactContacts",
    "FaceContacts",
    "Family",
    "certify",
    "edge_edge",
    "exact",
    "families",
    "merge",
    "queries",
    "vertex_face",
]

__version__ = _tunnelproof.VERSION

Kind = Literal["edge-edge", "vertex-face"]
Floats = npt.NDArray[np.float64]
Bools = npt.NDArray[np.bool_]
Signs = npt.NDArray[np.int8]
Method = Callable[[Kind, Floats, Floats], "tuple[npt.ArrayLike, npt.ArrayLike] | None"]


@dataclass(frozen=True, eq=False)
class EdgeContacts:
    """The first contacts of ``n`` pairs of edges, proved. Where there is none, numbers are NaN, 0 or false."""

    hit: Bools
    """Whether they touch in the step, shape ``(n,)``. No hit is false, no contact is missed."""
    toi: Floats
    """The largest float that is not above the time of impact, in ``[0, 1]``, shape ``(n,)``."""
    toi_above: Floats
    """The smallest float that is not below the time of impact, shape ``(n,)``."""
    first: Floats
    """Where they touch, or with a radius are nearest: u on AB, v on CD, in ``[0, 1]``, shape ``(n, 2)``."""
    second: Floats
    """The other end of the contact where it is a segment, NaN where it is a point, shape ``(n, 2)``."""
    parameter_error: Floats
    """No parameter is farther from the exact one than this, at most ``2**-32``, shape ``(n,)``."""
    crosses: Bools
    """Whether the edges swap sides if the contact is missed, shape ``(n,)``."""
    side: Signs
    """The sign of ``((B - A) x (D - C)) . (C - A)`` just before the contact, shape ``(n,)``; 0 if always 0."""


@dataclass(frozen=True, eq=False)
class FaceContacts:
    """The first contacts of ``n`` vertices and faces, proved. Where there is none, numbers are NaN, 0 or false."""

    hit: Bools
    """Whether they touch in the step, shape ``(n,)``. No hit is false, no contact is missed."""
    toi: Floats
    """The largest float that is not above the time of impact, in ``[0, 1]``, shape ``(n,)``."""
    toi_above: Floats
    """The smallest float that is not below the time of impact, shape ``(n,)``."""
    weights: Floats
    """Where on the face: the weights of B, C and D, in ``[0, 1]``, shape ``(n, 3)``."""
    weight_error: Floats
    """No weight is farther from the exact one than this, at most ``2**-32``, shape ``(n,)``."""
    crosses: Bools
    """Whether the vertex goes through the face if the contact is missed, shape ``(n,)``."""
    side: Signs
    """The sign of ``((C - B) x (D - B)) . (A - B)`` just before the contact, shape ``(n,)``; 0 if always 0."""


@dataclass(frozen=True, eq=False)
class ExactContacts:
    """The first contacts of ``n`` queries by the oracle. Where there is none, numbers are NaN, 0 or false.

    Of each exact number the two floats between which it is are given; they are equal where it is a float.
    """

    hit: Bools
    """Whether they touch in the step, shape ``(n,)``."""
    toi: Floats
    """The time of impact, shape ``(n, 2)``."""
    u: Floats
    """The place on AB; of a face, the weight of C. Shape ``(n, 2)``."""
    v: Floats
    """The place on CD; of a face, the weight of D. Shape ``(n, 2)``."""
    is_crossing: Bools
    """Whether the first contact is a crossing, shape ``(n,)``."""
    crosses: Bools
    """Whether any contact of the step is a crossing: then a method that finds none lets them tunnel. ``(n,)``."""
    side: Signs
    """The side they come from, as in :class:`EdgeContacts` and :class:`FaceContacts`, shape ``(n,)``."""


class Family(NamedTuple):
    """A seeded, endless sequence of queries that probe one property."""

    name: str
    kind: Kind
    description: str


def edge_edge(points: npt.ArrayLike, radius: npt.ArrayLike = 0.0) -> EdgeContacts:
    """Whether and when pairs of moving edges touch, by the certified path.

    :param points: shape ``(n, 8, 3)``: A, B, C, D at the start, then at the end, in metres.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :raises ValueError: for other shapes, and for a number that is not finite or a radius below 0, which is named.

    >>> falling = [[-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1],
    ...            [-1, 0, 0], [1, 0, 0], [0.5, -1, -3], [0.5, 1, -3]]
    >>> contacts = edge_edge([falling])
    >>> contacts.hit, contacts.toi, contacts.first
    (array([ True]), array([0.25]), array([[0.75, 0.5 ]]))
    """
    return EdgeContacts(**_tunnelproof.edge_edge(*_arrays(points, radius)))


def vertex_face(points: npt.ArrayLike, radius: npt.ArrayLike = 0.0) -> FaceContacts:
    """Whether and when moving vertices and faces touch, by the certified path.

    :param points: shape ``(n, 8, 3)``: A, B, C, D at the start, then at the end, in metres.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :raises ValueError: for other shapes, and for a number that is not finite or a radius below 0, which is named.
    """
    return FaceContacts(**_tunnelproof.vertex_face(*_arrays(points, radius)))


def exact(
    points: npt.ArrayLike, radius: npt.ArrayLike = 0.0, kind: Kind = "edge-edge"
) -> ExactContacts:
    """The exact answers, by the oracle: rational arithmetic and real algebraic numbers, some microseconds each.

    :param points: shape ``(n, 8, 3)``: A, B, C, D at the start, then at the end, in metres.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :param kind: ``"edge-edge"`` or ``"vertex-face"``.
    :raises ValueError: for other shapes, and for a number that is not finite or a radius below 0, which is named.
    """
    return ExactContacts(**_tunnelproof.exact(kind, *_arrays(points, radius)))


def families() -> list[Family]:
    """All families of queries."""
    return [Family(*family) for family in _tunnelproof.families()]


def queries(family: str, count: int, *, seed: int = 1, start: int = 0) -> tuple[Floats, Floats]:
    """Queries ``start`` to ``start + count - 1`` of a family.

    :returns: points of shape ``(count, 8, 3)`` and radii of shape ``(count, 2)``; the same everywhere.
    :raises ValueError: if there is no such family.
    """
    return _tunnelproof.family(family, seed, start, count)


@dataclass(frozen=True, eq=False)
class Certificate:
    """What came of certification."""

    json: str
    """All that was found, as ``tunnelproof certify --json`` writes it."""
    text: str
    """The table, with the worst witness of each kind."""
    html: str
    """A page that needs nothing else, with pictures of the worst."""

    @property
    def results(self) -> dict[str, Any]:
        """:attr:`json` as Python objects; ``reference/schema/certificate.json`` is its schema."""
        results: dict[str, Any] = json.loads(self.json)
        return results

    @property
    def failures(self) -> list[str]:
        """What the method fails by; empty if it passes."""
        failures: list[str] = self.results["failures"]
        return failures


def certify(
    method: Method,
    *,
    name: str = "method",
    families: Iterable[str] | None = None,
    own: Mapping[str, tuple[Kind, npt.ArrayLike, npt.ArrayLike]] | None = None,
    count: int = 1000,
    seed: int = 1,
    declared_distance: float = 0.0,
    shard: tuple[int, int] = (1, 1),
) -> Certificate:
    """Judges a method against the exact answers.

    :param method: called as ``method(kind, points, radii)`` with some queries, ``points`` of shape ``(n, 8, 3)`` and
        ``radii`` of shape ``(n, 2)``, from any thread. Returns ``hit`` and ``toi``, each of shape ``(n,)``; ``toi`` counts
        where ``hit`` is true. ``None`` says that it does not take such queries. An exception counts as no answer to the
        query that raises it by itself.
    :param name: what it is called in tables.
    :param families: names of :func:`families`; all if left out.
    :param own: queries of your own by a name: kind, points and radius, as :func:`exact` takes them.
    :param count: how many queries of each family.
    :param seed: which ones.
    :param declared_distance: false hits of two that come as near as this, in metres, count apart.
    :param shard: which part is judged, ``(i, n)`` with ``i`` from 1 to ``n``; :func:`merge` puts all parts together.
    :raises ValueError: if there is no such family or part, or one of your own queries is none.

    >>> def blind(kind, points, radii):
    ...     return np.zeros(len(points), bool), np.zeros(len(points))
    >>> certify(blind, name="blind", families=["uniform"], count=100).failures
    ['blind: 19 tunnels']
    """

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

    chosen = [family for family, _, _ in _tunnelproof.families()] if families is None else families
    rows = [
        (key, kind, *_arrays(points, radius)) for key, (kind, points, radius) in (own or {}).items()
    ]
    return Certificate(
        *_tunnelproof.certify(
            call, name, declared_distance, list(chosen), rows, count, seed, shard
        )
    )


def merge(parts: Iterable[str]) -> Certificate:
    """The certificate of the whole, from :attr:`Certificate.json` of all its parts, in any order.

    It is what :func:`certify` gives without parts, to the last byte.

    :raises ValueError: if a part is of another certification, there twice, or missing.
    """
    return Certificate(*_tunnelproof.merge(list(parts)))


def _arrays(points: npt.ArrayLike, radius: npt.ArrayLike) -> tuple[Floats, Floats]:
    """Points and radii in the shapes that the extension takes."""
    of_points = np.asarray(points, dtype=np.float64)
    if of_points.ndim != 3 or of_points.shape[1:] != (8, 3):
        raise ValueError(f"points have the shape {of_points.shape}, not (n, 8, 3)")
    of_radii = np.asarray(radius, dtype=np.float64)
    count = len(of_points)
    if of_radii.shape not in [(), (count,), (count, 2)]:
        raise ValueError(
            f"radius has the shape {of_radii.shape}, not (), ({count},) or ({count}, 2)"
        )
    if of_radii.ndim < 2:
        single = np.broadcast_to(of_radii, (count,))
        of_radii = np.stack([single, np.zeros(count)], axis=1)
    return of_points, of_radii
