"""Single queries: their pictures, explanations, gaps, and the smallest ones."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from html import escape

import numpy as np
import numpy.typing as npt

from . import _tunnelproof
from ._arrays import Bools, Floats, Kind, query_arrays, reals, whole
from ._html import Picture, image, table

Method = Callable[[Kind, Floats, Floats], "tuple[npt.ArrayLike, npt.ArrayLike] | None"]


def checked(method: Method) -> Callable[..., tuple[Bools, Floats] | None]:
    """The method, its answers converted, with an error for other shapes."""
    if not callable(method):
        raise TypeError(f"the method is {method!r}, which cannot be called")

    def call(kind: Kind, points: Floats, radii: Floats) -> tuple[Bools, Floats] | None:
        answer = method(kind, points, radii)
        if answer is None:
            return None
        hit = np.asarray(answer[0], dtype=np.bool_)
        toi = reals("toi", answer[1])
        if hit.shape != (len(points),) or toi.shape != hit.shape:
            raise ValueError(
                f"hit and toi have the shapes {hit.shape} and {toi.shape}, not ({len(points)},)"
            )
        return hit, toi

    return call


@dataclass(frozen=True, eq=False)
class Query:
    """One query. A notebook draws it.

    :raises ValueError: for other kinds and shapes, and for a number that is not finite or a radius
        below 0, which is named.

    >>> falling = [[-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1],
    ...            [-1, 0, 0], [1, 0, 0], [0.5, -1, -3], [0.5, 1, -3]]
    >>> Query("edge-edge", falling)
    <Query: edge-edge, hit at 0.25>
    """

    kind: Kind
    """``"edge-edge"`` or ``"vertex-face"``."""
    points: Floats
    """A, B, C, D at the start, then at the end, in metres, float64 of shape ``(8, 3)``."""
    radius: Floats = 0.0  # type: ignore[assignment]
    """Two numbers whose exact sum is meant, in metres, float64 of shape ``(2,)``; given as these or
    as one number."""
    name: str = "query"
    """What pictures and explanations call it."""

    def __post_init__(self) -> None:
        points = reals("points", self.points).copy()
        radius = reals("radius", self.radius).copy()
        if points.shape != (8, 3):
            raise ValueError(f"points have the shape {points.shape}, not (8, 3)")
        if radius.shape not in [(), (2,)]:
            raise ValueError(f"radius has the shape {radius.shape}, not () or (2,)")
        one = radius if radius.ndim == 0 else radius[None]
        object.__setattr__(self, "points", points)
        object.__setattr__(self, "radius", query_arrays(points[None], one)[1][0])
        # Numbers that are no query are refused here, not when it is drawn.
        _tunnelproof.decide(*self.arrays)

    @property
    def arrays(self) -> tuple[Kind, Floats, Floats]:
        """What :func:`decide` and others take: the kind, points of shape ``(1, 8, 3)`` and radii of
        shape ``(1, 2)``."""
        return self.kind, self.points[None], self.radius[None]

    def plot(self) -> Picture:
        """What moves from where to where, and where it touches."""
        return Picture(_tunnelproof.draw(self.name, *self.arrays))

    def __repr__(self) -> str:
        columns = _tunnelproof.decide(*self.arrays)
        said = f"hit at {float(columns['toi'][0])!r}" if columns["hit"][0] else "miss"
        parts = " + ".join(repr(part) for part in self.radius.tolist() if part)
        return f"<Query: {self.kind}, {f'radius {parts}, ' if parts else ''}{said}>"

    def _repr_html_(self) -> str:
        return image(self.plot(), repr(self))


def query(text: str) -> Query:
    """A query by its name, as certificates print it, or as a line of JSON.

    :param text: ``"lattice:1:4711"`` (family, seed and number), ``"figure:4.3"``, or
        ``"PATH.jsonl#ID"`` for a query of a file.
    :raises ValueError: if there is no such query.

    >>> query("figure:4.3").kind
    'edge-edge'
    """
    name, kind, (points, radius) = _tunnelproof.locate(text)
    return Query(kind, points, radius, name)


def _one(of: Query | str) -> Query:
    if isinstance(of, str):
        return query(of)
    if not isinstance(of, Query):
        raise TypeError(f"the query is {of!r}, neither a Query nor a name")
    return of


@dataclass(frozen=True, eq=False)
class Explanation:
    """The result of :func:`explain`. A notebook shows the picture and the text."""

    query: Query
    """What is explained."""
    text: str
    """The name of the query, the exact answer, and what each method says."""

    def __str__(self) -> str:
        return self.text

    def plot(self) -> Picture:
        """The picture of the query."""
        return self.query.plot()

    def _repr_html_(self) -> str:
        return f"{self.query._repr_html_()}<pre>{escape(self.text)}</pre>"


def explain(query: Query | str, method: Method | None = None) -> Explanation:
    """A query explained in words and numbers, and what every subject says of it.

    :param query: a query, or what :func:`query` takes.
    :param method: a method to ask besides, as :func:`certify` takes it.
    :raises ValueError: if there is no such query.

    >>> print(explain("lattice:1:4711").text.splitlines()[0])
    lattice:1:4711
    """
    one = _one(query)
    own = None if method is None else (getattr(method, "__name__", "method"), checked(method))
    return Explanation(one, f"{one.name}\n\n{_tunnelproof.explain(*one.arrays, own)}")


@dataclass(frozen=True, eq=False)
class Shrunk:
    """The result of :func:`shrink`."""

    fault: str
    """What the method gets wrong, such as ``"tunnel"``."""
    query: Query
    """The smallest query found on which it still does."""
    calls: int
    """How many queries were tried."""
    is_minimal: bool
    """Whether no step of the search leads to a smaller one; ``False`` if the calls were used up."""

    def _repr_html_(self) -> str:
        names = [corner + when for when in ("", "'") for corner in "ABCD"]
        rows = [(name, *point) for name, point in zip(names, self.query.points.tolist())]
        caption = f"{self.fault}, after {self.calls} queries; ' is at the end of the step"
        return self.query._repr_html_() + table(["", "x", "y", "z"], rows, caption)


def shrink(
    query: Query | str,
    method: Method,
    *,
    near: float = 0.0,
    late: float = 0.0,
    calls: int = 20_000,
) -> Shrunk | None:
    """The smallest query on which a method is wrong in the same way as on this one.

    :param query: a query, or what :func:`query` takes.
    :param method: as :func:`certify` takes it. It is asked one query at a time.
    :param near: the tolerance that the method declares, as for :func:`certify`.
    :param late: the same for times of impact.
    :param calls: how many queries are tried at most.
    :returns: ``None`` if the method is right, or does not take such queries.
    :raises ValueError: if there is no such query, or a tolerance is not a number from 0.

    >>> def blind(kind, points, radii):
    ...     return np.zeros(len(points), bool), np.zeros(len(points))
    >>> shrunk = shrink("uniform:1:9", blind)
    >>> shrunk.fault, shrunk.is_minimal
    ('tunnel', True)
    """
    one = _one(query)
    found = _tunnelproof.shrink(checked(method), near, late, *one.arrays, whole("calls", calls))
    if found is None:
        return None
    fault, (points, radius), tried, is_minimal = found
    return Shrunk(fault, Query(one.kind, points, radius, "shrunk"), tried, is_minimal)


def gap(
    kind: Kind, points: npt.ArrayLike, radius: npt.ArrayLike = 0.0, *, width: float = 1e-9
) -> Floats:
    """How near the two sides of each query come to each other during the step, beyond the radius.

    :param kind: ``"edge-edge"`` or ``"vertex-face"``.
    :param points: shape ``(n, 8, 3)``: A, B, C, D at the start, then at the end, in metres.
    :param radius: a number, shape ``(n,)``, or shape ``(n, 2)`` for exact sums of two, in metres.
    :param width: how far the two bounds may be apart, in metres. Where float64 has no two numbers
        that are so near to each other, they are neighbours.
    :returns: two proved bounds, in metres, float64 of shape ``(n, 2)``; 0 twice for a hit.
    :raises ValueError: as :func:`decide`, and for a width that is not a number from 0.

    >>> apart = [[-1, 0, 0], [1, 0, 0], [0.5, -1, 1], [0.5, 1, 1]] * 2
    >>> gap("edge-edge", [apart]).round(8)
    array([[1., 1.]])
    """
    return _tunnelproof.gap(kind, *query_arrays(points, radius), float(width))
