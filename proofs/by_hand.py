"""The text of the functions that are proved by hand, as it was when they were, with the constants that they name.

Every function of `src/certified` is in a claim, or is kept so, or is of a part that `claims.py` names as beyond these proofs.
"""

import re
from pathlib import Path

from engine import HERE
from claims import INTEGER_FILES_BY_HAND, INTEGERS, INTEGERS_BY_HAND, NO_PROOF
from rust import Unknown

KEPT = Path(__file__).resolve().parent / "by_hand.txt"

# A constant is written so. Types of one letter are too, so one letter is a constant where the file knows one.
CONSTANT = re.compile(r"[A-Z][A-Z0-9_]*")
# Of whom constants are not looked for: numbers of Rust itself, and what has a value for each width of integers.
ELSEWHERE = {"f32", "f64", "i64", "u64", "usize", "L"}
# Not constants: what types are made with, and variants of a type.
OTHERS = {"FIRST", "SECOND", "F32", "F64"}
# The types that a parameter stands for.
STANDS_FOR = {"K": ("edges", "face/mod")}


def name_of(file, of, name):
    return f"{file}.rs {of + '::' if of else ''}{name}"


def is_spoken_of(file):
    """Whether all functions of a file are in a claim or proved by hand."""
    return file not in NO_PROOF and (not file.startswith(INTEGERS) or file in INTEGER_FILES_BY_HAND)


def files(engine):
    """The names of all files of the certified path."""
    return [path.removeprefix(HERE).removesuffix(".rs") for path in engine.sources.modules(f"{HERE}mod.rs")]


def named(engine):
    """All functions that are in a claim or proved by hand, and no others: a file, a type or `None`, and a name."""
    yield from INTEGERS_BY_HAND
    for file in filter(is_spoken_of, files(engine)):
        functions = engine.sources.file(f"{HERE}{file}.rs").functions
        yield from ((file, of, name) for of, name in functions)


def home_of(sources, file, path):
    """The file that defines a constant, seen from a file."""
    *owner, name = path
    if name in file.constants and (not owner or owner[0] not in file.paths):
        return file
    first = path[0]
    if first in file.paths:
        path = file.paths[first] + path[1:]
    elif len(path) == 1:
        return None
    # A type is where its name is imported from.
    module = sources.follow(file, path[:-1] if path[-2][0].islower() else path[:-2])
    return module and home_of(sources, module, path[-1:] if path[-2][0].islower() else path[-2:])


def constants(sources, file, tokens, found, own=()):
    """The constants that a text names, and those that these name: each with its text. Its own are in it."""
    words = [text for _, text in tokens]
    for i, word in enumerate(words):
        if not CONSTANT.fullmatch(word) or words[i + 1 : i + 2] == ["::"] or words[i - 1 : i] == ["const"]:
            continue
        start = i
        while start > 1 and words[start - 1] == "::":
            start -= 2
        path = words[start : i + 1 : 2]
        owner = path[0]
        if owner in ELSEWHERE or word in OTHERS or path in ([name] for name in own):
            continue
        homes = [sources.file(f"{HERE}{name}.rs") for name in STANDS_FOR.get(owner, ()) if len(path) > 1]
        homes = homes or [home_of(sources, file, path[1:] if owner == "Self" else path)]
        for home in homes:
            if home is None or word not in home.constants:
                if len(word) > 1:
                    raise Unknown(f"the constant {'::'.join(path)} of {file.path}")
                continue
            key = f"{home.path.removeprefix(HERE)} {word}"
            if key not in found:
                found[key] = " ".join(text for _, text in home.constants[word])
                constants(sources, home, home.constants[word], found)
    return found


def text_of(engine, file, function):
    found = constants(engine.sources, file, function.body, {}, function.constants)
    return function.text() + "".join(f" ; {name} = {text}" for name, text in found.items())


def texts(engine):
    """Each function by its name, and its text without comments. The other questions are asked of this."""
    found = {}
    for name, of, function in named(engine):
        file = engine.sources.file(f"{HERE}{name}.rs")
        known = file.functions.get((of, function))
        found[name_of(name, of, function)] = known, text_of(engine, file, known) if known else "(gone)"
    return found


# A claim says what is computed, not always what follows where it is compared.
COMPARES = {"<", ">", "<=", ">=", "==", "!=", "is_above"}


def is_in_claims(function):
    """Whether claims alone hold a function: they have run it to its end, and it compares nothing. Once all claims are built."""
    return function is not None and function.is_run and not any(text in COMPARES for _, text in function.body)


def keep(now):
    """Keeps the text of all functions that claims alone do not hold."""
    found = [f"{name}\n    {text}\n" for name, (function, text) in now.items() if not is_in_claims(function)]
    KEPT.write_text("".join(found))


def kept():
    return dict(re.findall(r"^(\S.*)\n    (.*)$", KEPT.read_text(), re.M))


def changed(now):
    """The functions of which the text, or that of a constant, is another one."""
    return [name for name, text in kept().items() if name not in now or now[name][1] != text]


def in_no_proof(now):
    """The functions that are neither kept nor held by claims."""
    known = kept()
    return [name for name, (function, _) in now.items() if name not in known and not is_in_claims(function)]


def gone(engine):
    """The files that `claims.py` names and that are not there."""
    there = files(engine)
    return [f"{file}.rs" for file in NO_PROOF + INTEGER_FILES_BY_HAND if file not in there]
