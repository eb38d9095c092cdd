"""Types of arrays, and what makes sure of their shapes."""

from __future__ import annotations

import operator
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

Kind = Literal["edge-edge", "vertex-face"]
TurningKind = Literal[
    "edge-turning-edge",
    "vertex-turning-face",
    "turning-edge-turning-edge",
    "turning-vertex-turning-face",
]
Precision = Literal["f64", "f32"]
Floats = npt.NDArray[np.float64]
Singles = npt.NDArray[np.float32]
Ends: TypeAlias = "tuple[Floats, Floats] | tuple[Singles, Singles]"
Bools = npt.NDArray[np.bool_]
Codes = npt.NDArray[np.int8]
Indices = npt.NDArray[np.uint32]
Places = npt.NDArray[np.intp]


def reals(name: str, values: npt.ArrayLike) -> Floats:
    """Numbers as float64, where they are if they are that already. No complex ones, and no texts."""
    return np.asarray(_reals(name, values), dtype=np.float64)


def _reals(name: str, values: npt.ArrayLike) -> npt.NDArray[Any]:
    array = np.asarray(values)
    if array.dtype.kind not in "biufO":
        raise ValueError(f"{name}: {array.dtype} is no type of real numbers")
    return array


def whole(name: str, value: int) -> int:
    """A number that is counted by, below 2**64."""
    number = operator.index(value)
    if not 0 <= number < 2**64:
        raise ValueError(f"{name} is {number}, not a number from 0 to 2**64 - 1")
    return number


def query_arrays(points: npt.ArrayLike, radius: npt.ArrayLike) -> tuple[Floats, Floats]:
    """Points and radii in the shapes that the extension takes."""
    of_points = reals("points", points)
    if of_points.ndim != 3 or of_points.shape[1:] != (8, 3):
        raise ValueError(f"points have the shape {of_points.shape}, not (n, 8, 3)")
    return of_points, radius_array(radius, len(of_points))


def radius_array(
    radius: npt.ArrayLike, count: int, same: bool = False, name: str = "radius"
) -> Floats:
    """Two numbers for each of so many queries, whose sum is their radius. If one for all is taken
    as well, these are only two if they are the ``same``."""
    of_radii = reals(name, radius)
    if of_radii.shape not in [(), (count,), (count, 2)]:
        raise ValueError(
            f"{name} has the shape {of_radii.shape}, not (), ({count},) or ({count}, 2)"
        )
    if same and of_radii.ndim == 0:
        count = 1
    if of_radii.ndim < 2:
        single = np.broadcast_to(of_radii, (count,))
        of_radii = np.stack([single, np.zeros(count)], axis=1)
    return of_radii


def position_arrays(
    start: npt.ArrayLike, end: npt.ArrayLike, precision: Precision | None = None
) -> Ends:
    """Positions at both ends of a step, where they are if they have the type of the step and lie in
    the order of C; else copies that do."""
    arrays = [_reals("start", start), _reals("end", end)]
    for name, array in zip(["start", "end"], arrays):
        if array.ndim != 2 or array.shape[1] != 3:
            raise ValueError(f"{name} has the shape {array.shape}, not (n, 3)")
    if is_single(precision, *arrays):
        return singles("start", arrays[0]), _require(arrays[1], np.float32)
    return _require(arrays[0], np.float64), _require(arrays[1], np.float64)


def is_single(precision: Precision | None, *arrays: npt.ArrayLike) -> bool:
    """Whether a step stores positions as float32: as it is told, or else if all that come in are that."""
    if precision is None:
        return all(np.asarray(array).dtype.type is np.float32 for array in arrays)
    if precision not in ("f64", "f32"):
        raise ValueError(f'precision is "{precision}", neither "f64" nor "f32"')
    return precision == "f32"


def singles(name: str, numbers: npt.NDArray[Any]) -> Singles:
    """Numbers as float32, where they are if they are that already. None is rounded."""
    single = _require(numbers, np.float32)
    if numbers.dtype.type is not np.float32:
        # NaN is refused elsewhere.
        differs = (numbers != single) & ~np.isnan(single)
        if differs.any():
            where = tuple(np.argwhere(differs)[0])
            place = "".join(f"[{index}]" for index in where)
            raise ValueError(f"{name}{place} is {numbers[where]}, which is no float32")
    return single


def _require(array: npt.NDArray[Any], dtype: npt.DTypeLike) -> npt.NDArray[Any]:
    # What is beyond float32 becomes infinite, and is refused as such.
    with np.errstate(over="ignore"):
        return np.require(array, dtype=dtype, requirements=["C", "A"])


def index_array(name: str, indices: npt.ArrayLike, shape: tuple[int, ...]) -> Indices:
    """Indices of 32 bits. In the shape, -1 stands for any length."""
    array = np.asarray(indices)
    if array.size == 0:
        return np.zeros([0 if length < 0 else length for length in shape], np.uint32)
    if array.dtype.kind not in "iu":
        raise ValueError(f"{name} are of type {array.dtype}, not integers")
    if array.ndim != len(shape) or array.shape[1:] != shape[1:]:
        expected = ", ".join("n" if length < 0 else str(length) for length in shape)
        raise ValueError(f"{name} have the shape {array.shape}, not ({expected})")
    beyond = (array < 0) | (array > np.iinfo(np.uint32).max)
    if beyond.any():
        where = tuple(np.argwhere(beyond)[0])
        place = "".join(f"[{index}]" for index in where)
        raise ValueError(f"{name}{place} is {array[where]}, which is no index of 32 bits")
    return np.require(array, dtype=np.uint32, requirements=["C", "A"])
