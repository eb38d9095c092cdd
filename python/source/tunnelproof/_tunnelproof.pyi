from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from . import Kind

VERSION: str

def decide(
    kind: Kind, points: npt.NDArray[np.float64], radii: npt.NDArray[np.float64]
) -> dict[str, Any]: ...
def exact(
    kind: Kind, points: npt.NDArray[np.float64], radii: npt.NDArray[np.float64]
) -> dict[str, Any]: ...
def families() -> list[tuple[str, Kind, str]]: ...
def family(
    name: str, seed: int, start: int, count: int
) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.float64]]: ...
def certify(
    call: Callable[..., Any],
    name: str,
    declared_distance: float,
    families: list[str],
    own: list[tuple[str, Kind, npt.NDArray[np.float64], npt.NDArray[np.float64]]],
    count: int,
    seed: int,
    shard: tuple[int, int],
) -> tuple[str, str, str]: ...
def merge(parts: list[str]) -> tuple[str, str, str]: ...
