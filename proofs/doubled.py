"""Claims about double-double arithmetic, and what is computed with it at a root."""

from fractions import Fraction

from engine import AXES, HERE, cross, dot, limit, reach_name, sizes_of_ends
from filters import cubic_run
from places import Located, check, exact_vectors, is_narrow, kept
from prove import Refused, polynomial, product, scaled, total
from rounded import Context, Double, F, H, Pair, U, runs
from rust import Parser, Record
from tokens import tokens_of

# Double-double arithmetic


def double_operation(engine, claim, name):
    """The operations of `Double`, from those without error: `two_sum`, `two_product` and `sum`."""
    # As rounding to nearest has it, of each part as well.
    half = U / (1 + U)
    context = Context(half=half)
    interpreter = engine.interpreter(context)

    class Parts:
        def __init__(self, high, low):
            self.high, self.low = high, low

    def two_sum(a, b):
        low = F.exactly(context, "low")
        return Parts(F(context, {**a.terms, (("low",), ()): Fraction(-1)}).plus(b), low)

    def two_difference(a, b):
        return two_sum(a, -b)

    def two_product(a, b):
        high = F(context, {(("xh", "yh"), ()): Fraction(1), (("low",), ()): Fraction(-1)})
        if (a.leaf(), b.leaf()) != (("xh", 1), ("yh", 1)):
            raise Refused("a product of other parts")
        return Parts(high, F.exactly(context, "low"))

    interpreter.builtins.update({
        "two_sum": two_sum,
        "two_difference": two_difference,
        "two_product": two_product,
        "Self::sum": lambda a, b: a.plus(b),
    })
    x, y = (Parts(F.exactly(context, f"{z}h"), F.exactly(context, f"{z}l")) for z in "xy")
    found = interpreter.apply(engine.sources.file(f"{HERE}double.rs").functions["Double", name], [x, y])
    near = 1 + half
    relative = name == "mul"
    if relative:
        said = engine.said("double", r"`self other`; relative error below `(\d+) \* 2\^-106`")
        exact = product(polynomial((1, "xh"), (1, "xl")), polynomial((1, "yh"), (1, "yl")))
        bound = F.size(context, "x", "y", factor=said * H)
        low = polynomial((half * near * near, "x", "y"))
    else:
        said = engine.said("double", r"an error below `(\d+) \* 2\^-106 \(\|self\| \+ \|other\|\)`")
        sign = 1 if name == "add" else -1
        exact = polynomial((1, "xh"), (1, "xl"), (sign, "yh"), (sign, "yl"))
        bound = limit(context, said * H, "xy")
        low = polynomial((half * near, "x"), (half * near, "y"))

    def sizes(name):
        if name == "low":
            return low
        return {(name[0],): near if name[1] == "h" else half}

    claim.needs(found, exact, bound, sizes)


def double_sizes(engine):
    """What the comments of the operations say, which is proved of these."""
    both = engine.said("double", r"an error below `(\d+) \* 2\^-106 \(\|self\| \+ \|other\|\)`") * H
    Double.SIZE = {"add": both, "sub": both, "mul": engine.said("double", r"`self other`; relative error below `(\d+) \* 2\^-106`") * H}


SIDES = {"ab": "k", "cd": "l", "ac": "m"}


def points(context):
    """The corners at both ends of the step."""
    return [[Pair(F.exactly(context, f"{p}0{a}"), F.exactly(context, f"{p}1{a}")) for a in AXES] for p in "abcd"]


def exact_difference(context):
    """`two_difference` of two corners: a difference without error, by its name."""

    def difference(to, start):
        names = [(x.leaf()[0], y.leaf()[0]) for x, y in zip(start.ends, to.ends)]
        return Double(Pair(*(F.exactly(context, f"{SIDES[x[0] + y[0]]}{x[1:]}") for x, y in names)))

    return difference


def refined_difference(engine, claim, underflows=False):
    """A difference of two corners at a time."""
    double_sizes(engine)
    context = Context(underflows=underflows)
    interpreter = engine.interpreter(context)
    interpreter.builtins["two_difference"] = exact_difference(context)
    (a, b, c, d), time = points(context), Double(F.exactly(context, "time"))
    found = interpreter.run(f"{HERE}refine.rs", "difference", [a[0], c[0]], [b[0], d[0]], time)
    said = engine.said("refine", r"the sum within `24 h k` more \(bounds at the operations\): `([\d.]+) h k`")
    for name, lane in zip("kl", found.exact.ends):
        if underflows:
            claim.underflow(lane, lambda name: engine.largest(), UNDERFLOW)
            continue
        exact = polynomial((1, f"{name}0x"), (1, f"{name}1x", "time"), (-1, f"{name}0x", "time"))
        bound = F.size(context, f"{name.upper()}x", factor=said * H)
        sizes = lambda name: {(): Fraction(1)} if name == "time" else sizes_of_ends(name)
        claim.needs(lane, exact, bound, sizes)


# What underflow adds to a component at a time in double-double arithmetic.
UNDERFLOW = Fraction(2) ** -1072


class Refined(Located):
    """Vectors at the time of a root in double-double arithmetic."""

    def __init__(self, engine, moves):
        double_sizes(engine)
        self.error = H * engine.said("refine", r"the sum within `24 h k` more \(bounds at the operations\): `([\d.]+) h k`")
        self.moves, self.largest = moves, engine.largest()

    def difference(self, context):
        def of(starts, ends_of, _):
            lanes = []
            for start, end in zip(starts, ends_of):
                (x, _), (y, _) = start.ends[0].leaf(), end.ends[0].leaf()
                name, axis = SIDES[x[0] + y[0]], x[2]
                terms = {((f"{kind}{name}{axis}",), ()): Fraction(1) for kind in (["", "w", "r"] if self.moves else ["", "r"])}
                if context.underflows:
                    context.count += 1
                    # In units of 2^-1075.
                    terms[((f"n{context.count}",), ())] = UNDERFLOW * 2**1075
                lanes.append(F(context, terms))
            return Double(Pair(*lanes))

        return of


class Corners:
    def __init__(self, context):
        self.context = context

    def points(self):
        return points(self.context)


def refined_value(engine, claim, underflows=False):
    """`f` at a time, against the error that a root takes it for."""
    refined = Refined(engine, moves=False)
    context = Context(reaches=reach_name, underflows=underflows)
    interpreter = engine.interpreter(context)
    interpreter.builtins["difference"] = refined.difference(context)
    found = interpreter.run(f"{HERE}refine.rs", "evaluate", points(context), None)
    v = exact_vectors()
    exact = dot(v["m"], cross(v["k"], v["l"]))
    factor = engine.constant("refine", "VALUE_ERROR")
    _, cubic = cubic_run(engine, context)
    if underflows:
        # Beside what is proved of the rest: 40 h P.
        claim.underflow(found, refined.magnitude, 40 * H * engine.constant("cubic", "SMALLEST"))
        return
    permanent = cubic.fields["permanent"]
    spare = {names: 40 * H for names, _ in permanent.terms}
    claim.needs(found, exact, permanent * float(factor), refined.sizes, needed=spare)


def refined_meeting(engine, claim, field, underflows=False, part=None):
    """The minors at a root, on each axis."""
    refined = Refined(engine, moves=True)
    v = exact_vectors()

    def body(context):
        interpreter, axes = engine.interpreter(context), []

        error, is_below = F.size(context, "W"), Parser(tokens_of("normal.high < 0.0")).expression()

        def branch(condition, go, otherwise):
            # The sign of the normal does not matter.
            if condition == is_below:
                return False
            if "error" in repr(condition) or len(axes) == 2 or axes == [True]:
                return is_narrow(error, condition, go, otherwise)
            axes.append(context.choose([True, False]))
            return axes[-1]

        interpreter.builtins.update({"difference": refined.difference(context), "if": branch})
        # It only tells which axis is taken.
        interpreter.given["Motion", "normal"] = [0, 0, 0]
        this = Record("Root", time=Record("Double", high=None), error=error)
        cubic = Record("Cubic", reach=[[F.size(context, f"{name}{axis}").rounded() for axis in AXES] for name in "KLM"])
        arguments = (Corners(context), Record("Motion"), cubic)
        found = interpreter.run(f"{HERE}refine.rs", "meeting", *arguments, of="Root", this=this)
        return 0 if axes[0] else (1 if axes[1] else 2), found

    for context, (axis, found) in runs(body, underflows=underflows):
        minors = {"n": cross(v["k"], v["l"]), "u": cross(v["m"], v["l"]), "v": cross(v["m"], v["k"])}
        exact = {name: minor[axis] for name, minor in minors.items()}
        exact["before_b"] = total(exact["n"], scaled(-1, exact["u"]))
        exact["before_d"] = total(exact["n"], scaled(-1, exact["v"]))
        # Rounded to `f64` they compare with an `f64` as before.
        interpreter = engine.interpreter(context)
        far = interpreter.run(f"{HERE}locate.rs", "far_errors", of="Meeting", this=found)
        bounds = dict(zip(("n", "u", "v", "before_b", "before_d"), [found.fields[f"error_{x}"] for x in "nuv"] + list(far)))
        check(claim, found.fields[field], exact[field], bounds[field], refined, underflows)
    kept(claim, part)
