"""What the certified path is made of, as it was when it was proved: a digest of each part, in `kept.txt`.

It is all of `src` but the modules in `BEYOND`, and `Cargo.toml`: of each file the functions, and what is outside of functions. What a
module beyond implements for a type of these files is kept as well.
"""

import json
import re
from collections import Counter
from contextlib import contextmanager
from functools import lru_cache
from hashlib import sha256
from pathlib import Path

from tokens import Unknown, Words, tokens_of

KEPT = Path(__file__).resolve().parent / "kept.txt"

LIB = "src/lib.rs"
CARGO = "Cargo.toml"

# The modules of the crate that are not kept: they use the certified path, or are other methods. It may name none of them.
BEYOND = ("additive", "broad", "mesh", "thesis", "wire")

# What may change how all is compiled.
SETTINGS = ("build.rs", ".cargo/config", ".cargo/config.toml")

TYPES = ("struct", "enum", "union", "trait", "type")


class Part:
    """A part of a file, known by its words, and where it starts."""

    def __init__(self, words, at=None):
        self.at = at
        self.digest = sha256(json.dumps(words).encode()).hexdigest()[:16]


class Names:
    """Names of parts, each another one."""

    def __init__(self):
        self.counts = Counter()

    def new(self, name):
        self.counts[name] += 1
        return name if self.counts[name] == 1 else f"{name} {self.counts[name]}"


class Source(Words):
    """A file, with what is looked for in it."""

    def __init__(self, text):
        super().__init__(tokens_of(text))
        self.starts = {end: start for start, end in self.closings.items()}
        self.refuse_other_files()
        self.parts = self.read_parts()
        self.modules = self.read_modules()
        self.uses = [self.texts(i + 1, self.end_of_item(i)) for i in self.places("use") if self.word(i + 1) != "<"]
        self.types = {self.word(i + 1) for i in self.places(*TYPES) if self.is_visible(i)}
        self.own = {self.word(i + 1) for i in self.places(*TYPES[:-1])}
        self.impls = list(self.read_impls())

    def refuse_other_files(self):
        """What takes code from a file that is not found by the name of its module."""
        for i in self.places("path"):
            if self.word(i + 1) == "=" and self.word(i - 1) in ("[", "(", ","):
                raise Unknown("a `path` of a module")
        for i in self.places("include", "include_bytes", "include_str"):
            if self.word(i + 1) == "!" and self.words(i - 2, i) != ["doc", "="]:
                raise Unknown(f"`{self.word(i)}!`")

    def read_parts(self):
        """The functions, and what is outside of them with the place of each: every word is in one part."""
        found, outside, names, at = {}, [], Names(), 0
        while at < len(self.tokens):
            end = at
            if self.word(at) == "fn" and self.is_name(at + 1):
                end = self.end_of_function(at)
                name = names.new(f"fn {self.word(at + 1)}")
                found[name] = Part(self.texts(at, end + 1), self.tokens[at].at)
                outside.append(name)
            else:
                outside += self.texts(at, at + 1)
            at = end + 1
        return {"what is outside of functions": Part(outside), **found}

    def read_modules(self):
        """The names of the modules that have a file, but for those that are for tests alone."""
        found = []
        for i in self.places("mod"):
            if not self.is_name(i + 1) or self.word(i + 2) not in (";", "{"):
                raise Unknown("a `mod` without a name")
            if self.word(i + 2) == ";" and not self.is_for_tests(i):
                if any(start < i < end for start, end in self.closings.items()):
                    raise Unknown(f"`mod {self.word(i + 1)};` in brackets")
                found.append(self.word(i + 1))
        return found

    def is_for_tests(self, at):
        """Whether an item has `#[cfg(test)]`."""
        at -= 1
        if self.word(at) == ")":
            at = self.starts[at] - 1
        at -= self.word(at) == "pub"
        while self.word(at) == "]" and self.word(self.starts[at] - 1) == "#":
            if self.texts(self.starts[at], at + 1) == ["[", "cfg", "(", "test", ")", "]"]:
                return True
            at = self.starts[at] - 2
        return False

    def is_visible(self, at):
        """Whether all of the crate can name a type."""
        return self.word(at - 1) == "pub" or self.words(at - 4, at) == ["pub", "(", "crate", ")"]

    def read_impls(self):
        """Each `impl`, by the words of its type and its first and last place."""
        for start in self.places("impl"):
            # Elsewhere it is part of a type.
            if self.word(start - 1) in (":", "->", "<", "&", "=", ",", "+"):
                continue
            at, depth, of = start + 1, 0, []
            while at < len(self.tokens) and self.word(at) not in (";", ")", "]", "}", "{"):
                depth += (self.word(at) == "<") - (self.word(at) == ">")
                end = self.closings.get(at, at) + 1
                of = [] if self.word(at) == "for" and depth == 0 else of + self.texts(at, end)
                at = end
            if self.word(at) == "{":
                yield of, start, self.closings[at]

    def other_names(self, types):
        """The names that it has for types, by `as` or `type`."""
        by_as = {self.word(i + 1) for i in self.places("as") if self.word(i - 1) in types}
        return by_as | {self.word(i + 1) for i in self.places("type") if self.has(types, i + 2, self.first(";", i))}

    def has(self, words, start, end):
        return not words.isdisjoint(self.texts(start, end))

    def names_beyond(self):
        """What the root of the crate has of the modules beyond."""
        found = set()
        for words in self.uses:
            if not set(BEYOND).isdisjoint(words):
                if "*" in words:
                    raise Unknown("a `use` of all that a module has that is not kept")
                found |= {name for name in words if name[0].isalpha()} - {"as", "self", "crate", *BEYOND}
        return found

    def refuse_beyond(self, names):
        """A module that is not kept, or what the root of the crate has of it."""
        found = [name for words in self.uses for name in words if name in BEYOND]
        found += [self.word(i) for i in self.places(*BEYOND) if self.word(i + 1) == "::"]
        found += [self.word(i) for i in self.places(*names)]
        if found:
            raise Unknown(f"`{found[0]}` is not kept")

    def implements(self, types):
        """What it implements for types of other files, or for what only the compiler knows."""
        for i in self.places("macro_use", "macro_export"):
            raise Unknown(f"`{self.word(i)}`")
        types, names = types - self.own | {"$"}, Names()
        of_types = [impl for impl in self.impls if not types.isdisjoint(impl[0])]
        return {names.new(f"impl of {' '.join(of)}"): Part(self.texts(start, end + 1), self.tokens[start].at) for of, start, end in of_types}


@lru_cache(maxsize=None)
def source_of(text):
    return Source(text)


def tables_of(text):
    """The tables of `Cargo.toml`, without lines that are comments."""
    found, name = {}, "what is outside of tables"
    for line in text.splitlines():
        name = line if line.startswith("[") else name
        if line.strip() and not line.lstrip().startswith("#"):
            found.setdefault(name, []).append(line)
    return {name: Part(lines) for name, lines in found.items()}


class Kept:
    """The parts of what is to be kept, by files, and what is not read, with the reason."""

    def __init__(self, sources):
        self.sources, self.files, self.parts, self.unread = sources, {}, {}, []
        self.read(LIB)
        is_beyond = lambda path: Path(path).parts[1].removesuffix(".rs") in BEYOND
        beyond = {path: file for path, file in self.files.items() if is_beyond(path)}
        within = {path: file for path, file in self.files.items() if not is_beyond(path)}
        names = set()
        for path, file in within.items():
            with self.reading(path):
                if path == LIB:
                    names = file.names_beyond()
                else:
                    file.refuse_beyond(names)
                self.parts[path] = file.parts
        types = set().union(*(file.types for file in within.values()))
        others = set()
        for path, file in beyond.items():
            with self.reading(path):
                others |= file.other_names(types)
        for path, file in beyond.items():
            with self.reading(path):
                self.parts[path] = file.implements(types | others)
        with self.reading(CARGO):
            self.parts[CARGO] = tables_of(sources.text(CARGO))
        self.unread += [(path, "it may change how all is compiled") for path in SETTINGS if sources.is_file(path)]

    @contextmanager
    def reading(self, path):
        try:
            yield
        except Unknown as error:
            self.unread.append((path, str(error)))

    def read(self, path):
        """Reads a file and all modules below it."""
        with self.reading(path):
            self.files[path] = file = source_of(self.sources.text(path))
            folder = Path(path).parent if Path(path).stem in ("mod", "lib") else Path(path).with_suffix("")
            for name in file.modules:
                below = [str(at) for at in (folder / f"{name}.rs", folder / name / "mod.rs") if self.sources.is_file(at)]
                if len(below) != 1:
                    self.unread.append((path, f"`mod {name};` has {len(below)} files"))
                for file in below:
                    self.read(file)

    def count(self):
        return sum(map(len, self.parts.values()))

    def digests(self):
        return {path: {name: part.digest for name, part in parts.items()} for path, parts in sorted(self.parts.items()) if parts}

    def keep(self):
        if self.unread:
            raise Unknown("what is not read is not kept")
        lines = lambda parts: "".join(f"  {digest} {name}\n" for name, digest in parts.items())
        KEPT.write_text("".join(f"{path}\n{lines(parts)}" for path, parts in self.digests().items()))

    def changed(self):
        """What is said of each part that is another one, is new, or is gone."""
        if not KEPT.is_file():
            return [f"proofs/{KEPT.name} is missing"]
        known, now, said = kept(), self.digests(), []
        for path, parts in now.items():
            before = known.get(path, {})
            new = [(name, "changed" if name in before else "new") for name, digest in parts.items() if before.get(name) != digest]
            said += [f"{self.place(path, name)} {name} is {what}" for name, what in new]
        # What is not read is not gone.
        for path, parts in known.items() if not self.unread else ():
            said += [f"{path}: {name} is gone" for name in parts if name not in now.get(path, {})]
        return said

    def place(self, path, name):
        at = self.parts[path][name].at
        return f"{path}:" if at is None else f"{path}:{self.sources.text(path)[:at].count(chr(10)) + 1}:"


def kept():
    """The digests in `kept.txt`."""
    found, parts = {}, {}
    for line in KEPT.read_text(errors="replace").splitlines():
        part = re.fullmatch(r"  ([0-9a-f]{16}) (.+)", line)
        if part:
            parts[part[2]] = part[1]
        else:
            parts = found.setdefault(line, {})
    return found
