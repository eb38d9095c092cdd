"""Pairs as rows of a table, and steps of all of them."""

from __future__ import annotations

from abc import ABC, abstractmethod

from ._arrays import Codes, Floats
from ._html import table
from ._kinds import Blocked

_SHOWN = 20
"""Rows of a table in a notebook."""


def _counted(pairs: int) -> str:
    return "1 pair" if pairs == 1 else f"{pairs} pairs"


class Rows(ABC):
    """Pairs, each of them a row of columns. ``len()`` is their number."""

    @abstractmethod
    def __len__(self) -> int: ...

    @abstractmethod
    def _pairs(self) -> dict[str, list[str]]:
        """Which pairs they are, as a notebook shows it."""

    def _columns(self) -> dict[str, list[str]]:
        """What a notebook shows beside that."""
        return {}

    def _table(self, caption: str) -> str:
        columns = self._pairs() | self._columns()
        rows = list(zip(*columns.values()))
        left = len(rows) - _SHOWN
        caption += f"; {left} more are not shown" if left > 0 else ""
        return table(list(columns), rows[:_SHOWN], caption)

    def _repr_html_(self) -> str:
        return self._table(_counted(len(self)))


def blocked_column(codes: Codes) -> dict[str, list[str]]:
    """Why pairs end a step, as a notebook shows it."""
    return {"blocked": [Blocked(code).name.lower() for code in codes]}


def kept_column(kept: Floats) -> dict[str, list[str]]:
    """What pairs keep, as a notebook shows it."""
    return {"kept, m": [f"{sum(parts):.6g}" for parts in kept.tolist()]}


def step_html(step: float, limits: Rows, near: Rows, more: str = "") -> str:
    """A step of many pairs, as a notebook shows it."""
    made = "A whole step." if step == 1 else f"{step:.6g} of the step."
    parts = [f"<p>{made}{more}</p>"]
    if len(limits):
        parts.append(limits._table(f"{_counted(len(limits))} that end it"))
    if len(near):
        parts.append(near._table(f"{_counted(len(near))} that start nearer"))
    return "".join(parts)
