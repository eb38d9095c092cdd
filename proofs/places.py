"""Claims about vectors at a time, and about where lines meet."""

import re
from fractions import Fraction

from engine import AXES, HERE, cross, differences, dot, own, sizes_of_ends
from prove import Refused, polynomial, scaled, total
from rounded import Context, F, U
from rust import Record

# Vectors at a time, and where the lines meet


# What underflow adds to a component.
LOST = Fraction(2) ** -1074 * (1 + 4 * U)


def at_time(engine, claim):
    """A component at a time, from differences that are rounded."""
    context = Context()
    found = engine.interpreter(context).run(f"{HERE}locate.rs", "at", differences(context, "k"), F.exactly(context, "t"))
    said = engine.said("locate", r"A component of `K\(t\)` is within `([\d.]+) u k_i` of the exact one")
    for i, axis in enumerate(AXES):
        exact = polynomial((1, f"k0{axis}", "s"), (1, f"k1{axis}", "t"))
        claim.needs(found[i], exact, F.size(context, f"K{axis}", factor=said * U), sizes_of_ends)


def at_time_underflow(engine, claim):
    context = Context(underflows=True)
    found = engine.interpreter(context).run(f"{HERE}locate.rs", "at", differences(context, "k"), F.exactly(context, "t"))
    for component in found:
        claim.underflow(component, lambda name: Fraction(1), LOST)


def sizes_at_time(name, error):
    """Those of [`Located`], rounded by a relative error."""
    match = re.fullmatch(r"([wr]?)([klm])([xyz])", name)
    if not match:
        return None
    kind, letter, axis = match.groups()
    reach = letter.upper() + axis
    return {"": own(reach), "w": polynomial((2, "W", reach)), "r": polynomial((error, reach))}[kind]


NARROW = Fraction(1, 8)


def is_narrow(width, condition, go, otherwise):
    """Of an `if`: that it is `width < c`, with a `c` of the source that is no more than an 8th, and that what is wider has no bound."""
    kind, *parts = condition
    if (kind, parts[0]) != ("binary", "<") or go(parts[1]) is not width or not go(parts[2]) <= NARROW:
        raise Refused(f"a condition that is not of the width: {condition}")
    if go(otherwise) != float("inf"):
        raise Refused("a bound for what is not narrow")
    return True


class Located:
    """Vectors at a computed time: exact ones at the root, what the way there changes, and what is rounded or underflows."""

    def __init__(self, engine, said):
        self.error, self.largest = said * U, engine.largest()

    def vector(self, context, name):
        def component(axis):
            terms = {((f"{kind}{name}{axis}",), ()): Fraction(1) for kind in ("", "w", "r")}
            if context.underflows:
                terms[((context.underflow(),), ())] = LOST * 2**1075
            return F(context, terms)

        return [component(axis) for axis in AXES]

    def sizes(self, name):
        return sizes_at_time(name, self.error)

    def magnitude(self, name):
        """With a cubic; `N` is a computed normal."""
        return 2 * self.largest**2 * (1 + 64 * U) if name[0] == "N" else self.largest

    @staticmethod
    def merge(names):
        """`W` is below an 8th, as [`is_narrow`] makes sure."""
        extra = max(names.count("|W|") - 1, 0)
        rest = [name for name in names if name != "|W|"] + ["|W|"] * min(names.count("|W|"), 1)
        return NARROW**extra, tuple(sorted(rest))


def exact_vectors():
    return {name: [own(f"{name}{axis}") for axis in AXES] for name in "klm"}


def meeting_run(engine, context, located):
    """`Motion::meeting`, the computed normal taken as any vector `N`."""
    vectors = {}

    def motion_vector(name):
        vectors[name] = located.vector(context, name)
        return name

    # Half the width is computed as no less than it is.
    width = F.size(context, "W").rounded()
    interpreter = engine.interpreter(context)
    plain = engine.interpreter(context)
    normals = []

    def cross_of(x, y):
        found = plain.run(f"{HERE}motion.rs", "cross", x, y)
        if not normals:
            for axis, component in zip(AXES, found):
                component.alias = F.exactly(context, f"N{axis}")
            normals.append(found)
        return found

    dot_of = lambda x, y: plain.run(f"{HERE}motion.rs", "dot", x, [c.alias or c for c in y])
    interpreter.builtins.update({
        "at": lambda name, _: vectors[name],
        "cross": cross_of,
        "dot": dot_of,
        "if": lambda *of: is_narrow(width, *of),
    })
    motion = Record("Motion", k=motion_vector("k"), l=motion_vector("l"), m=motion_vector("m"))
    reach = [[F.size(context, f"{name}{axis}").rounded() for axis in AXES] for name in "KLM"]
    cubic = Record("Cubic", reach=reach)

    class Bracket:
        low = Width(0, width)
        high = Width(1, width)

    return interpreter, motion, cubic, Bracket


class Width:
    """An end of a bracket: half the difference is the half width, half the sum any time."""

    def __init__(self, kind, width):
        self.kind, self.width = kind, width

    def __add__(self, other):
        return self

    def __rmul__(self, factor):
        if factor != 0.5:
            raise Refused("a half that is none")
        return self

    def __sub__(self, other):
        if (self.kind, other.kind) != (1, 0):
            raise Refused("a width that is none")
        return HalfWidth(self.width)


class HalfWidth:
    def __init__(self, width):
        self.width = width

    def __rmul__(self, factor):
        if factor != 0.5:
            raise Refused("a half that is none")
        return AddsU(self.width)


class AddsU:
    """Plus `U`, which is more than the rounding of the middle."""

    def __init__(self, width):
        self.width = width

    def __add__(self, other):
        if Fraction(other) != U:
            raise Refused("a width without its rounding")
        return self.width


def products_with_normal():
    v = exact_vectors()
    normal = [own(f"N{axis}") for axis in AXES]
    n, u, w = (dot(cross(v[a], v[b]), normal) for a, b in ("kl", "ml", "mk"))
    minus = lambda x, y: total(x, scaled(-1, y))
    return {"n": n, "u": u, "v": w, "before_b": minus(n, u), "before_d": minus(n, w)}


def said_at(engine):
    return engine.said("locate", r"A component of `K\(t\)` is within `([\d.]+) u k_i` of the exact one")


def meeting(engine, claim, field, underflows=False, part=None):
    located = Located(engine, said_at(engine))
    context = Context(underflows=underflows)
    interpreter, motion, cubic, bracket = meeting_run(engine, context, located)
    found = interpreter.run(f"{HERE}locate.rs", "meeting", cubic, bracket, of="Motion", this=motion)
    far = interpreter.run(f"{HERE}locate.rs", "far_errors", of="Meeting", this=found)
    bounds = {
        "n": found.fields["error_n"],
        "u": found.fields["error_u"],
        "v": found.fields["error_v"],
        "before_b": far[0],
        "before_d": far[1],
    }
    check(claim, found.fields[field], products_with_normal()[field], bounds[field], located, underflows)
    kept(claim, part)


def kept(claim, part):
    """What is of the width of the bracket, or what is not."""
    if part:
        claim.keep(lambda of: ("W" in of) == (part == "width"))


def check(claim, found, exact, bound, located, underflows):
    """Against the part of a bound that is relative, or what underflows against the other part."""
    relative = F(bound.context, {key: c for key, c in bound.terms.items() if key[0]})
    constant = F(bound.context, {key: c for key, c in bound.terms.items() if not key[0]})
    if underflows:
        least = sum((c for c in constant.terms.values()), Fraction(0)) * (1 - 64 * U)
        claim.underflow(found, located.magnitude, least / 2)
    else:
        claim.needs(found, exact, relative, located.sizes, merge=located.merge)


def weights(engine, claim, index, underflows=False, part=None):
    """The raw weights of a vertex in a face."""
    located = Located(engine, said_at(engine))
    context = Context(underflows=underflows)
    interpreter, motion, cubic, bracket = meeting_run(engine, context, located)
    found = interpreter.run(f"{HERE}face/place.rs", "raw_weights", motion, cubic, bracket)
    p = products_with_normal()
    expected = [total(p["n"], scaled(-1, p["u"]), p["v"]), p["u"], scaled(-1, p["v"])]
    check(claim, found.fields["values"][index], expected[index], found.fields["errors"][index], located, underflows)
    kept(claim, part)
