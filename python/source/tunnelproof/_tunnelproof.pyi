from collections.abc import Callable
from typing import Any

from ._arrays import Ends, Floats, Indices, Kind, Places, Precision, TurningKind

VERSION: str

class Mesh:
    def __new__(
        cls,
        vertices: int,
        edges: Indices,
        faces: Indices,
        groups: Indices | None,
        left_out: list[tuple[int, int]],
    ) -> Mesh: ...
    @property
    def vertex_count(self) -> int: ...
    @property
    def group_count(self) -> int: ...
    @property
    def edges(self) -> Indices: ...
    @property
    def faces(self) -> Indices: ...
    def first_contact(
        self, ends: Ends, thickness: float | Floats
    ) -> dict[str, Any]: ...
    def all_contacts(
        self, ends: Ends, thickness: float | Floats
    ) -> dict[str, Any]: ...
    def is_free(self, ends: Ends, thickness: float | Floats) -> bool: ...
    def step(
        self,
        ends: Ends,
        thickness: float | Floats,
        clearance: float,
        share: float | None,
    ) -> dict[str, Any]: ...

def advance(
    kind: Kind,
    points: Floats,
    radii: Floats,
    clearance: float,
    share: float | None,
    precision: Precision,
) -> dict[str, Any]: ...

def decide(
    kind: Kind, points: Floats, radii: Floats
) -> dict[str, Any]: ...
def decide_pairs(
    kind: Kind, ends: Ends, indices: Indices, radii: Floats
) -> tuple[Places, dict[str, Any]]: ...
def advance_pairs(
    ends: Ends,
    edges: Indices,
    faces: Indices,
    edge_radii: Floats,
    face_radii: Floats,
    clearance: float,
    share: float | None,
) -> dict[str, Any]: ...
def exact(
    kind: Kind, points: Floats, radii: Floats
) -> dict[str, Any]: ...
def families() -> list[tuple[str, Kind, str]]: ...
def family(
    name: str, seed: int, start: int, count: int
) -> tuple[Floats, Floats]: ...
def certify(
    call: Callable[..., Any],
    name: str,
    near: float,
    late: float,
    families: list[str] | None,
    own: list[tuple[str, Kind, Floats, Floats]],
    count: int,
    seed: int,
    shard: tuple[int, int],
) -> tuple[str, str, str, str]: ...
def merge(parts: list[str]) -> tuple[str, str, str, str]: ...
def decide_rigid(
    kind: TurningKind, points: Floats, local: Floats, poses: Floats, radii: Floats
) -> dict[str, Any]: ...
def draw(title: str, kind: Kind, points: Floats, radii: Floats) -> str: ...
def explain(
    kind: Kind, points: Floats, radii: Floats, method: tuple[str, Callable[..., Any]] | None
) -> str: ...
def gap(kind: Kind, points: Floats, radii: Floats, width: float) -> Floats: ...
def locate(text: str) -> tuple[str, Kind, tuple[Floats, Floats]]: ...
def shrink(
    call: Callable[..., Any],
    near: float,
    late: float,
    kind: Kind,
    points: Floats,
    radii: Floats,
    calls: int,
) -> tuple[str, tuple[Floats, Floats], int, bool] | None: ...
class Seen:
    def page(self) -> str: ...
    def frames(self) -> int: ...
    def frame(self, index: int) -> str: ...

def scenes() -> list[str]: ...
def simulate(
    scene: str,
    narrow: str,
    mode: str,
    step: float | None,
    duration: float | None,
    audit: bool,
    beside: str | None,
) -> dict[str, Any]: ...
