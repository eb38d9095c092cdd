"""Whole meshes."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _tunnelproof
from ._arrays import (
    Codes,
    Ends,
    Floats,
    Indices,
    Precision,
    Singles,
    index_array,
    position_arrays,
    reals,
)
from ._kinds import ContactKind, Feature
from ._rows import Rows, blocked_column, kept_column, step_html


@dataclass(frozen=True, eq=False)
class Pairs(Rows):
    """``n`` pairs of a mesh: of two edges, of an edge or a point and a point, or of a vertex and a
    face. ``len()`` is ``n``."""

    first_feature: Codes
    """What the first side is: values of :class:`Feature`, int8 of shape ``(n,)``."""
    first: Indices
    """Its index in the vertices or in :attr:`Mesh.edges`, uint32 of shape ``(n,)``."""
    second_feature: Codes
    """What the second side is: values of :class:`Feature`, int8 of shape ``(n,)``. It is a face
    where the pair is a vertex and a face."""
    second: Indices
    """Its index in the vertices, in :attr:`Mesh.edges` or in :attr:`Mesh.faces`, uint32 of shape
    ``(n,)``."""
    vertices: Indices
    """The vertices A, B, C and D of the query of each pair, uint32 of shape ``(n, 4)``. A point is
    both ends of its edge."""

    def __len__(self) -> int:
        return len(self.first)

    def _pairs(self) -> dict[str, list[str]]:
        features, indices = (self.first_feature, self.second_feature), (self.first, self.second)
        first, second = (
            [f"{Feature(feature).name.lower()} {index}" for feature, index in zip(*side)]
            for side in zip(features, indices)
        )
        corners = [" ".join(map(str, row)) for row in self.vertices.tolist()]
        return {"first": first, "second": second, "vertices A B C D": corners}


@dataclass(frozen=True, eq=False)
class MeshContacts(Pairs):
    """The first contacts of ``n`` pairs during a step."""

    toi: Floats
    """The largest float that is not above the time of impact, in ``[0, 1]``, float64 of shape
    ``(n,)``. Positions rounded at this time may already be past the contact: :meth:`Mesh.step`
    gives positions to store."""
    toi_above: Floats
    """The smallest float that is not below the time of impact, float64 of shape ``(n,)``."""
    kind: Codes
    """Values of :class:`ContactKind`, exact, int8 of shape ``(n,)``."""
    weights: Floats
    """The weights of A, B, C and D where they touch, in ``[0, 1]``, float64 of shape ``(n, 4)``."""
    point: Floats
    """The point on the first side where they touch at ``toi``, in metres, rounded, float64 of shape
    ``(n, 3)``."""
    normal: Floats
    """The unit vector along which they touch, from the first side to the second, float64 of shape
    ``(n, 3)``; 0 where there is none."""

    def _columns(self) -> dict[str, list[str]]:
        kinds = [ContactKind(kind).name.lower() for kind in self.kind]
        return {"toi": [f"{toi:.6g}" for toi in self.toi], "kind": kinds}


@dataclass(frozen=True, eq=False)
class MeshLimits(Pairs):
    """The pairs that end a step."""

    blocked: Codes
    """Why they do: values of :class:`Blocked`, int8 of shape ``(n,)``."""

    def _columns(self) -> dict[str, list[str]]:
        return blocked_column(self.blocked)


@dataclass(frozen=True, eq=False)
class NearPairs(Pairs):
    """The pairs that start nearer than they should be kept."""

    kept: Floats
    """They keep a distance above this, in metres: the exact sum of two numbers, float64 of shape
    ``(n, 2)``."""

    def _columns(self) -> dict[str, list[str]]:
        return kept_column(self.kept)


@dataclass(frozen=True, eq=False)
class MeshStep:
    """A step of a mesh that is proved."""

    step: float
    """How much of the step is made, from 0 to 1."""
    positions: Floats | Singles
    """The positions to store, in metres, float64 or float32 of shape ``(n, 3)``: at a step of 1 the
    end, at 0 the start, bit for bit."""
    limits: MeshLimits
    """The pairs for which the step is no larger; none if it is a whole one."""
    near: NearPairs
    """The pairs that keep less than the thickness and the clearance, as they start nearer."""
    candidates: tuple[int, int]
    """How many pairs of edges or points, and of a vertex and a face, had swept boxes so near that
    they were looked at."""

    def _repr_html_(self) -> str:
        looked = " and ".join(map(str, self.candidates))
        more = f" {looked} pairs of edges and of vertex and face were looked at."
        return step_html(self.step, self.limits, self.near, more)


class Mesh:
    """Vertices, edges and faces by their indices: cloth, bodies, wires and points.

    Every edge may meet every edge, and every vertex every face. The edges of faces are edges,
    whether they are given or not. A vertex in no edge is a point. Parts that share a vertex never
    meet. Positions come with each question: float64 or float32 of shape ``(vertex_count, 3)``, in
    metres, of the same type in ``start`` and in ``end``. Arrays in the order of C are read where they
    are; others are converted. Every vertex moves on a straight line from its position in ``start`` to
    that in ``end``.

    The thickness is the distance within which there is contact: one number, or one for each group,
    of shape ``(group_count,)``. Two parts of different thickness touch at the mean of both.

    :param edges: indices of vertices, integers of shape ``(n, 2)``.
    :param faces: indices of vertices, integers of shape ``(n, 3)``.
    :param vertex_count: the number of vertices. Without it there are as many as ``groups``, or else
        as the largest index needs: give it if there are points with larger indices.
    :param groups: the group of each vertex, integers from 0 of shape ``(vertex_count,)``. Without
        it all are of group 0.
    :param left_out: pairs of groups that never meet. A static part is a group that is left out with
        itself.
    :raises ValueError: names an index of a vertex or a group that there is not.

    >>> # A triangle, and the vertex 3 that falls through it.
    >>> mesh = Mesh(faces=[[0, 1, 2]], vertex_count=4)
    >>> start = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.25, 0.25, 1.0]])
    >>> end = start - [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 2]]
    >>> mesh.first_contact(start, end).toi
    array([0.5])
    >>> step = mesh.step(start, end, thickness=0.5)
    >>> round(step.step, 9), mesh.is_free(start, step.positions, 0.5)
    (0.25, True)
    """

    def __init__(
        self,
        edges: npt.ArrayLike = (),
        faces: npt.ArrayLike = (),
        *,
        vertex_count: int | None = None,
        groups: npt.ArrayLike | None = None,
        left_out: Iterable[tuple[int, int]] = (),
    ) -> None:
        of_edges = index_array("edges", edges, (-1, 2))
        of_faces = index_array("faces", faces, (-1, 3))
        of_groups = None if groups is None else index_array("groups", groups, (-1,))
        if vertex_count is None:
            counts = [int(array.max()) + 1 for array in (of_edges, of_faces) if array.size]
            if of_groups is not None:
                counts.append(len(of_groups))
            vertex_count = max(counts, default=0)
        if vertex_count < 0:
            raise ValueError(f"vertex_count is {vertex_count}; it has to be 0 or more")
        pairs = index_array("left_out", list(left_out), (-1, 2))
        self._mesh = _tunnelproof.Mesh(
            vertex_count, of_edges, of_faces, of_groups, [(int(g), int(h)) for g, h in pairs]
        )

    @property
    def vertex_count(self) -> int:
        """How many vertices there are."""
        return self._mesh.vertex_count

    @property
    def group_count(self) -> int:
        """How many groups there are: one more than the largest number."""
        return self._mesh.group_count

    @property
    def edges(self) -> Indices:
        """The edges, uint32 of shape ``(n, 2)``: those given, then those of faces that were
        missing."""
        return self._mesh.edges

    @property
    def faces(self) -> Indices:
        """The faces, uint32 of shape ``(n, 3)``."""
        return self._mesh.faces

    def __repr__(self) -> str:
        counts = f"{len(self.edges)} edges, {len(self.faces)} faces"
        return f"<Mesh: {self.vertex_count} vertices, {counts}>"

    def first_contact(
        self, start: npt.ArrayLike, end: npt.ArrayLike, thickness: npt.ArrayLike = 0.0
    ) -> MeshContacts:
        """The contact of the least time of impact: one row, or none if nothing touches.

        Of several with the same ``toi`` it is that of the first pair. None is missed and none is
        false.

        :raises ValueError: if there is not one position for each vertex, a coordinate is not
            finite, or the thickness is not a finite number of at least 0; names which.
        """
        return MeshContacts(**self._mesh.first_contact(*_question(start, end, thickness)))

    def all_contacts(
        self, start: npt.ArrayLike, end: npt.ArrayLike, thickness: npt.ArrayLike = 0.0
    ) -> MeshContacts:
        """The first contact of each pair that touches, in the order of the pairs.

        :raises ValueError: as :meth:`first_contact`.
        """
        return MeshContacts(**self._mesh.all_contacts(*_question(start, end, thickness)))

    def is_free(
        self, start: npt.ArrayLike, end: npt.ArrayLike, thickness: npt.ArrayLike = 0.0
    ) -> bool:
        """Whether no pair touches.

        :raises ValueError: as :meth:`first_contact`.
        """
        return self._mesh.is_free(*_question(start, end, thickness))

    def step(
        self,
        start: npt.ArrayLike,
        end: npt.ArrayLike,
        thickness: npt.ArrayLike = 0.0,
        *,
        clearance: float = 0.0,
        share: float | None = None,
        precision: Precision | None = None,
    ) -> MeshStep:
        """The largest step, within rounding, that keeps all pairs apart by more than the thickness
        and the clearance, and the positions to store.

        Straight motion from ``start`` to these positions keeps each pair farther apart than that,
        exactly, in real arithmetic. The next step starts at them. So nothing ever passes through
        anything, however many steps follow.

        A pair that starts nearer keeps nine tenths of what it has beyond the thickness, or of its
        distance if it starts within the thickness; where rounding leaves no room even for that, it
        keeps the thickness, or does not touch. It is free to part, and named in
        :attr:`MeshStep.near`.

        The step is 0 if a pair touches at the start, thickness or not, or if rounding leaves no
        room to any step tried. :attr:`MeshStep.limits` names the pairs. Do not ask again with the
        same motion.

        :param clearance: what is kept beyond the thickness, in metres.
        :param share: instead of a clearance. A pair that would come within the thickness keeps this
            share of what it has beyond it at the start; from 0 to below 1.
        :param precision: the numbers that positions are stored in, as for :func:`advance`.
        :raises ValueError: as :meth:`first_contact`, for a clearance or a share that means nothing,
            and for another precision.
        """
        question = _question(start, end, thickness, precision)
        fields = self._mesh.step(*question, float(clearance), share)
        limits, near = MeshLimits(**fields.pop("limits")), NearPairs(**fields.pop("near"))
        return MeshStep(limits=limits, near=near, **fields)


def _question(
    start: npt.ArrayLike,
    end: npt.ArrayLike,
    thickness: npt.ArrayLike,
    precision: Precision | None = None,
) -> tuple[Ends, Any]:
    """The arguments of a question as the extension takes them."""
    of_thickness = np.require(reals("thickness", thickness), requirements=["C", "A"])
    if of_thickness.ndim > 1:
        raise ValueError(f"thickness has the shape {of_thickness.shape}, not () or (group_count,)")
    return (
        position_arrays(start, end, precision),
        of_thickness if of_thickness.ndim else float(of_thickness),
    )
