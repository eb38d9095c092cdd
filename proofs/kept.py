"""The text of the filters, as it was when they were proved, with the constants that they name.

All of `src/certified` is kept so, but what `claims.py` names as beyond these proofs.
"""

import re
from pathlib import Path

from engine import HERE
from claims import INTEGER_FILES, INTEGERS, NO_PROOF, OF_INTEGERS, OUTSIDE
from rust import Unknown, joined

KEPT = Path(__file__).resolve().parent / "kept.txt"
SOURCES = "src/"

# A constant is written so. Types of one letter are too, so one letter is a constant where the file knows one.
CONSTANT = re.compile(r"[A-Z][A-Z0-9_]*")
# Of whom constants are not looked for: numbers of Rust itself, and what has a value for each width of integers.
ELSEWHERE = {"f32", "f64", "i64", "std", "u64", "usize", "L"}
# Not constants: variants of a type, and, alone, what types are made with.
OTHERS = {"F32", "F64"}
PARAMETERS = {"FIRST", "SECOND"}
# The types that a parameter stands for.
STANDS_FOR = {"K": ("edges", "face/mod")}


def is_whole(file):
    """Whether all of a file is kept."""
    return file not in NO_PROOF and (not file.startswith(INTEGERS) or file in INTEGER_FILES)


def files(engine):
    """The names of all files of the certified path."""
    return [path.removeprefix(HERE).removesuffix(".rs") for path in engine.sources.modules(f"{HERE}mod.rs")]


def paths(engine):
    """Those of the files that are kept whole."""
    return [f"{HERE}{file}.rs" for file in files(engine) if is_whole(file)] + [f"{SOURCES}{file}.rs" for file in OUTSIDE]


def name_of(path, of, name):
    return f"{path.removeprefix(HERE)} {of + '::' if of else ''}{name}"


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
        if owner in ELSEWHERE | PARAMETERS or word in OTHERS or path in ([name] for name in own):
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
    """That of a function, and of the constants that it names."""
    found = constants(engine.sources, file, function.tokens, {}, function.constants)
    return function.text() + "".join(f" ; {name} = {text}" for name, text in found.items())


def texts(engine):
    """What is kept, by its name: functions, and what is outside of functions in a file, without comments."""
    found = {}
    for path in paths(engine):
        try:
            file = engine.sources.file(path)
            found.update((name_of(path, *key), text_of(engine, file, function)) for key, function in file.functions.items())
            found[name_of(path, None, "outside of functions")] = joined(file.rest)
        except Unknown as error:
            found[name_of(path, None, "as a whole")] = f"is not read: {error}"
    for name, *key in OF_INTEGERS:
        path = f"{HERE}{name}.rs"
        try:
            file = engine.sources.file(path)
            found[name_of(path, *key)] = text_of(engine, file, file.functions[tuple(key)])
        except (Unknown, KeyError) as error:
            found[name_of(path, *key)] = f"is not read: {error}"
    return found


def keep(now):
    KEPT.write_text("".join(f"{name}\n    {text}\n" for name, text in now.items()))


def kept():
    return dict(re.findall(r"^(\S.*)\n    (.*)$", KEPT.read_text(), re.M))


def changed(now):
    """What is another text, is new, or is gone."""
    known = kept()
    return [name for name, text in now.items() if known.get(name) != text] + [name for name in known if name not in now]


def gone(engine):
    """The files that `claims.py` names and that are not there."""
    there = files(engine)
    return [f"{file}.rs" for file in NO_PROOF + INTEGER_FILES if file not in there]


def count_run(engine):
    """How many functions the claims have run to their ends."""
    return sum(function.is_run for file in engine.sources.files.values() for function in file.functions.values())
