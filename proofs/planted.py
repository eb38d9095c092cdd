"""Faults in the sources, and what refuses them."""

from pathlib import Path

from engine import Engine
from prove import Refused
from tokens import Unknown

ROOT = Path(__file__).resolve().parent.parent
CERTIFIED = "src/certified"

NO_GAPPA = "Gappa is not installed: apt install gappa"

# What a claim fails with whose source is another one.
FAILURES = (Refused, Unknown, KeyError, TypeError, ValueError, AttributeError, ArithmeticError, IndexError, RecursionError)


def refuses(engine, claim, build):
    try:
        build(engine, claim)
        return claim.measure()[0] > 1 or not claim.holds()
    except FAILURES:
        return True


def path_of(file):
    """That of a file by its name in `src/certified`, or by its path, without an ending in `src`."""
    if "." in file:
        return file
    return f"{file}.rs" if file.startswith("src/") else f"{CERTIFIED}/{file}.rs"


def sources_with(path, text):
    """The sources, with another text in place of a file of them."""
    return Engine(ROOT, {path: text})


def own_first(jobs, file):
    """The claims, those of the file first."""
    return sorted(jobs, key=lambda job: job[0].where != file)
