"""The words of a Rust source: all of it but space and comments."""

import re
from functools import lru_cache
from typing import NamedTuple

# The order matters: what is in a string or a comment is nothing else.
TOKEN = re.compile(
    r"""(?P<text>[bc]?r(?P<marks>\#*)"[\s\S]*?"(?P=marks)
                |[bc]?"(?:[^"\\]|\\[\s\S])*"
                |b?'(?:[^'\\\n\t]|\\(?:x[\da-fA-F]{2}|u\{[\da-fA-F_]+\}|[^xu\n]))')
      | (?P<space>[ \t\n]+|//[^\n]*)
      | (?P<refused>/\*|'?r\#)
      | (?P<number>0[box]\w+|\d[\d_]*(?:\.\d[\d_]*)?(?:[eE][-+]?[\d_]+)?(?:[A-Za-z_]\w*)?)
      | (?P<name>'?[A-Za-z_]\w*)
      | (?P<mark>\.\.=|\.\.|::|->|=>|<<|>=|<=|==|!=|&&|\|\||[-+*/%=<>!&|^.,;:(){}\[\]?\#$@~])""",
    re.X | re.A,
)

REFUSED = {"/*": "a comment in /*", "r#": "a name after r#", "'r#": "a name after r#"}


class Unknown(Exception):
    """Rust that these programs do not read."""


class Token(NamedTuple):
    kind: str
    text: str
    at: int


def decoded(data):
    """The text of a file, as the compiler takes it."""
    try:
        text = data.decode()
    except UnicodeDecodeError:
        raise Unknown("what is no UTF-8") from None
    # Space for the compiler, but not the end of a comment.
    if re.search(r"\r(?!\n)", text):
        raise Unknown(r"a \r that no \n follows")
    return text.replace("\r\n", "\n")


@lru_cache(maxsize=None)
def tokens_of(text):
    """The words of a text, which are not to be changed."""
    found, at = [], 0
    while at < len(text):
        match = TOKEN.match(text, at)
        if not match or match.lastgroup == "refused":
            raise Unknown(REFUSED[match.group()] if match else f"the text {text[at:at + 30]!r}")
        if match.lastgroup != "space":
            found.append(Token(match.lastgroup, match.group(), at))
        at = match.end()
    return found


class Words:
    """The words of a text, and where what is opened at a place is closed."""

    def __init__(self, tokens):
        self.tokens, self.closings, self.index, opened = tokens, {}, {}, []
        for i in range(len(tokens)):
            self.index.setdefault(self.word(i), []).append(i)
            if self.word(i) in ("(", "[", "{"):
                opened.append(i)
            elif self.word(i) in (")", "]", "}"):
                if not opened or self.word(opened[-1]) + self.word(i) not in ("()", "[]", "{}"):
                    raise Unknown("brackets that do not close")
                self.closings[opened.pop()] = i
        if opened:
            raise Unknown("brackets that do not close")

    def word(self, at):
        """The word at a place, if there is one, and not a text."""
        return self.tokens[at].text if 0 <= at < len(self.tokens) and self.tokens[at].kind != "text" else None

    def words(self, start, end):
        return [self.word(i) for i in range(start, end)]

    def texts(self, start, end):
        return [token.text for token in self.tokens[start:end]]

    def places(self, *words):
        """Where one of some words is."""
        return sorted(i for word in words for i in self.index.get(word, ()))

    def is_name(self, at):
        return at < len(self.tokens) and self.tokens[at].kind == "name"

    def closing(self, at):
        """The place of what closes the bracket at a place."""
        if at not in self.closings:
            raise Unknown(f"{self.word(at)!r} where a bracket was expected")
        return self.closings[at]

    def first(self, word, start, end=None):
        """The first place of a word from a place on."""
        for i in range(start, len(self.tokens) if end is None else end):
            if self.word(i) == word:
                return i
        raise Unknown(f"no {word!r} where one was expected")

    def end_of_item(self, at):
        """The place of the `;` that is in no brackets."""
        while self.word(at) != ";":
            if at >= len(self.tokens):
                raise Unknown("an item without an end")
            at = self.closings.get(at, at) + 1
        return at

    def end_of_function(self, at):
        """The place of the `}` or `;` of a function."""
        while self.word(at) not in (";", "{"):
            if at >= len(self.tokens):
                raise Unknown("a function without an end")
            at = self.closings.get(at, at) + 1
        return self.closings.get(at, at)
