"""What notebooks show of an object: tables, pictures and pages."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Sequence
from html import escape

_CELL = "padding:.15rem .6rem;text-align:right;border-bottom:1px solid rgba(128,128,128,.35)"


class Picture(str):
    """A picture: the text of an SVG document. A notebook draws it."""

    def _repr_svg_(self) -> str:
        return str(self)

    def __repr__(self) -> str:
        return f"<Picture: SVG, {len(self)} characters>"


def image(svg: str, description: str) -> str:
    """A picture that is as wide as there is room, at most."""
    data = b64encode(svg.encode()).decode()
    return (
        f'<img style="max-width:100%;height:auto" alt="{escape(description)}" '
        f'src="data:image/svg+xml;base64,{data}">'
    )


def table(heads: Sequence[str], rows: Iterable[Sequence[object]], caption: str) -> str:
    """A table with a caption above it."""
    head = "".join(f'<th style="{_CELL}">{escape(name)}</th>' for name in heads)
    body = "".join(
        "<tr>" + "".join(f'<td style="{_CELL}">{escape(str(cell))}</td>' for cell in row) + "</tr>"
        for row in rows
    )
    return (
        f'<div style="overflow-x:auto"><p>{escape(caption)}</p>'
        f'<table style="border-collapse:collapse"><tr>{head}</tr>{body}</table></div>'
    )


def frame(page: str, height: int) -> str:
    """A whole page in a frame."""
    return f'<iframe style="width:100%;height:{height}px;border:0" srcdoc="{escape(page)}"></iframe>'
