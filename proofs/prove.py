"""Claims about errors as goals for Gappa.

A claim compares what roundings do to a computed number with the bound that the source computes, for each product of sizes apart: both
are sums of such products, so that it holds if it holds for each.
"""

import re
import subprocess
from fractions import Fraction
from math import comb

from rounded import U, is_magnitude, magnitude, plain, underflowed

PRECISION = "-Eprecision=300"


class Refused(Exception):
    """What is claimed is not so, or not proved."""


def text_of(number):
    number = Fraction(number)
    if number.denominator & (number.denominator - 1) == 0:
        shift = number.denominator.bit_length() - 1
        return f"{number.numerator}b-{shift}" if shift else str(number.numerator)
    return f"({number.numerator} / {text_of(number.denominator)})"


def not_below(number):
    """The text of a dyadic number that is a little larger, unless the number is dyadic."""
    number = Fraction(number)
    if number.denominator & (number.denominator - 1):
        number = Fraction(number.numerator * 2**400 // number.denominator + 1, 2**400)
    return text_of(number)


def polynomial(*terms):
    """`[(factor, names..)..]` as a polynomial."""
    found = {}
    for factor, *names in terms:
        key = tuple(sorted(names))
        found[key] = found.get(key, 0) + Fraction(factor)
    return found


def product(x, y):
    found = {}
    for a, c in x.items():
        for b, d in y.items():
            key = tuple(sorted(a + b))
            found[key] = found.get(key, 0) + c * d
    return found


def total(*polynomials):
    found = {}
    for x in polynomials:
        for key, c in x.items():
            found[key] = found.get(key, 0) + c
    return {key: c for key, c in found.items() if c}


def scaled(factor, x):
    return {key: Fraction(factor) * c for key, c in x.items()}


def magnitudes(names):
    """The names of a bound's product, of magnitudes. A square is one of a magnitude as well."""
    signed = [name for name in names if not is_magnitude(name)]
    if any(names.count(name) % 2 for name in signed):
        raise Refused(f"{' '.join(names)} may be below 0")
    return tuple(sorted(map(magnitude, names)))


class Goal:
    """`error <= bound`, both texts for Gappa with roundings by name."""

    def __init__(self, error, bound, sizes, of):
        self.error, self.bound, self.sizes, self.of = error, bound, sizes, of

    def key(self):
        return (self.error, self.bound)


class Claim:
    """A bound of the source, and what it has to be proved from."""

    def __init__(self, name, where, unit=U, unit_name="u"):
        self.name, self.where, self.unit, self.unit_name = name, where, unit, unit_name
        self.goals, self.lemmas = {}, {}

    def needs(self, value, exact, bound, sizes, needed=None, merge=lambda names: ({}, names)):
        """That `value` is within `bound` of the polynomial `exact`, with `needed` to spare.

        `sizes` gives a polynomial that the magnitude of a quantity does not exceed; without one it is the quantity's own magnitude. These
        and `needed` are of magnitudes, whatever the names in them.
        `merge` replaces a product of sizes by a number times another one that is not smaller.
        """
        context = value.context
        self.take_lemmas(context)
        monomials, expected = {}, dict(exact)
        for (names, es), c in value.terms.items():
            if not underflowed(names):
                monomials.setdefault(names, []).append((c, es))
        errors = {}
        for names in {**monomials, **expected}:
            if names not in expected and any(map(is_magnitude, names)):
                raise Refused(f"{self.name}: a magnitude {' '.join(names)} in the value")
            text = self.sum_of(monomials.get(names, []), -expected.get(names, Fraction(0)))
            if text is None:
                continue
            times = (names.count("s"), names.count("t"))
            size = {(): Fraction(1)}
            for name in names:
                if name not in "st":
                    size = product(size, sizes(name) or {(name,): Fraction(1)})
            for key, factor in size.items():
                more, key = merge(tuple(sorted(map(magnitude, key))))
                errors.setdefault((key, times), []).append((factor * (more or 1), text))
        needed = {tuple(sorted(map(magnitude, key))): factor for key, factor in (needed or {}).items()}
        self.compare(context, errors, bound, needed, merge)

    @staticmethod
    def sum_of(terms, rest):
        if sum((c for c, _ in terms), rest) == 0 and all(not es for _, es in terms):
            return None
        parts = [" * ".join([text_of(c)] + [f"(1 + {e})" for e in es]) for c, es in terms]
        return " + ".join(parts + [text_of(rest)])

    def compare(self, context, errors, bound, needed, merge):
        bounds = {}
        for (names, es), c in bound.terms.items():
            if not underflowed(names):
                more, names = merge(magnitudes(names))
                bounds.setdefault(names, []).append((c * (more or 1), es))
        degrees = {sum(times) for _, times in errors}
        if len(degrees) > 1:
            raise Refused(f"{self.name}: weights of several degrees")
        keys = set(errors) | {(key, None) for key in needed if not any(key == names for names, _ in errors)}
        for names in set(bounds) - {names for names, _ in keys}:
            if any(c < 0 for c, _ in bounds[names]):
                raise Refused(f"{self.name}: the bound has less than {' '.join(names)}")
        for key, times in keys:
            share = comb(sum(times), times[0]) if times else 1
            error = [f"{text_of(factor / share)} * |{text}|" for factor, text in errors.get((key, times), [])]
            if key in needed:
                error.append(text_of(needed[key]))
            limit = self.sum_of(bounds.get(key, []), Fraction(0))
            if limit is None:
                raise Refused(f"{self.name}: nothing bounds {' '.join(key)}")
            self.add(" + ".join(error), limit, context.sizes, key)

    def underflow(self, value, sizes, limit):
        """That what underflow adds to a value is at most a number."""
        context, parts = value.context, []
        for (names, es), c in value.terms.items():
            if underflowed(names):
                size = abs(c)
                for name in names:
                    size *= Fraction(1, 2**1075) if underflowed([name]) else sizes(plain(name))
                parts.append(" * ".join([text_of(size)] + [f"(1 + {e})" for e in es]))
        if not parts:
            raise Refused(f"{self.name}: nothing underflows")
        self.add(" + ".join(sorted(parts)), text_of(limit), context.sizes)

    def at_most(self, error, bound, sizes=None):
        """A comparison of two texts."""
        self.add(error, bound, sizes or {})

    def take_lemmas(self, context):
        for roundings, size in context.lemmas:
            names = [f"e{i}" for i in range(len(roundings))]
            product = " * ".join(f"(1 + {name})" for name in names)
            text = f"sqrt({product}) - 1"
            self.lemmas[text, size] = {name: s for name, (_, s) in zip(names, roundings)}

    def add(self, error, bound, sizes, of=()):
        names = {}

        def rename(match):
            return names.setdefault(match.group(), f"r{len(names)}")

        pattern = r"\b[edq]\d+\b"
        error, bound = re.sub(pattern, rename, error), re.sub(pattern, rename, bound)
        goal = Goal(error, bound, {short: sizes[name] for name, short in names.items()}, tuple(map(plain, of)))
        self.goals[goal.key()] = goal

    def keep(self, is_kept):
        """Only the goals of some products of sizes."""
        self.goals = {key: goal for key, goal in self.goals.items() if is_kept(goal.of)}
        if not self.goals:
            raise Refused(f"{self.name}: nothing is claimed")

    # Gappa

    def script(self, factor=None):
        """All goals as one script; with a factor, that of the bounds, to be proved, else to be measured."""
        lines, hypotheses, goals = [], [], []
        for number, goal in enumerate(self.goals.values()):
            fresh = lambda text: re.sub(r"\br(\d+)\b", rf"r{number}_\1", text)
            # Gappa does not keep apart what is written the same.
            fresh_bound = f"{fresh(goal.bound)} + {number} * zero"
            for name, size in goal.sizes.items():
                hypotheses.append(f"{fresh(name)} in [-{not_below(size)}, {not_below(size)}]")
            lines += [f"E{number} = {fresh(goal.error)} + {number} * zero;", f"B{number} = {fresh_bound};"]
            if factor is None:
                goals += [f"E{number} in ?", f"B{number} in ?"]
            else:
                goals.append(f"E{number} - {text_of(factor)} * B{number} <= 0")
        for number, ((text, size), sizes) in enumerate(self.lemmas.items()):
            fresh = lambda text: re.sub(r"\be(\d+)\b", rf"l{number}_\1", text)
            hypotheses += [f"{fresh(name)} in [-{not_below(s)}, {not_below(s)}]" for name, s in sizes.items()]
            lines.append(f"L{number} = {fresh(text)};")
            if factor is not None:
                goals.append(f"|L{number}| - {text_of(size)} <= 0")
        given = " /\\ ".join(hypotheses + ["zero in [0, 0]"])
        return "\n".join([f"# {self.name}: {self.where}", *lines, "", "{ " + given + " ->", "  " + " /\\\n  ".join(goals) + " }", ""])

    def gappa(self, script):
        return subprocess.run(["gappa", PRECISION], input=script, capture_output=True, text=True)

    def measure(self):
        """The largest quotient of what is proved and what is claimed, and both of these where it is."""
        run = self.gappa(self.script())
        found = re.findall(r"^\s*([EB]\d+) in \[([^\],]+?)(?: \{[^}]*\})?, ([^\],]+?)(?: \{[^}]*\})?\]", run.stdout + run.stderr, re.M)
        values = {name: (number_of(low), number_of(high)) for name, low, high in found}
        worst, goals = None, list(self.goals.values())
        for number in range(len(self.goals)):
            if f"E{number}" not in values or f"B{number}" not in values:
                raise Refused(f"{self.name}: Gappa says nothing of goal {number}: {(run.stdout + run.stderr)[:500]}")
            error, bound = values[f"E{number}"][1], values[f"B{number}"][0]
            if bound <= 0:
                raise Refused(f"{self.name}: a bound that is not above 0")
            if worst is None or error / bound > worst[0]:
                worst = (error / bound, error, bound, goals[number].of)
        return worst

    def holds(self, factor=Fraction(1)):
        return self.gappa(self.script(factor)).returncode == 0


def number_of(text):
    match = re.fullmatch(r"(-?\d+)(?:b(-?\d+))?", text.strip())
    if not match:
        raise Refused(f"Gappa's number {text!r}")
    power = int(match.group(2) or 0)
    return int(match.group(1)) * (Fraction(2**power) if power >= 0 else Fraction(1, 2**-power))


class Lemma(Claim):
    """A statement about `f64` itself, with a size that can be no smaller."""

    def __init__(self, name, where, hypothesis, rounded, operator, size):
        super().__init__(name, where)
        self.unit = None
        self.hypothesis, self.rounded, self.operator, self.size = hypothesis, rounded, operator, Fraction(size)

    def script(self, factor=None):
        bound = text_of(self.size * (factor or 1))
        goal = f"f({self.rounded}) {self.operator} ({self.rounded}) in [-{bound}, {bound}]"
        return f"# {self.name}\n@f = float<ieee_64,ne>;\n{{ {self.hypothesis} -> {goal} }}\n"

    def measure(self):
        return Fraction(1), self.size, self.size, ()

    def holds(self, factor=Fraction(1)):
        factor = Fraction(factor)
        if factor.denominator & (factor.denominator - 1):
            factor = Fraction(factor.numerator * 2**60 // factor.denominator, 2**60)
        return self.gappa(self.script(factor)).returncode == 0
