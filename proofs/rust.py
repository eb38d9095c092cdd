"""Reads the straight-line part of Rust that the filters are written in, and runs it on any numbers.

A function is found by its file and name, parsed, and interpreted: `let`, arithmetic, calls of other functions of the sources (which
are read too), closures, arrays, tuples and structures. What it does not know is an error, not a guess.
"""

import re
from pathlib import Path

from tokens import Unknown, Words, decoded, tokens_of


class Function:
    def __init__(self, file, name, of, parameters, body):
        self.file, self.name, self.of = file, name, of
        self.parameters, self.body, self.tree = parameters, body, None
        self.constants = {}
        # Whether a claim has run it to its end.
        self.is_run = False


class File(Words):
    """The functions, constants and imports of a source file."""

    def __init__(self, path, text):
        self.path, self.functions, self.constants, self.imports = path, {}, {}, {}
        self.text, self.head, self.shared = text, None, set()
        super().__init__(without_tests(Words(tokens_of(text))))
        if self.places("cfg", "cfg_attr"):
            raise Unknown(f"what {path} is under a condition")
        self.read_items()
        # Another `f64` than that of Rust.
        defined = [self.word(i + 1) for i in self.places("mod", "type", "struct", "enum", "trait", "union")]
        if "f64" in [*defined, *self.imports]:
            raise Unknown(f"what is `f64` in {path}")

    def read_use(self, at, module):
        """Reads what `use` names from a place on, and gives the place after it."""
        path = list(module)
        while self.word(at) != "{":
            path.append(self.word(at))
            if self.word(at + 1) != "::":
                break
            at += 2
        else:
            end = self.closing(at)
            at += 1
            while at < end:
                at = self.read_use(at, path)
                at += self.word(at) == ","
            return end + 1
        if self.word(at + 1) == "as":
            raise Unknown(f"another name by `as` in {self.path}")
        if path[-1] == "self":
            path.pop()
        self.imports[path[-1]] = path[-2] if len(path) > 1 else ""
        return at + 1

    def read_items(self):
        of, ends, at = None, -1, 0
        while at < len(self.tokens):
            word = self.word(at)
            if at == ends:
                of = None
            if word == "impl":
                opened = self.first("{", at)
                head = self.texts(at + 1, opened)
                self.head = " ".join(head)
                head = head[head.index("for") + 1 :] if "for" in head else head[self.after_generics(head, 0) :]
                of, ends, at = head[0], self.closing(opened), opened
            # What it makes is known to the compiler alone.
            elif word == "macro_rules":
                at = self.closing(at + 3)
            elif word == "use":
                at = self.read_use(at + 1, [])
                if self.word(at) != ";":
                    raise Unknown(f"a `use` in {self.path}")
            # A parameter of a type is no item.
            elif word == "const" and self.is_name(at + 1) and self.word(at + 2) == ":" and self.word(at - 1) not in ("<", ","):
                end = self.end_of_item(at)
                value = next((i for i in range(at, end) if self.word(i) == "="), None)
                if value:
                    self.add(self.constants, self.word(at + 1), self.tokens[value + 1 : end])
                at = end
            elif word == "fn" and self.is_name(at + 1):
                at = self.read_function(at, of)
            at += 1

    def add(self, items, name, item):
        if name in items:
            raise Unknown(f"two of the name {name} in {self.path}")
        items[name] = item

    def add_function(self, of, name, function):
        """Two of a type that are of different traits, or of one for different types, are known by these alone."""
        function.head = self.head if of else None
        if (of, name) in self.functions and self.functions[of, name].head != function.head:
            other = self.functions.pop((of, name))
            self.functions[other.head, name] = other
            self.shared.add((of, name))
        if (of, name) in self.shared:
            of = function.head
        self.add(self.functions, (of, name), function)

    @staticmethod
    def after_generics(words, at):
        depth = 0
        while at < len(words):
            depth += (words[at] == "<") - (words[at] == ">")
            if depth == 0:
                return at + (words[at] == ">")
            at += 1
        return at

    def read_function(self, at, of):
        name = self.word(at + 1)
        opened = self.after_generics(self.texts(0, len(self.tokens)), at + 2)
        closed = self.closing(opened)
        parameters = Parser(self.tokens[opened + 1 : closed]).parameters()
        end = self.end_of_function(closed)
        if self.word(end) == ";":
            return end
        body = next(i for i in range(closed, end) if self.closings.get(i) == end)
        function = Function(self, name, of, parameters, self.tokens[body : end + 1])
        self.add_function(of, name, function)
        for i in range(body, end):
            if self.word(i) == "const" and self.word(i + 2) == ":":
                stop = self.end_of_item(i)
                start = self.first("=", i, stop)
                self.add(function.constants, self.word(i + 1), self.tokens[start + 1 : stop])
        return end


def without_tests(words):
    """The tokens without the modules that are for tests alone."""
    kept, at = [], 0
    while at < len(words.tokens):
        if words.words(at, at + 8) == ["#", "[", "cfg", "(", "test", ")", "]", "mod"]:
            at = words.closings.get(at + 9, at + 9)
        else:
            kept.append(words.tokens[at])
        at += 1
    return kept


PRECEDENCE = [["||"], ["&&"], ["==", "!=", "<", ">", "<=", ">="], ["|"], ["^"], ["&"], ["<<"], ["+", "-"], ["*", "/", "%"]]


class Parser:
    def __init__(self, tokens):
        self.tokens, self.at = tokens, 0

    def peek(self):
        return self.tokens[self.at].text if self.at < len(self.tokens) else None

    def kind(self):
        return self.tokens[self.at].kind if self.at < len(self.tokens) else None

    def next(self):
        if self.at >= len(self.tokens):
            raise Unknown("the end of what is read")
        self.at += 1
        return self.tokens[self.at - 1].text

    def take(self, word):
        if self.peek() == word:
            self.at += 1
            return True
        return False

    def need(self, word):
        if not self.take(word):
            raise Unknown(f"{self.peek()!r} where {word!r} was expected")

    def skip_generics(self):
        if self.peek() == "<":
            depth = 0
            while True:
                word = self.next()
                depth += (word == "<") - (word == ">")
                if depth == 0:
                    return

    def skip_type(self, ends):
        depth = 0
        while self.peek() is not None and (depth or self.peek() not in ends):
            word = self.next()
            depth += (word in "(<[") - (word in ")>]")

    def parameters(self):
        found = []
        while self.peek() is not None:
            found.append(self.pattern())
            if self.take(":"):
                self.skip_type([","])
            self.take(",")
        return found

    def pattern(self):
        while self.peek() in ("&", "&&", "mut", "ref") or (self.peek() or "").startswith("'"):
            self.next()
        if self.take("("):
            return ("tuple", self.patterns(")"))
        if self.take("["):
            return ("tuple", self.patterns("]"))
        if self.kind() != "name":
            raise Unknown(f"the pattern {self.peek()!r}")
        name = self.next()
        while self.take("::"):
            name = self.next()
        if self.take("{"):
            fields = []
            while not self.take("}"):
                if self.take(".."):
                    continue
                field = self.next()
                fields.append((field, self.pattern() if self.take(":") else ("name", field)))
                self.take(",")
            return ("fields", fields)
        return ("name", name)

    def patterns(self, end):
        found = []
        while not self.take(end):
            found.append(self.pattern())
            self.take(",")
        return found

    def let(self):
        """The pattern and the value, after the word."""
        pattern = self.pattern()
        if self.take(":"):
            self.skip_type(["="])
        self.need("=")
        value = self.expression()
        self.need(";")
        return pattern, value

    def block(self):
        self.need("{")
        lets, value = [], ("unit",)
        while not self.take("}"):
            if self.take("let"):
                lets.append(self.let())
            elif self.peek() == "const":
                while self.next() != ";":
                    pass
            else:
                value = self.expression()
                if self.take(";"):
                    raise Unknown("a statement that is not a let")
        return ("block", lets, value)

    def lets_until(self, last):
        """The `let`s of a body up to that of a name. What is returned early, on a condition, is left out."""
        self.need("{")
        lets = []
        while True:
            if self.take("let"):
                lets.append(self.let())
                if names_of(lets[-1][0]) & {last}:
                    return lets
            elif self.peek() == "const":
                while self.next() != ";":
                    pass
            elif self.peek() == "if":
                while self.peek() != "{":
                    self.next()
                depth, words = 0, []
                while True:
                    words.append(self.next())
                    depth += (words[-1] == "{") - (words[-1] == "}")
                    if depth == 0:
                        break
                if "return" not in words:
                    raise Unknown("a condition that changes something")
            else:
                raise Unknown(f"the statement {self.peek()!r}")

    def expression(self, level=0, is_condition=False):
        if level == len(PRECEDENCE):
            return self.unary(is_condition)
        left = self.expression(level + 1, is_condition)
        while self.peek() in PRECEDENCE[level] and self.kind() == "mark":
            operator = self.next()
            left = ("binary", operator, left, self.expression(level + 1, is_condition))
        return left

    def unary(self, is_condition):
        for mark in "-", "!":
            if self.take(mark):
                return ("unary", mark, self.unary(is_condition))
        if self.peek() in ("&", "&&", "*") and self.kind() == "mark":
            self.next()
            return self.unary(is_condition)
        return self.postfix(self.primary(is_condition), is_condition)

    def arguments(self, end):
        found = []
        while not self.take(end):
            found.append(self.expression())
            if self.take(";"):
                count = self.expression()
                self.need(end)
                return [found[0]] * int(count[1])
            self.take(",")
        return found

    def postfix(self, value, is_condition):
        while True:
            if self.take("."):
                name = self.next()
                if self.take("::"):
                    self.skip_generics()
                if self.take("("):
                    value = ("method", value, name, self.arguments(")"))
                else:
                    for part in name.split("."):
                        value = ("field", value, part)
            elif self.take("("):
                value = ("call", value, self.arguments(")"))
            elif self.take("["):
                index = self.expression()
                self.need("]")
                value = ("index", value, index)
            elif self.take("as"):
                # To what is shorter, or an integer, is a rounding.
                self.need("f64")
                value = ("cast", value)
            elif self.peek() == "?":
                raise Unknown("a question mark")
            else:
                return value

    def primary(self, is_condition):
        if self.kind() == "number":
            return ("number", number_of(self.next()))
        if self.take("("):
            values = self.arguments(")")
            comma = self.tokens[self.at - 2].text == ","
            return values[0] if len(values) == 1 and not comma else ("list", values)
        if self.take("["):
            return ("list", self.arguments("]"))
        if self.peek() == "{":
            return self.block()
        if self.take("if"):
            condition = self.expression(is_condition=True)
            then = self.block()
            self.need("else")
            return ("if", condition, then, self.block() if self.peek() == "{" else self.primary(False))
        if self.take("||"):
            return ("closure", [], self.expression())
        if self.take("|"):
            parameters = []
            while not self.take("|"):
                parameters.append(self.pattern())
                if self.take(":"):
                    self.skip_type([",", "|"])
                self.take(",")
            return ("closure", parameters, self.expression())
        if self.kind() != "name":
            raise Unknown(f"the expression {self.peek()!r}")
        path = [self.next()]
        while self.take("::"):
            if self.peek() == "<":
                self.skip_generics()
            else:
                path.append(self.next())
        if self.peek() == "{" and not is_condition and path[-1][0].isupper():
            self.next()
            fields, base = [], None
            while not self.take("}"):
                if self.take(".."):
                    base = self.expression()
                    continue
                field = self.next()
                fields.append((field, self.expression() if self.take(":") else ("path", [field])))
                self.take(",")
            return ("structure", path, fields, base)
        return ("path", path)


def number_of(text):
    match = re.fullmatch(r"(\d[\d_]*(\.[\d_]+)?([eE][-+]?[\d_]+)?)(u32|u64|f64|usize|i64)?", text)
    if not match:
        raise Unknown(f"the number {text}")
    digits, is_float = match[1].replace("_", ""), match[2] or match[3] or match[4] == "f64"
    return float(digits) if is_float else int(digits)


def names_of(pattern):
    if pattern[0] == "name":
        return {pattern[1]}
    if pattern[0] == "tuple":
        return set().union(*map(names_of, pattern[1]))
    return set().union(*(names_of(part) for _, part in pattern[1]))


class Record:
    """A structure."""

    def __init__(self, of, **fields):
        self.of, self.fields = of, fields


class Sources:
    """The source files below a folder, read when they are needed. Some may have another text than is there."""

    def __init__(self, root, texts=None):
        self.root, self.files, self.texts = Path(root), {}, texts or {}

    def text(self, path):
        try:
            return decoded(self.texts[path].encode() if path in self.texts else (self.root / path).read_bytes())
        except OSError as error:
            raise Unknown(f"the file {path}: {error.strerror}") from None

    def is_file(self, path):
        return str(path) in self.texts or (self.root / path).is_file()

    def file(self, path):
        if path not in self.files:
            self.files[path] = File(path, self.text(path))
        return self.files[path]

    def module(self, user, name):
        """The file of a module, seen from a file."""
        folder = Path(user.path).parent
        if name == "super" and self.is_file(f"{folder}.rs"):
            return self.file(f"{folder}.rs")
        if name in ("super", "self", "crate", "certified"):
            name = "mod"
        for base in (folder, folder.parent, Path("src/certified")):
            for path in (base / f"{name}.rs", base / name / "mod.rs"):
                if self.is_file(path):
                    return self.file(str(path))
        raise Unknown(f"the module {name!r}")


class Interpreter:
    """Runs functions of the sources on numbers that know `+`, `-`, `*`, `/` and what `builtins` do."""

    def __init__(self, sources, builtins, methods, types):
        self.sources, self.builtins, self.methods, self.types = sources, builtins, methods, types
        # What methods of structures give, where that is not what their bodies say.
        self.given = {}

    def run(self, path, name, *arguments, of=None, this=None):
        file = self.sources.file(path)
        found = [f for (owner, known), f in file.functions.items() if known == name and of in (None, owner)]
        if len(found) != 1:
            raise Unknown(f"{len(found)} functions {name!r} in {path}")
        return self.apply(found[0], ([this] if this is not None else []) + list(arguments))

    def scope_at(self, path, name, last, *arguments, of=None):
        """What is known in a function once a name is bound."""
        file = self.sources.file(path)
        function = file.functions[of, name]
        scope = self.local(function)
        for pattern, argument in zip(function.parameters, arguments):
            self.bind(pattern, argument, scope)
        for pattern, value in Parser(function.body).lets_until(last):
            self.bind(pattern, self.value(value, scope, file, of), scope)
        return scope

    def constant(self, path, name, function=None):
        """That of a file, or of a function in it."""
        file = self.sources.file(path)
        constants = file.functions[None, function].constants if function else file.constants
        return self.value(Parser(constants[name]).expression(), {}, file, None)

    def local(self, function):
        """The scope that a function starts with: the constants in its body."""
        scope = {}
        for name, tokens in function.constants.items():
            scope[name] = self.value(Parser(tokens).expression(), scope, function.file, function.of)
        return scope

    def apply(self, function, arguments):
        if function.tree is None:
            function.tree = Parser(function.body).block()
        if len(arguments) != len(function.parameters):
            raise Unknown(f"{len(arguments)} arguments of {function.name}")
        function.is_run = True
        scope = self.local(function)
        for pattern, argument in zip(function.parameters, arguments):
            self.bind(pattern, argument, scope)
        return self.value(function.tree, scope, function.file, function.of)

    def bind(self, pattern, value, scope):
        if pattern[0] == "name":
            scope[pattern[1]] = value
        elif pattern[0] == "tuple":
            if len(pattern[1]) != len(value):
                raise Unknown("a pattern of another length")
            for part, item in zip(pattern[1], value):
                self.bind(part, item, scope)
        else:
            for field, part in pattern[1]:
                self.bind(part, value.fields[field], scope)

    def value(self, tree, scope, file, of):
        kind = tree[0]
        go = lambda tree: self.value(tree, scope, file, of)
        if kind == "number":
            return tree[1]
        if kind == "list":
            return [go(part) for part in tree[1]]
        if kind == "block":
            inner = dict(scope)
            for pattern, value in tree[1]:
                self.bind(pattern, self.value(value, inner, file, of), inner)
            return self.value(tree[2], inner, file, of)
        if kind == "binary":
            return self.binary(tree[1], go(tree[2]), go(tree[3]))
        if kind == "cast":
            return self.cast(go(tree[1]))
        if kind == "unary":
            return -go(tree[2]) if tree[1] == "-" else not go(tree[2])
        if kind == "if":
            return go(tree[2]) if self.builtins["if"](tree[1], go, tree[3]) else go(tree[3])
        if kind == "closure":
            return self.closure(tree, scope, file, of)
        if kind == "structure":
            fields = {name: go(value) for name, value in tree[2]}
            if tree[3] is not None:
                fields = {**go(tree[3]).fields, **fields}
            name = of if tree[1][-1] == "Self" else tree[1][-1]
            build = self.builtins.get("structure " + name)
            return build(fields) if build else Record(name, **fields)
        if kind == "field":
            value = go(tree[1])
            if tree[2].isdigit():
                return value[int(tree[2])]
            return value.fields[tree[2]] if isinstance(value, Record) else getattr(value, tree[2])
        if kind == "index":
            return go(tree[1])[go(tree[2])]
        if kind == "path":
            return self.path(tree[1], scope, file, of)
        if kind == "call":
            function = self.path(tree[1][1], scope, file, of) if tree[1][0] == "path" else go(tree[1])
            return function(*[go(argument) for argument in tree[2]])
        if kind == "method":
            return self.method(go(tree[1]), tree[2], [go(argument) for argument in tree[3]], file)
        raise Unknown(kind)

    def closure(self, tree, scope, file, of):
        def call(*arguments):
            inner = dict(scope)
            for pattern, argument in zip(tree[1], arguments):
                self.bind(pattern, argument, inner)
            return self.value(tree[2], inner, file, of)

        return call

    @staticmethod
    def cast(value):
        """An integer as `f64`."""
        if type(value) is not int or abs(value) > 2**53:
            raise Unknown(f"{value!r} as f64")
        return float(value)

    @staticmethod
    def binary(operator, x, y):
        if operator == "+":
            return x + y
        if operator == "-":
            return x - y
        if operator == "*":
            return x * y
        if operator == "/":
            # Rust's drops the rest.
            if isinstance(x, int) and isinstance(y, int):
                raise Unknown("a quotient of integers")
            return x / y
        if operator == "<<":
            return x << y
        if operator == "%":
            return x % y
        if operator == "&":
            return x & y
        if operator == "|":
            return x | y
        if operator == ">":
            return x > y
        if operator == "<":
            return x < y
        raise Unknown(f"the operator {operator}")

    def path(self, path, scope, file, of):
        name = path[-1]
        if len(path) == 1 and name in scope:
            return scope[name]
        whole = "::".join(path[-2:])
        if whole in self.builtins:
            return self.builtins[whole]
        if len(path) == 1 and name in self.builtins:
            return self.builtins[name]
        if path[0] == "Self" and (of, name) in file.functions:
            function = file.functions[of, name]
            return lambda *arguments: self.apply(function, list(arguments))
        owner = path[-2] if len(path) > 1 and path[-2][0].isupper() else None
        if owner in self.types:
            for known in map(self.sources.file, self.types[owner]):
                if (owner, name) in known.functions:
                    function = known.functions[owner, name]
                    return lambda *arguments: self.apply(function, list(arguments))
        home = file
        if len(path) > 1 and owner is None:
            home = self.sources.module(file, path[-2])
        elif name not in file.constants and (None, name) not in file.functions and name in file.imports:
            home = self.sources.module(file, file.imports[name])
        while (None, name) not in home.functions and name not in home.constants and name in home.imports:
            home = self.sources.module(home, home.imports[name])
        if name in home.constants:
            return self.value(Parser(home.constants[name]).expression(), {}, home, None)
        if (None, name) in home.functions:
            function = home.functions[None, name]
            return lambda *arguments: self.apply(function, list(arguments))
        raise Unknown("::".join(path))

    def method(self, value, name, arguments, file):
        if isinstance(value, Record):
            if name in ("copied", "clone"):
                return value
            if (value.of, name) in self.given:
                return self.given[value.of, name]
            for known in map(self.sources.file, self.types[value.of]):
                if (value.of, name) in known.functions:
                    return self.apply(known.functions[value.of, name], [value, *arguments])
            raise Unknown(f"the method {name} of {value.of}")
        if name in self.methods:
            return self.methods[name](value, *arguments)
        return getattr(value, name)(*arguments)
