"""The text of the functions that are proved by hand, as it was when they were."""

import re
from pathlib import Path

from engine import HERE
from claims import BY_HAND

KEPT = Path(__file__).resolve().parent / "by_hand.txt"


def name_of(file, of, name):
    return f"{file}.rs {of + '::' if of else ''}{name}"


def texts(engine):
    """Each function's text, without comments."""
    found = {}
    for file, of, name in BY_HAND:
        source = engine.sources.file(f"{HERE}{file}.rs")
        function = source.functions.get((of, name))
        found[name_of(file, of, name)] = function.text() if function else "(gone)"
    return found


def keep(engine):
    KEPT.write_text("".join(f"{name}\n    {text}\n" for name, text in texts(engine).items()))


def changed(engine):
    """The functions of which the text is another one."""
    kept = dict(re.findall(r"^(\S.*)\n    (.*)$", KEPT.read_text(), re.M))
    now = texts(engine)
    return [name for name in now if kept.get(name) != now[name]] + [name for name in kept if name not in now]
