"""The text of the functions that are proved by hand, as it was when they were, with the constants that they name."""

import re
from pathlib import Path

from engine import HERE
from claims import BY_HAND, WHOLE_BY_HAND
from rust import Unknown

KEPT = Path(__file__).resolve().parent / "by_hand.txt"

# A constant is written so. Types of one letter are too, so one letter is a constant where the file knows one.
CONSTANT = re.compile(r"[A-Z][A-Z0-9_]*")
# Of whom constants are not looked for: numbers of Rust itself, and what has a value for each width of integers.
ELSEWHERE = {"f64", "i64", "u64", "usize", "L"}
# Not constants: what types are made with.
PARAMETERS = {"FIRST", "SECOND"}
# The types that a parameter stands for.
STANDS_FOR = {"K": ("edges", "face/mod")}


def name_of(file, of, name):
    return f"{file}.rs {of + '::' if of else ''}{name}"


def named(engine):
    """All functions that are proved by hand."""
    yield from BY_HAND
    for file in WHOLE_BY_HAND:
        functions = engine.sources.file(f"{HERE}{file}.rs").functions
        yield from ((file, of, name) for of, name in functions if (file, of, name) not in BY_HAND)


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
        if owner in ELSEWHERE or word in PARAMETERS or path in ([name] for name in own):
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
    """Each function's text, without comments."""
    found = {}
    for name, of, function in named(engine):
        file = engine.sources.file(f"{HERE}{name}.rs")
        known = file.functions.get((of, function))
        found[name_of(name, of, function)] = text_of(engine, file, known) if known else "(gone)"
    return found


def keep(engine):
    KEPT.write_text("".join(f"{name}\n    {text}\n" for name, text in texts(engine).items()))


def changed(engine):
    """The functions of which the text, or that of a constant, is another one."""
    kept = dict(re.findall(r"^(\S.*)\n    (.*)$", KEPT.read_text(), re.M))
    now = texts(engine)
    return [name for name in now if kept.get(name) != now[name]] + [name for name in kept if name not in now]
