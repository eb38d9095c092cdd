"""Numbers that carry every rounding: what a formula in `f64` gives, as a polynomial.

A computed number is a sum of terms `c x y .. (1 + e1) (1 + e2) ..`: a rational `c`, exact quantities `x`, and roundings, each in
`[-u, u]`, `u = 2^-53` (or of another size, which its name tells). A product may also underflow: then `n` is added, `|n| <= 2^-1075`.

A quantity may have any sign, unless its name is that of a magnitude, `|x|`. `abs` makes one of the other, so that it is seen where the
source has it and where it has not.
"""

import re
from fractions import Fraction
from itertools import product

U = Fraction(1, 2**53)
H = U * U


def is_magnitude(name):
    return name.endswith("|")


def magnitude(name):
    """The name of the magnitude of a quantity."""
    return name if is_magnitude(name) else f"|{name}|"


def plain(name):
    return name.strip("|")


def underflowed(names):
    return any(re.fullmatch(r"n\d+", name) for name in names)


def is_power_of_two(x):
    x = abs(Fraction(x))
    return x != 0 and (x.numerator & (x.numerator - 1)) == 0 and (x.denominator & (x.denominator - 1)) == 0


class Context:
    """What a run knows beside the numbers."""

    def __init__(self, choices=(), underflows=False, reaches=None, differences=None, half=U, truths=()):
        self.choices, self.taken, self.truths = list(choices), 0, truths
        self.underflows, self.reaches = underflows, reaches or (lambda name: name)
        self.differences = differences or {}
        self.half, self.kinds = half, []
        self.sizes, self.count, self.compared, self.lemmas = {}, 0, [], []
        # What a magnitude is of, if that is a sum.
        self.sums = {}

    def rounding(self, kind="e", size=None):
        self.count += 1
        name = f"{kind}{self.count}"
        self.sizes[name] = self.half if size is None else size
        return name

    def underflow(self):
        self.count += 1
        return f"n{self.count}"

    def compare(self, larger, smaller):
        """What is taken for the truth of a comparison: that it holds, unless something else is given for the first ones."""
        self.compared.append((larger, smaller))
        return len(self.compared) > len(self.truths) or self.truths[len(self.compared) - 1]

    def choose(self, options, kind="either"):
        """One of some values: the run is repeated for the others."""
        self.kinds.append(kind)
        while self.taken >= len(self.choices):
            self.choices.append((0, len(options)))
        index, _ = self.choices[self.taken]
        self.choices[self.taken] = (index, len(options))
        self.taken += 1
        return options[index]


def runs(body, **settings):
    """The results of a function of a context, for all choices that it meets."""
    choices = []
    while True:
        context = Context(choices, **settings)
        yield context, body(context)
        choices = context.choices
        while choices and choices[-1][0] + 1 == choices[-1][1]:
            choices.pop()
        if not choices:
            return
        choices[-1] = (choices[-1][0] + 1, choices[-1][1])


def decisions(body, count):
    """The results of a function of a context with so many comparisons, for all that these may say."""
    for truths in product([True, False], repeat=count):
        for context, result in runs(body, truths=truths):
            if len(context.compared) != count:
                raise ArithmeticError("another number of comparisons")
            yield context, result


def times(x, y):
    found = {}
    for (a, e), c in x.items():
        for (b, f), d in y.items():
            key = (tuple(sorted(a + b)), tuple(sorted(e + f)))
            found[key] = found.get(key, 0) + c * d
    return found


class F:
    """A computed number."""

    def __init__(self, context, terms, alias=None):
        self.context, self.terms, self.alias = context, {k: c for k, c in terms.items() if c}, alias

    @staticmethod
    def exactly(context, *names, factor=1):
        return F(context, {(tuple(sorted(names)), ()): Fraction(factor)})

    @staticmethod
    def size(context, *names, factor=1):
        """A product of magnitudes."""
        return F.exactly(context, *map(magnitude, names), factor=factor)

    def rounded(self, kind="e", size=None, may_underflow=False):
        e = self.context.rounding(kind, size)
        terms = {(a, tuple(sorted(f + (e,)))): c for (a, f), c in self.terms.items()}
        if may_underflow and self.context.underflows:
            terms[((self.context.underflow(),), ())] = Fraction(1)
        return F(self.context, terms)

    def is_zero(self):
        return not self.terms

    def of(self, other):
        return other if isinstance(other, F) else F(self.context, {((), ()): Fraction(other)})

    def plus(self, other):
        terms = dict(self.terms)
        for key, c in other.terms.items():
            terms[key] = terms.get(key, 0) + c
        return F(self.context, terms)

    def leaf(self):
        """The name, if it is one exact quantity, perhaps rounded and times a number."""
        if len(self.terms) == 1:
            (names, _), c = next(iter(self.terms.items()))
            if len(names) == 1:
                return names[0], c
        return None

    def __add__(self, other):
        if isinstance(other, Pair):
            return NotImplemented
        other = self.of(other)
        if self.is_zero() or other.is_zero():
            return other if self.is_zero() else self
        return self.plus(other).rounded()

    __radd__ = __add__

    def __neg__(self):
        return F(self.context, {k: -c for k, c in self.terms.items()})

    def __sub__(self, other):
        other = self.of(other)
        x, y = self.leaf(), other.leaf()
        if x and y and (x[0], y[0]) in self.context.differences and x[1] == y[1]:
            return F.exactly(self.context, self.context.differences[x[0], y[0]], factor=x[1]).rounded()
        return self + (-other)

    def __rsub__(self, other):
        # What a weight leaves of 1 has a name of its own.
        rests = {("t", 1): "s", ("|weight|", 1): "|rest|"}
        if other == 1 and self.leaf() in rests:
            return F.exactly(self.context, rests[self.leaf()]).rounded()
        return self.of(other) + (-self)

    def __mul__(self, other):
        if not isinstance(other, F):
            other = Fraction(other)
            scaled = F(self.context, {k: c * other for k, c in self.terms.items()})
            if is_power_of_two(other) or other == 0:
                return scaled.lowered(other) if abs(other) < 1 else scaled
            return scaled.rounded(may_underflow=abs(other) < 1)
        return F(self.context, times(self.terms, other.terms)).rounded(may_underflow=True)

    __rmul__ = __mul__

    def lowered(self, factor):
        if factor and self.context.underflows:
            return self.plus(F.exactly(self.context, self.context.underflow()))
        return self

    def __truediv__(self, other):
        if isinstance(other, F):
            names, rest = next(iter(other.terms.items()))
            if len(other.terms) != 1 or rest != 1:
                raise ArithmeticError("a quotient by a sum")
            # 1 / (1 + e) is 1 + e' with an e' that is not much larger.
            size = sum((self.context.sizes[e] for e in names[1]), Fraction(0)) * (1 + 64 * U)
            e = self.context.rounding("q", size)
            inverse = {(tuple("1/" + name for name in names[0]), (e,)): Fraction(1)}
            return F(self.context, times(self.terms, inverse)).rounded(may_underflow=True)
        other = Fraction(other)
        scaled = F(self.context, {k: c / other for k, c in self.terms.items()})
        return scaled if is_power_of_two(other) else scaled.rounded(may_underflow=True)

    def sqrt(self):
        """The length `|x|` of a vector of which this is the square, computed."""
        squares = sorted(names for names, _ in self.terms)
        if any(len(names) != 2 or names[0] != names[1] for names in squares):
            # Any other root is not looked into.
            return F.size(self.context, "root")
        most = max((es for _, es in self.terms), key=len)
        size = Fraction(len(most), 2) * U * (1 + Fraction(1, 2**40))
        self.context.lemmas.append(([(e, self.context.sizes[e]) for e in most], size))
        name = "|" + ",".join(plain(names[0]) for names in squares) + "|"
        e = self.context.rounding("q", size)
        return F(self.context, {((name,), (e,)): Fraction(1)}).rounded()

    def __abs__(self):
        """The magnitude of a product is that of its factors; a sum's has a name of its own. What underflowed may have either sign."""
        if self.alias:
            return abs(self.alias)
        lost = {key: c for key, c in self.terms.items() if underflowed(key[0])}
        kept = {key: c for key, c in self.terms.items() if key not in lost}
        if len(kept) > 1:
            name = magnitude(f"sum{len(self.context.sums)}")
            self.context.sums[name] = F(self.context, kept)
            kept = {((name,), ()): Fraction(1)}
        return F(self.context, {(tuple(sorted(map(magnitude, names))), es): abs(c) for (names, es), c in kept.items()} | lost)

    abs = __abs__

    def opened(self):
        """The number itself, where it is a multiple of the magnitude of a sum."""
        (((name,), es), c), = self.terms.items()
        return F(self.context, {(names, tuple(sorted(es + fs))): c * d for (names, fs), d in self.context.sums[name].terms.items()})

    def larger(self, other):
        return self.context.choose([self, self.of(other)], "larger")

    def smaller(self, other):
        return self.context.choose([self, self.of(other)], "smaller")

    max, min = larger, smaller

    def clamp(self, *_):
        return self

    def __gt__(self, other):
        return self.context.compare(self, self.of(other))

    def __lt__(self, other):
        return self.of(other) > self


class Pair:
    """A number at both ends of the step."""

    def __init__(self, start, end):
        self.ends = (start, end)

    def start(self):
        return self.ends[0]

    def end(self):
        return self.ends[1]

    def each(self, other, f):
        return Pair(*(f(x, y) for x, y in zip(self.ends, other.ends)))

    def __add__(self, other):
        return self.each(other, lambda x, y: x + y)

    def __sub__(self, other):
        return self.each(other, lambda x, y: x - y)

    def __mul__(self, other):
        return self.each(other, lambda x, y: x * y)

    def swapped(self):
        return Pair(self.ends[1], self.ends[0])

    def transposed(self, other):
        return [Pair(x, y) for x, y in zip(self.ends, other.ends)]

    def sum(self):
        return self.ends[0] + self.ends[1]

    def __abs__(self):
        return Pair(*map(abs, self.ends))

    abs = __abs__

    def larger(self, other, kind="larger"):
        first = next(x for x in (*self.ends, *other.ends) if isinstance(x, F))
        return first.context.choose([self, other], kind)

    def smaller(self, other):
        return self.larger(other, "smaller")

    def largest(self):
        """The larger magnitude, of which there is a name."""
        context, leaves = self.ends[0].context, [x.leaf() for x in self.ends]
        if any(factor != 1 or not is_magnitude(name) for name, factor in leaves):
            raise ArithmeticError("the larger one of what are no magnitudes")
        (reach,) = {context.reaches(plain(name)) for name, _ in leaves}
        return F.size(context, reach).rounded()

    def is_above(self, other):
        return [x.context.compare(x, y) for x, y in zip(self.ends, other.ends)]


class Double:
    """A double-double, or one in each lane, as the bounds of its operations say: 8 2^-106 for each operand or factor."""

    SIZE = {"add": 8 * H, "sub": 8 * H, "mul": 8 * H}

    def __init__(self, value):
        self.exact = value

    def lanewise(self, other, f):
        if isinstance(self.exact, Pair):
            return Double(self.exact.each(other.exact, f))
        return Double(f(self.exact, other.exact))

    def add(self, other):
        size = self.SIZE["add"]
        return self.lanewise(other, lambda x, y: x.rounded("d", size).plus(y.rounded("d", size)))

    def sub(self, other):
        size = self.SIZE["sub"]
        return self.lanewise(other, lambda x, y: x.rounded("d", size).plus((-y).rounded("d", size)))

    def mul(self, other):
        def product(x, y):
            rounded = F(x.context, times(x.terms, y.terms)).rounded("d", self.SIZE["mul"])
            if x.context.underflows:
                for _ in range(6):
                    rounded = rounded.plus(F.exactly(x.context, x.context.underflow()))
            return rounded

        return self.lanewise(other, product)

    def swapped(self):
        return Double(self.exact.swapped())

    def transposed(self, other):
        return [Double(pair) for pair in self.exact.transposed(other.exact)]

    def lanes(self):
        return [Double(x) for x in self.exact.ends]

    def value(self):
        return self.exact

    @property
    def high(self):
        return self.exact
