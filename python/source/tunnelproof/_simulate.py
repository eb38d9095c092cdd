"""Scenes of wires."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from . import _tunnelproof
from ._arrays import Floats
from ._html import Picture, frame

Narrow = Literal["certified", "thesis", "tuned", "additive", "discrete"]
Mode = Literal["guard", "thesis"]


@dataclass(frozen=True, eq=False)
class Simulation:
    """The result of :func:`simulate`. A notebook plays it."""

    text: str
    """What happened, and what the audit says."""
    json: str
    """The same in figures, as ``tunnelproof simulate --json`` writes it."""
    is_clean: bool | None
    """Whether nothing passed unnoticed, and nothing stands or may stand on the wrong side; ``None``
    without an audit."""
    times: Floats
    """The end of each step in s, float64 of shape ``(n,)``."""
    wires: list[list[Floats]]
    """After each step the nodes of each wire in m, float64 of shape ``(nodes, 3)``. Wires change
    their resolution, so their number varies."""
    _seen: _tunnelproof.Seen

    @property
    def results(self) -> dict[str, Any]:
        """:attr:`json` as Python objects: ``"summary"``, and ``"audit"`` or ``None``."""
        results: dict[str, Any] = json.loads(self.json)
        return results

    @property
    def html(self) -> str:
        """A page to watch the run. It needs no other files."""
        return self._seen.page()

    @property
    def frame_count(self) -> int:
        """How many pictures there are: the start, and the end of each step; of more than 2000 steps
        every second one, or third, and so on."""
        return self._seen.frames()

    def plot(self, frame: int = -1) -> Picture:
        """The picture of a frame; by default of the last one.

        :raises IndexError: if there is no such frame.
        """
        return Picture(self._seen.frame(range(self.frame_count)[frame]))

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        audit = {True: "clean", False: "not clean", None: "not audited"}[self.is_clean]
        return f"<Simulation: {len(self.times)} steps, {audit}>"

    def _repr_html_(self) -> str:
        return frame(self.html, 720)


def _file(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        names = ", ".join(scenes())
        raise FileNotFoundError(f"there is no file {path}, and the scenes are {names}") from None


def scenes() -> list[str]:
    """The names of the scenes that are built in: those of the thesis."""
    return _tunnelproof.scenes()


def simulate(
    scene: str | os.PathLike[str],
    *,
    narrow: Narrow = "certified",
    mode: Mode = "guard",
    step: float | None = None,
    duration: float | None = None,
    audit: bool = True,
    beside: Narrow | None = None,
) -> Simulation:
    """Runs a scene of wires and bodies from start to end.

    :param scene: one of :func:`scenes`, or the path of a scene file in TOML.
    :param narrow: how pairs of segments are tested; ``"discrete"`` looks only at the ends of steps.
    :param mode: what becomes of a crossing: ``"guard"`` prevents it, ``"thesis"`` pushes the wires
        back afterwards.
    :param step: the time step in s, in place of the scene's.
    :param duration: the duration in s, in place of the scene's.
    :param audit: check every step by the exact oracle.
    :param beside: run the scene once more with this narrow phase, and show both beside each other.
        All numbers are those of the first run.
    :raises OSError: if the file cannot be read.
    :raises ValueError: for a scene that is none; names the line.

    >>> run = simulate("basic-collision", duration=0.1)
    >>> run, run.results["summary"]["prevented"]
    (<Simulation: 6 steps, clean>, 8)
    """
    name = os.fspath(scene)
    text = name if name in scenes() else _file(Path(name))
    return Simulation(**_tunnelproof.simulate(text, narrow, mode, step, duration, audit, beside))
