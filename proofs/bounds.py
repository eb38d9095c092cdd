"""The bounds: which functions of the sources are run on what, and what has to come out."""

import re
from fractions import Fraction

from prove import Claim, Refused, polynomial, product, scaled, total
from rounded import H, U, Context, Double, F, Pair, runs
from rust import Interpreter, Record, Sources

HERE = "src/certified/"
AXES = "xyz"
LARGE = Fraction(2) ** 180


def one(names):
    """A polynomial of a single product."""
    return polynomial((1, *names))


def own(name):
    return {(name,): Fraction(1)}


class Engine:
    """The sources, and how their functions are run."""

    TYPES = {
        "Motion": ["motion", "separate", "locate"],
        "Cubic": ["cubic", "root"],
        "Part": ["root"],
        "SweptBoxes": ["separate"],
        "Meeting": ["locate"],
        "RawWeights": ["face/place"],
        "Root": ["refine"],
        "Moving": ["thick/advance", "thick/nearness", "thick/turning", "thick/mod"],
        "Instant": ["thick/instant"],
        "Edges": ["discrete"],
        "EdgeEdge": ["edges"],
        "VertexFace": ["face/mod"],
        "Step": ["normal/bounded"],
        "Bounded": ["normal/bounded"],
    }

    def __init__(self, root):
        self.sources = Sources(root)
        self.types = {name: [f"{HERE}{file}.rs" for file in files] for name, files in self.TYPES.items()}

    def interpreter(self, context, **more):
        exactly = lambda x: Double(x)
        builtins = {
            "if": lambda condition, go: context.choose([True, False]),
            "f64::abs": lambda x: x.abs() if isinstance(x, F) else x,
            "E::swapped": Pair.swapped,
            "E::both": lambda x: Pair(x, x),
            "E::new": Pair,
            "f64x2::both": lambda x: Pair(x, x),
            "Double::both": lambda x: Double(Pair(x.exact, x.exact)),
            "f64::EPSILON": 2.0**-52,
            "f64::INFINITY": float("inf"),
            "f64::from_bits": from_bits,
            "larger": lambda x, y: x.larger(y),
            "smaller": lambda x, y: x.smaller(y),
            "structure Double": lambda fields: exactly(fields["high"]),
        }
        builtins.update(more)
        methods = {
            "map": lambda values, f: [f(x) for x in values],
            "each_ref": lambda values: values,
            "iter": lambda values: values,
            "then_some": lambda _, value: value,
            "sum": lambda value: value.sum() if isinstance(value, Pair) else summed(value),
        }
        return Interpreter(self.sources, builtins, methods, self.types)

    def constant(self, file, name):
        return Fraction(self.interpreter(Context()).constant(f"{HERE}{file}.rs", name))

    def said(self, file, pattern):
        """A number that a comment states."""
        text = re.sub(r"\s*\n\s*///?\s*", " ", self.sources.file(f"{HERE}{file}.rs").text)
        found = set(re.findall(pattern, text))
        if len(found) != 1:
            raise Refused(f"{file}.rs says {pattern} as {sorted(found)}")
        return Fraction(found.pop())


def from_bits(bits):
    import struct

    return struct.unpack("<d", struct.pack("<Q", int(bits)))[0]


def summed(values):
    result = values[0]
    for value in values[1:]:
        result = result + value
    return result


def differences(context, name):
    """A rounded difference at both ends of the step, on each axis."""
    return [Pair(*(F.exactly(context, f"{name}{end}{axis}").rounded() for end in "01")) for axis in AXES]


def reach_name(name):
    """`k0x` reaches `Kx`."""
    return name[0].upper() + name[2]


def sizes_of_ends(name):
    return own(reach_name(name)) if re.fullmatch(r"[klm][01][xyz]", name) else None


def cross(x, y):
    """The exact cross product of vectors of polynomials."""
    minor = lambda i, j: total(product(x[i], y[j]), scaled(-1, product(x[j], y[i])))
    return [minor(1, 2), minor(2, 0), minor(0, 1)]


def dot(x, y):
    return total(*(product(a, b) for a, b in zip(x, y)))


def ends(name, end):
    return [own(f"{name}{end}{axis}") for axis in AXES]


# Separation


def separated(engine, claim, file, of, options, kinds):
    """A direction separates: the margin against the error bound of the boxes."""

    def body(context):
        interpreter = engine.interpreter(context)
        motion = Record("Motion", **{name: differences(context, name) for name in "klm"})
        extent = [F.exactly(context, f"e{axis}").rounded() for axis in AXES]
        boxes = Record("SweptBoxes", extent=extent)
        d = [F.exactly(context, f"d{axis}") for axis in AXES]
        if of:
            interpreter.run(f"{HERE}{file}.rs", "is_separated_by", d, boxes, of=of, this=motion)
        else:
            interpreter.run(f"{HERE}{file}.rs", "is_separated_by", motion, d, boxes)
        return context.compared

    sizes = lambda name: own("e" + name[2]) if re.fullmatch(r"[klm][01][xyz]", name) else None
    for context, compared in runs(body):
        chosen(context, *kinds)
        for end, (margin, bound) in enumerate(compared[:2]):
            along = {name: dot(ends(name, end), [own(f"d{axis}") for axis in AXES]) for name in "klm"}
            exact = same_as_one_of(margin, [total(*(scaled(f, along[n]) for n, f in option.items())) for option in options])
            claim.needs(margin, exact, bound, sizes)


def same_as_one_of(value, polynomials):
    """That which the value is without roundings."""
    found = {}
    for (names, _), c in value.terms.items():
        found[names] = found.get(names, 0) + c
    found = {names: c for names, c in found.items() if c}
    for candidate in polynomials:
        if found == candidate:
            return candidate
    raise Refused("a value that is none of those that it should be")


def chosen(context, *kinds):
    """That the larger and the smaller ones are taken where they should be."""
    if tuple(context.kinds) != kinds:
        raise Refused(f"{', '.join(context.kinds)} instead of {', '.join(kinds)}")


EDGE_MARGINS = [{"m": 1, **l, **k} for l in ({}, {"l": 1}) for k in ({}, {"k": -1})]
FACE_MARGINS = [{"m": -1}, {"k": 1, "m": -1}, {"l": 1, "m": -1}]


# The cubic


def cubic_run(engine, context):
    interpreter = engine.interpreter(context)
    motion = Record("Motion", **{name: differences(context, name) for name in "klm"})
    return interpreter, interpreter.run(f"{HERE}cubic.rs", "unchecked", motion)


def exact_bernstein():
    """`det(M_a, K_b, L_c)` at the ends, averaged as in the comment of the source."""
    det = lambda a, b, c: dot(ends("m", a), cross(ends("k", b), ends("l", c)))
    third = Fraction(1, 3)
    return [
        det(0, 0, 0),
        scaled(third, total(det(1, 0, 0), det(0, 1, 0), det(0, 0, 1))),
        scaled(third, total(det(1, 1, 0), det(1, 0, 1), det(0, 1, 1))),
        det(1, 1, 1),
    ]


def bernstein(engine, claim, index):
    context = Context(reaches=reach_name)
    _, cubic = cubic_run(engine, context)
    claim.needs(cubic.fields["bernstein"][index], exact_bernstein()[index], cubic.fields["error"], sizes_of_ends)


def bernstein_underflow(engine, claim, index):
    """Less than a 16th of the bound of the smallest permanent."""
    context = Context(reaches=reach_name, underflows=True)
    _, cubic = cubic_run(engine, context)
    limit = 16 * U * engine.constant("cubic", "SMALLEST") / 16
    claim.underflow(cubic.fields["bernstein"][index], lambda name: engine.constant("cubic", "LARGEST"), limit)


def coefficients(context):
    return [F.exactly(context, f"b{i}") for i in range(4)]


def cubic_of(engine, context):
    """A cubic with coefficients of which only their error is known."""
    error = F.exactly(context, "error")
    return Record("Cubic", bernstein=coefficients(context), error=error, permanent=F.exactly(context, "P"))


def by_error(engine):
    """Coefficients are at most the permanent, of which `error` is so many `u`, and the error more."""
    context = Context(reaches=reach_name)
    _, cubic = cubic_run(engine, context)
    factors = {c for c in cubic.fields["error"].terms.values()}
    factor = min(factors)
    return lambda name: {("error",): (1 / factor) * (1 + 64 * U) * (1 + 64 * U)} if name[0] == "b" and name[1:].isdigit() else None


def value(engine, claim, index, method):
    context = Context()
    cubic, interpreter = cubic_of(engine, context), engine.interpreter(context)
    t = F.exactly(context, "t")
    found = interpreter.run(f"{HERE}root.rs", "evaluate", t, of="Cubic", this=cubic)[index]
    bound = interpreter.run(f"{HERE}root.rs", method, of="Cubic", this=cubic)
    if index == 0:
        exact = polynomial((1, "b0", "s", "s", "s"), (3, "b1", "s", "s", "t"), (3, "b2", "s", "t", "t"), (1, "b3", "t", "t", "t"))
        spare = {("error",): Fraction(1)}
    else:
        slopes = [((3, f"b{i + 1}"), (-3, f"b{i}")) for i in range(3)]
        weights = [(1, "s", "s"), (2, "s", "t"), (1, "t", "t")]
        exact = total(*(polynomial((f * w[0], b, *w[1:])) for pair, w in zip(slopes, weights) for f, b in pair))
        # Three times a difference of averages of coefficients.
        spare = {("error",): Fraction(6)}
    claim.needs(found, exact, bound, by_error(engine), needed=spare)


def curvature(engine, claim):
    """What is computed is not below the exact second derivative at either end."""

    def body(context):
        return engine.interpreter(context).run(f"{HERE}root.rs", "curvature", of="Cubic", this=cubic_of(engine, context))

    ends_of = [polynomial((6, f"b{i}"), (-12, f"b{i + 1}"), (6, f"b{i + 2}")) for i in range(2)]
    for context, found in runs(body):
        chosen(context, "larger")
        bound = F(context, {key: c for key, c in found.terms.items() if "error" in key[0]})
        computed = F(context, {key: c for key, c in found.terms.items() if "error" not in key[0]})
        exact = same_as_one_of(computed, ends_of)
        claim.needs(computed, exact, bound, by_error(engine), needed={("error",): Fraction(24)})


def side(engine, claim):
    """The side of a contact: the value's error, and how much it changes over `2 u`."""
    context = Context()
    cubic, interpreter = cubic_of(engine, context), engine.interpreter(context, **{"if": lambda condition, go: go(condition) and False})
    interpreter.run(f"{HERE}thick/contact.rs", "side", cubic, F.exactly(context, "t"))
    found, bound = context.compared[0]
    exact = polynomial((1, "b0", "s", "s", "s"), (3, "b1", "s", "s", "t"), (3, "b2", "s", "t", "t"), (1, "b3", "t", "t", "t"))
    size = by_error(engine)("b0")[("error",)]
    claim.needs(found, exact, bound, by_error(engine), needed={("error",): 1 + 2 * U * 3 * 2 * size})


def subdivision(engine, claim):
    """One level of halving, of magnitude `B`."""
    context = Context(half=U / (1 + U))
    interpreter = engine.interpreter(context)
    low, high = F.exactly(context, "low"), F.exactly(context, "high")
    part = Record("Part", low=low, high=high, bernstein=coefficients(context), depth=0)
    halves = interpreter.run(f"{HERE}root.rs", "halves", of="Part", this=part)
    level = engine.said("root", r"each level of averages of magnitude B adds at most `(\d+) u B`")
    limit = F(context, {(("B",), ()): level * U})
    half = lambda i, j: scaled(Fraction(1, 2), polynomial((1, f"b{i}"), (1, f"b{j}")))
    mean = lambda x, y: scaled(Fraction(1, 2), total(x, y))
    c = [half(0, 1), half(1, 2), half(2, 3)]
    d = [mean(c[0], c[1]), mean(c[1], c[2])]
    middle = mean(d[0], d[1])
    expected = [[own("b0"), c[0], d[0], middle], [middle, d[1], c[2], own("b3")]]
    sizes = lambda name: own("B") if name[0] == "b" else None
    for part, exact in zip(halves, expected):
        for found, polynomial_of in zip(part.fields["bernstein"], exact):
            if any(es for _, es in found.terms):
                claim.needs(found, polynomial_of, limit, sizes)
            elif {names: c for (names, _), c in found.terms.items()} != polynomial_of:
                raise Refused("a coefficient that is not kept")


def parts(engine, claim):
    """All levels: the error that they start from and that of each, of a magnitude that grows with it."""
    context = Context()
    cubic = cubic_of(engine, context)
    bound = engine.interpreter(context).run(f"{HERE}root.rs", "part_error", of="Cubic", this=cubic)
    ((_, es), factor), = bound.terms.items()
    depth = engine.constant("root", "MAX_DEPTH")
    level = engine.said("root", r"each level of averages of magnitude B adds at most `(\d+) u B`")
    size = by_error(engine)("b0")[("error",)]
    each = level * U * size * (1 + depth * level * U) ** int(depth)
    start = engine.said("cubic", r"so each coefficient is within `([\d.]+) u P` of the exact one") * U * size
    claim.at_most(text(start + depth * each), " * ".join([text(factor)] + [f"(1 + {e})" for e in es]), context.sizes)


def text(number):
    from prove import text_of

    return text_of(number)


# Vectors at a time, and where the lines meet


def at_time(engine, claim):
    """A component at a time, from differences that are rounded."""
    context = Context()
    found = engine.interpreter(context).run(f"{HERE}locate.rs", "at", differences(context, "k"), F.exactly(context, "t"))
    said = engine.said("locate", r"A component of `K\(t\)` is within `([\d.]+) u k_i` of the exact one")
    for i, axis in enumerate(AXES):
        exact = polynomial((1, f"k0{axis}", "s"), (1, f"k1{axis}", "t"))
        claim.needs(found[i], exact, F(context, {((f"K{axis}",), ()): said * U}), sizes_of_ends)


def at_time_underflow(engine, claim):
    context = Context(underflows=True)
    found = engine.interpreter(context).run(f"{HERE}locate.rs", "at", differences(context, "k"), F.exactly(context, "t"))
    for component in found:
        claim.underflow(component, lambda name: Fraction(1), Fraction(2) ** -1074 * (1 + 4 * U))


class Located:
    """Vectors at a computed time: exact ones at the root, what the way there changes, and what is rounded or underflows."""

    def __init__(self, engine, said):
        self.said = said

    def vector(self, context, name):
        def component(axis):
            terms = {((f"{kind}{name}{axis}",), ()): Fraction(1) for kind in ("", "w", "r")}
            if context.underflows:
                terms[((f"n{context.count + 1}",), ())] = Fraction(2)
                context.count += 1
            return F(context, terms)

        return [component(axis) for axis in AXES]

    def sizes(self, name):
        match = re.fullmatch(r"([wr]?)([klm])([xyz])", name)
        if not match:
            return None
        kind, letter, axis = match.groups()
        reach = letter.upper() + axis
        return {"": own(reach), "w": polynomial((2, "W", reach)), "r": polynomial((self.said * U, reach))}[kind]

    @staticmethod
    def merge(names):
        """`W` is at most an 8th."""
        extra = max(names.count("W") - 1, 0)
        rest = [name for name in names if name != "W"] + ["W"] * min(names.count("W"), 1)
        return Fraction(1, 8**extra), tuple(sorted(rest))


def exact_vectors():
    return {name: [own(f"{name}{axis}") for axis in AXES] for name in "klm"}


def meeting_run(engine, context, located):
    """`Motion::meeting`, the computed normal taken as any vector `N`."""
    vectors = {}

    def motion_vector(name):
        vectors[name] = located.vector(context, name)
        return name

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
        "if": lambda *_: True,
    })
    motion = Record("Motion", k=motion_vector("k"), l=motion_vector("l"), m=motion_vector("m"))
    reach = [[F.exactly(context, f"{name}{axis}").rounded() for axis in AXES] for name in "KLM"]
    cubic = Record("Cubic", reach=reach)
    # Half the width is computed as no less than it is.
    width = F.exactly(context, "W").rounded()

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
        claim.underflow(found, magnitude, least / 2)
    else:
        claim.needs(found, exact, relative, located.sizes, merge=located.merge)


def magnitude(name):
    """With a cubic."""
    if name[0] == "N":
        return 2 * LARGE * LARGE * (1 + 64 * U)
    if name[0] in "wr":
        return LARGE
    return LARGE


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
        bound = F(context, {(("x", "y"), ()): said * H})
        low = polynomial((half * near * near, "x", "y"))
    else:
        said = engine.said("double", r"an error below `(\d+) \* 2\^-106 \(\|self\| \+ \|other\|\)`")
        sign = 1 if name == "add" else -1
        exact = polynomial((1, "xh"), (1, "xl"), (sign, "yh"), (sign, "yl"))
        bound = F(context, {(("x",), ()): said * H, (("y",), ()): said * H})
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
            claim.underflow(lane, lambda name: LARGE, UNDERFLOW)
            continue
        exact = polynomial((1, f"{name}0x"), (1, f"{name}1x", "time"), (-1, f"{name}0x", "time"))
        bound = F(context, {((f"{name.upper()}x",), ()): said * H})
        sizes = lambda name: {(): Fraction(1)} if name == "time" else sizes_of_ends(name)
        claim.needs(lane, exact, bound, sizes)


# What underflow adds to a component at a time in double-double arithmetic.
UNDERFLOW = Fraction(2) ** -1072


class Refined(Located):
    """Vectors at the time of a root in double-double arithmetic."""

    def __init__(self, engine, moves):
        double_sizes(engine)
        self.said = engine.said("refine", r"the sum within `24 h k` more \(bounds at the operations\): `([\d.]+) h k`")
        self.moves = moves

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

    def sizes(self, name):
        match = re.fullmatch(r"([wr]?)([klm])([xyz])", name)
        if not match:
            return None
        kind, letter, axis = match.groups()
        reach = letter.upper() + axis
        return {"": own(reach), "w": polynomial((2, "W", reach)), "r": polynomial((self.said * H, reach))}[kind]


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
    found = interpreter.run(f"{HERE}refine.rs", "evaluate", Corners(context), None)
    v = exact_vectors()
    exact = dot(v["m"], cross(v["k"], v["l"]))
    factor = engine.constant("refine", "VALUE_ERROR")
    _, cubic = cubic_run(engine, context)
    if underflows:
        # Beside what is proved of the rest: 40 h P.
        claim.underflow(found, magnitude, 40 * H * engine.constant("cubic", "SMALLEST"))
        return
    permanent = cubic.fields["permanent"]
    spare = {names: 40 * H for names, _ in permanent.terms}
    claim.needs(found, exact, permanent * float(factor), refined.sizes, needed=spare)


def refined_meeting(engine, claim, field, underflows=False, part=None):
    """The minors at a root, on each axis."""
    refined = Refined(engine, moves=True)
    v = exact_vectors()

    def body(context):
        plain, interpreter = engine.interpreter(context), engine.interpreter(context)
        interpreter.builtins["difference"] = refined.difference(context)
        axes = []

        def chosen(condition, go):
            words = repr(condition)
            if "normal" in words and "high" in words:
                return False
            if "error" in words:
                return True
            axes.append(context.choose([True, False]))
            return axes[-1]

        interpreter.builtins["if"] = chosen
        this = Record("Root", time=Record("Time", high=None), error=F.exactly(context, "W"))
        motion = Record("Motion")
        interpreter.types = {**interpreter.types, "Motion": ["src/certified/motion.rs"]}
        interpreter.methods = dict(interpreter.methods)
        reach = [[F.exactly(context, f"{name}{axis}").rounded() for axis in AXES] for name in "KLM"]
        motion.fields["normal"] = None
        found = run_meeting(interpreter, this, context, reach)
        axis = 0 if axes[0] else (1 if axes[1] else 2)
        return axis, found

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


def run_meeting(interpreter, this, context, reach):
    class AnyMotion:
        @staticmethod
        def normal(_):
            return [None, None, None]

    interpreter.methods["normal"] = lambda motion, _: AnyVector()
    return interpreter.run(
        f"{HERE}refine.rs", "meeting", Corners(context), AnyMotion(), Record("Cubic", reach=reach), of="Root", this=this
    )


class AnyVector(list):
    """A vector that only tells which axis is taken."""

    def __init__(self):
        super().__init__([0, 0, 0])

    def map(self, _):
        return self


# With a radius


LEAST_CORNERS = {
    "edges": ("EdgeEdge", "edges", ("smaller", "larger"), [{"m": 1, **l, **k} for l in ({}, {"l": 1}) for k in ({}, {"k": -1})]),
    "face": ("VertexFace", "face/mod", ("smaller", "smaller"), [{"m": 1}, {"m": 1, "l": 1}, {"m": 1, "k": -1}]),
}


def thick_margin(engine, claim, kind, part):
    """A plane keeps the two more than the radius apart: all that is taken from the least corner."""
    of, file, kinds, options = LEAST_CORNERS[kind]

    def body(context):
        interpreter = engine.interpreter(context)
        interpreter.builtins["if"] = lambda condition, go: go(condition)
        interpreter.builtins["K::least_corner"] = lambda *x: interpreter.apply(
            engine.sources.file(f"{HERE}{file}.rs").functions[of, "least_corner"], list(x)
        )
        motion = Record("Motion", **{name: differences(context, name) for name in "klm"})
        boxes = Record("SweptBoxes", extent=[F.exactly(context, f"e{axis}").rounded() for axis in AXES])
        this = Record("Moving", motion=motion, boxes=boxes, radius=F.exactly(context, "R"))
        return interpreter.run(f"{HERE}thick/advance.rs", "margins", [F.exactly(context, f"d{axis}") for axis in AXES], of="Moving", this=this)

    sizes = lambda name: own("e" + name[2]) if re.fullmatch(r"[klm][01][xyz]", name) else None
    for context, found in runs(body):
        chosen(context, *kinds)
        for end, margin in enumerate(found):  # at the start and at the end
            is_corner = lambda names: any(re.fullmatch(r"[klm][01][xyz]", name) for name in names)
            corner = F(context, {key: c for key, c in margin.terms.items() if is_corner(key[0])})
            bound = F(context, {key: -c for key, c in margin.terms.items() if not is_corner(key[0]) and key[0]})
            along = {name: dot(ends(name, end), [own(f"d{axis}") for axis in AXES]) for name in "klm"}
            exact = same_as_one_of(corner, [total(*(scaled(f, along[n]) for n, f in option.items())) for option in options])
            claim.needs(corner, exact, bound, sizes, needed={("R", "|dx,dy,dz|"): Fraction(1)})
    claim.keep(lambda of: ("R" in of) == (part == "radius"))


def located_vector(context, name, kinds):
    return [F(context, {((f"{kind}{name}{axis}",), ()): Fraction(1) for kind in kinds}) for axis in AXES]


def difference_at_place(engine, claim):
    """`M + v L - u K`, `u` and `v` in `[0, 1]`: within `12 u` of the sum of the sizes."""
    context = Context()
    located = Located(engine, said_at(engine))
    vectors = [located_vector(context, name, ("", "r")) for name in "klm"]
    u, v = F.exactly(context, "fu"), F.exactly(context, "fv")
    found = engine.interpreter(context).run(f"{HERE}thick/advance.rs", "difference", vectors, u, v)
    said = engine.said("thick/nearness", r"one of the difference is within `(\d+) u s`")
    sizes = lambda name: {(): Fraction(1)} if name in ("fu", "fv") else located.sizes(name)
    for axis, component in zip(AXES, found):
        exact = polynomial((1, f"m{axis}"), (1, "fv", f"l{axis}"), (-1, "fu", f"k{axis}"))
        bound = F(context, {((f"{name}{axis}",), ()): said * U for name in "KLM"})
        claim.needs(component, exact, bound, sizes)


def velocity_at_place(engine, claim):
    """The same of the changes in a whole step."""
    context = Context()
    interpreter = engine.interpreter(context)
    changes = [interpreter.run(f"{HERE}thick/instant.rs", "change", differences(context, name)) for name in "klm"]
    u, v = F.exactly(context, "fu"), F.exactly(context, "fv")
    found = interpreter.run(f"{HERE}thick/advance.rs", "difference", changes, u, v)
    said = engine.said("thick/refine_toi", r"components of `w` and `w'` are within `(\d+) u s` of the exact ones")
    sizes = lambda name: {(): Fraction(1)} if name in ("fu", "fv") else sizes_of_ends(name)
    for axis, component in zip(AXES, found):
        change = lambda name: polynomial((1, f"{name}1{axis}"), (-1, f"{name}0{axis}"))
        exact = total(change("m"), product(own("fv"), change("l")), scaled(-1, product(own("fu"), change("k"))))
        bound = F(context, {((f"{name}{axis}",), ()): said * U for name in "KLM"})
        claim.needs(component, exact, bound, sizes)


def nearness_sizes(engine, direction):
    """Directions `V`, of size `v`, and the difference `D`, of size `s`, at a time and for a while."""
    near = engine.said("thick/nearness", r"a component of a direction is within `(\d+) u v` of the exact one")
    far = engine.said("thick/nearness", r"one of the difference is within `(\d+) u s`")

    def sizes(name):
        match = re.fullmatch(r"([wr]?)([dm])([xyz])", name)
        if not match:
            return None
        kind, letter, axis = match.groups()
        said, size = (near, direction) if letter == "d" else (far, ["K", "L", "M"])
        factor = {"": 1, "w": 2, "r": said * U}[kind]
        return polynomial(*((factor, *(["W"] if kind == "w" else []), f"{part}{axis}") for part in size))

    return sizes


DIRECTIONS = {"of u": (1, 0, ["K"]), "of v": (0, 1, ["L"]), "of both": (1, -1, ["K", "L"])}


def slope_scope(engine, context, direction, kinds):
    """What `nearness` computes of both directions, which are taken as the same here."""
    u, v, _ = DIRECTIONS[direction]
    interpreter = engine.interpreter(context)
    interpreter.builtins.update({"K::FIRST": 2, "if": lambda *_: False})
    interpreter.methods["abs"] = lambda x: abs(x) if isinstance(x, (int, float)) else x.abs()
    vectors = located_vector(context, "d", kinds)
    directions = [Record("Direction", u=float(u), v=float(v), is_free=False)] * 2
    here = Record("Instant", spot=Record("Spot", directions=directions), difference=located_vector(context, "m", kinds))
    vector = lambda name: [F.exactly(context, f"{name}{axis}").rounded() for axis in AXES]
    edges, add = [vector("K"), vector("L")], lambda x, y: [p + q for p, q in zip(x, y)]
    size = add(add(*edges), vector("M"))
    interpreter.given = {("Instant", "along"): [vectors, vectors], ("Moving", "reaches"): [edges, size]}
    this, width = Record("Moving"), F.exactly(context, "W")
    return interpreter.scope_at(f"{HERE}thick/nearness.rs", "nearness", "first", this, here, width, of="Moving")


def slope_of(engine, claim, direction, underflows=False, part=None):
    """The product of a direction and the difference, against its error."""
    kinds = ("", "w", "r")
    context = Context(underflows=underflows)
    scope = slope_scope(engine, context, direction, kinds)
    slope = scope["first"]
    exact = dot([own(f"d{axis}") for axis in AXES], [own(f"m{axis}") for axis in AXES])
    bound = slope.fields["error"]
    relative = F(context, {key: c for key, c in bound.terms.items() if key[0]})
    if underflows:
        raise Refused("underflow of a slope is a claim of its own")
    claim.needs(slope.fields["value"], exact, relative, nearness_sizes(engine, DIRECTIONS[direction][2]), merge=Located.merge)
    kept(claim, part)


def slope_underflow(engine, claim):
    """Components that are off by so much, times sizes below that of the boxes, against `TINY`."""
    off = engine.said("thick/nearness", r"a component of a direction or of the difference is off by less than `2\^-(\d+)`")
    context = Context(underflows=True)
    component = lambda name: F(context, {((name,), ()): Fraction(1), ((context.underflow(),), ()): Fraction(2) ** (1075 - off)})
    vectors = [[component(f"{name}{axis}") for axis in AXES] for name in "dm"]
    found = engine.interpreter(context).run(f"{HERE}motion.rs", "dot", *vectors)
    largest = engine.constant("thick/mod", "LARGEST")
    # A direction is of two edges of the boxes at most, the difference of three.
    sizes = lambda name: largest * (1 + 8 * U) * (2 if name[0] == "d" else 3)
    claim.underflow(found, sizes, engine.constant("thick/nearness", "TINY"))


def component_underflow(engine, claim):
    """A component of the difference at a place."""
    off = engine.said("thick/nearness", r"a component of a direction or of the difference is off by less than `2\^-(\d+)`")
    context = Context(underflows=True)

    def vector(name):
        return [F(context, {((f"{name}{a}",), ()): Fraction(1), ((context.underflow(),), ()): Fraction(2) * (1 + 4 * U)}) for a in AXES]

    u, v = F.exactly(context, "fu"), F.exactly(context, "fv")
    found = engine.interpreter(context).run(f"{HERE}thick/advance.rs", "difference", [vector(n) for n in "klm"], u, v)
    for part in found:
        claim.underflow(part, lambda name: Fraction(1), Fraction(2) ** -off)


def least_normal(engine, claim, part=None):
    """The cross product of the directions, against what is taken from its length."""
    context = Context()
    interpreter = engine.interpreter(context)
    kinds = ("", "w", "r")
    vectors = [located_vector(context, name, kinds) for name in "kl"]
    sizes_of = [[F.exactly(context, f"{name}{axis}").rounded().rounded() for axis in AXES] for name in "KL"]
    scope = interpreter.scope_at(
        f"{HERE}thick/nearness.rs", "least_normal", "error", vectors, sizes_of, F.exactly(context, "W")
    )
    exact = cross([own(f"k{a}") for a in AXES], [own(f"l{a}") for a in AXES])
    near = engine.said("thick/nearness", r"a component of a direction is within `(\d+) u v` of the exact one")

    def sizes(name):
        match = re.fullmatch(r"([wr]?)([kl])([xyz])", name)
        if not match:
            return None
        kind, letter, axis = match.groups()
        reach = letter.upper() + axis
        return {"": own(reach), "w": polynomial((2, "W", reach)), "r": polynomial((near * U, reach))}[kind]

    for component, polynomial_of in zip(scope["normal"], exact):
        claim.needs(component, polynomial_of, scope["error"], sizes, merge=Located.merge)
    kept(claim, part)


def slope_of_distance(engine, claim):
    """`w . w'` against `slope_error`, with the errors of its parts."""
    context = Context()
    said = engine.said("thick/refine_toi", r"components of `w` and `w'` are within `(\d+) u s` of the exact ones")
    interpreter = engine.interpreter(context)
    parts = {name: [F(context, {((f"{kind}{name}{a}",), ()): Fraction(1) for kind in ("", "r")}) for a in AXES] for name in "wv"}
    found = interpreter.run(f"{HERE}motion.rs", "dot", parts["w"], parts["v"])
    # Sums of three sizes, rounded.
    size = [F.exactly(context, f"s{a}").rounded().rounded() for a in AXES]
    interpreter.given = {("Moving", "reaches"): [None, size]}
    interpreter.builtins["if"] = lambda *_: False
    scope = interpreter.scope_at(
        f"{HERE}thick/refine_toi.rs", "refine_toi", "slope_error", None, Record("Moving"), None, None
    )

    def sizes(name):
        kind, letter, axis = re.fullmatch(r"(r?)([wv])([xyz])", name).groups()
        # The velocity is at most twice the size.
        return polynomial((said * U if kind else (2 if letter == "v" else 1), f"s{axis}"))

    exact = dot([own(f"w{a}") for a in AXES], [own(f"v{a}") for a in AXES])
    claim.needs(found, exact, scope["slope_error"], sizes)


def excess_at_time(engine, claim):
    """The difference of a place at a time in double-double arithmetic."""
    double_sizes(engine)
    said = engine.said("thick/refine_toi", r"the sum `24 h s`: below `(\d+) h s`")
    for of, file in (("EdgeEdge", "edges"), ("VertexFace", "face/mod")):
        tokens = engine.sources.file(f"{HERE}{file}.rs").constants["DIFFERENCES"]
        numbers = [int(text) for kind, text in tokens if kind == "number"]
        pairs = {(a, b): name for name, a, b in zip("klm", numbers[::2], numbers[1::2])}
        context = Context()
        interpreter = engine.interpreter(context)
        letters = {(f"{'abcd'[i]}", f"{'abcd'[j]}"): name for (i, j), name in pairs.items()}

        def difference(to, start):
            lanes = []
            for x, y in zip(start.ends, to.ends):
                (p, _), (q, _) = x.leaf(), y.leaf()
                lanes.append(F.exactly(context, f"{letters[p[0], q[0]]}{p[1:]}"))
            return Double(Pair(*lanes))

        index = [[(numbers[i], numbers[i + 1]) for i in (0, 2, 4)]]
        u, v, t = (F.exactly(context, name) for name in ("fu", "fv", "ft"))
        interpreter.builtins.update({
            "K::DIFFERENCES": [list(pair) for pair in index[0]],
            "two_difference": difference,
            "two_sum": lambda a, b: Double(a),
        })
        scope = interpreter.scope_at(
            f"{HERE}thick/refine_toi.rs", "excess", "xy", Corners(context), None, t, Record("Spot", u=u, v=v), None
        )
        sizes = lambda name: {(): Fraction(1)} if name[0] == "f" else sizes_of_ends(name)
        xy, zz = scope["xy"], scope["zz"]
        for axis, lane in (("x", xy.exact.ends[0]), ("y", xy.exact.ends[1]), ("z", zz.exact.ends[0])):
            at = lambda name: polynomial((1, f"{name}0{axis}"), (1, f"{name}1{axis}", "ft"), (-1, f"{name}0{axis}", "ft"))
            exact = total(at("m"), product(own("fv"), at("l")), scaled(-1, product(own("fu"), at("k"))))
            bound = F(context, {((f"{name}{axis}",), ()): said * H for name in "KLM"})
            claim.needs(lane, exact, bound, sizes)


def change_in_a_step(engine, claim):
    """What `Instant` takes for the change of a vector."""
    context = Context()
    found = engine.interpreter(context).run(f"{HERE}thick/instant.rs", "change", differences(context, "k"))
    said = engine.said("thick/turning", r"A change, of magnitude up to `2 e`, is within `([\d.]+) u e`")
    for axis, component in zip(AXES, found):
        exact = polynomial((1, f"k1{axis}"), (-1, f"k0{axis}"))
        claim.needs(component, exact, F(context, {((f"K{axis}",), ()): said * U}), sizes_of_ends)


def turning(engine, claim, kind, index, part):
    """A coefficient of what a corner has beyond the radius of a plane that turns; `c` are changes, `n` the normal, `d` its turn."""
    of, file = {"edges": ("EdgeEdge", "edges"), "face": ("VertexFace", "face/mod")}[kind]
    said = [
        engine.said("thick/turning", r"a component of a vector at a time is within `([\d.]+) u e`"),
        engine.said("thick/turning", r"A change, of magnitude up to `2 e`, is within `([\d.]+) u e`"),
    ]
    normal, turn = [own(f"n{a}") for a in AXES], [own(f"d{a}") for a in AXES]
    interpreter = engine.interpreter(Context())
    corners = interpreter.constant(f"{HERE}{file}.rs", "CORNERS")
    for u, v in corners:
        context = Context()
        interpreter = engine.interpreter(context)
        vectors = [located_vector(context, name, ("", "r")) for name in "klm"]
        changes = [located_vector(context, f"c{name}", ("", "r")) for name in "klm"]
        boxes = Record("SweptBoxes", extent=[F.exactly(context, f"e{a}").rounded() for a in AXES])
        this = Record("Moving", boxes=boxes, radius=F.exactly(context, "R"))
        leaves = lambda name: [F.exactly(context, f"{name}{a}") for a in AXES]
        scope = interpreter.scope_at(
            f"{HERE}thick/turning.rs",
            "stays_apart_turning",
            "vectors",
            this,
            Record("Instant", at=vectors, change=changes),
            Record("Turning", normal=leaves("n"), turn=leaves("d")),
            None,
            of="Moving",
        )
        corner = interpreter.run(f"{HERE}thick/advance.rs", "difference", scope["vectors"], u, v)
        found = interpreter.run(f"{HERE}motion.rs", "sub", corner, scope["least"])[index]
        at, change = ([total(own(f"{c}m{a}"), scaled(v, own(f"{c}l{a}")), scaled(-u, own(f"{c}k{a}"))) for a in AXES] for c in ("", "c"))
        exact = [dot(at, normal), total(dot(change, normal), dot(at, turn)), dot(change, turn)][index]
        turning_needs(claim, context, index, found, exact, said)
    claim.keep(lambda of: ("R" in of) == (part == "radius"))


def turning_needs(claim, context, index, found, exact, said):
    def sizes(name):
        match = re.fullmatch(r"(r?)(c?)([klm])([xyz])", name)
        if not match:
            return None
        rounds, changes, _, axis = match.groups()
        return polynomial((said[bool(changes)] * U if rounds else 1 + bool(changes), f"e{axis}"))

    part = lambda is_in, sign=1: F(context, {key: sign * c for key, c in found.terms.items() if key[0] and is_in(key[0])})
    of_corner = lambda names: any(re.fullmatch(r"r?c?[klm][xyz]", name) for name in names)
    length, turn_length = "|nx,ny,nz|", "|dx,dy,dz|"
    share = ("1/" + length, "R")
    of_share = lambda names: index == 1 and share[0] in names
    bound = part(lambda names: not of_corner(names) and not of_share(names), -1)
    needed = {}
    if index == 0:
        needed = {("R", length): Fraction(1)}
    if index == 2:
        needed = {tuple(sorted((*share, f"d{a}", f"d{a}"))): Fraction(1, 2) for a in AXES}
    claim.needs(part(of_corner), exact, bound, sizes, needed=needed)
    if index == 1:
        # By Cauchy and Schwarz the products with `R / |n|` add up to at most `R |d|`.
        for a in AXES:
            names = tuple(sorted((*share, f"n{a}", f"d{a}")))
            along = {share[0]: {(): Fraction(1)}, f"n{a}": {(): Fraction(1)}, f"d{a}": own(turn_length)}
            claim.needs(part(lambda key: key == names), {names: Fraction(-1)}, bound, along.get)


# One instant


def instant_difference(engine, claim):
    """Two edges at one instant: a difference of two points, of the extents of the box around all."""
    context = Context()
    edges = Record("Edges", **{name: [F.exactly(context, f"{name}{a}").rounded() for a in AXES] for name in "klm"})
    u, v = F.exactly(context, "fu"), F.exactly(context, "fv")
    found = engine.interpreter(context).run(f"{HERE}discrete.rs", "difference", u, v, of="Edges", this=edges)
    said = engine.said("discrete", r"so it is within `(\d+) u e_i` of that of the exact points")
    sizes = lambda name: {(): Fraction(1)} if name[0] == "f" else own("e" + name[1])
    for axis, component in zip(AXES, found):
        exact = polynomial((1, f"m{axis}"), (1, "fv", f"l{axis}"), (-1, "fu", f"k{axis}"))
        claim.needs(component, exact, F(context, {((f"e{axis}",), ()): said * U}), sizes)


def instant_distance(engine, claim):
    """The least corner along a direction, against its error."""

    def body(context):
        vector = lambda name: [F.exactly(context, f"{name}{a}").rounded() for a in AXES]
        edges = Record("Edges", **{name: vector(name) for name in "klm"}, extent=vector("e"))
        interpreter = engine.interpreter(context)
        interpreter.builtins["length"] = lambda _: F.exactly(context, "length")
        interpreter.builtins["largest"] = lambda _: F.exactly(context, "largest")
        direction = [F.exactly(context, f"d{a}") for a in AXES]

        plain = interpreter.methods["map"]
        # The difference over its size is any direction.
        interpreter.methods["map"] = lambda values, f: direction if values is given else plain(values, f)
        given = [F.exactly(context, f"g{a}") for a in AXES]
        return interpreter.scope_at(f"{HERE}discrete.rs", "distance", "error", edges, given, of="Edges")

    sizes = lambda name: own("e" + name[1]) if name[0] in "klm" else None
    along = {name: dot([own(f"{name}{a}") for a in AXES], [own(f"d{a}") for a in AXES]) for name in "klm"}
    options = [total(*(scaled(f, along[n]) for n, f in option.items())) for option in EDGE_MARGINS]
    for context, scope in runs(body):
        chosen(context, "smaller", "larger")
        error = scope["error"]
        relative = F(context, {key: c for key, c in error.terms.items() if key[0]})
        claim.needs(scope["along"], same_as_one_of(scope["along"], options), relative, sizes)


# The normal: vectors with a bound on the length of their error


def bounded(context, names, error):
    """A vector whose size is the sum of its components' magnitudes, up to a few roundings."""
    value = [F.exactly(context, name) for name in names]
    size = value[0].plus(value[1]).plus(value[2])
    for _ in range(4):
        size = size.rounded()
    return Record("Bounded", value=value, size=size, error=F.exactly(context, error))


XS, YS = [f"x{a}" for a in AXES], [f"y{a}" for a in AXES]


def bounded_operation(engine, claim, name, part):
    """What an operation adds to the errors `a` and `b` of its operands: over all components."""
    context = Context()
    x, y = bounded(context, XS, "a"), bounded(context, YS, "b")
    run = lambda name, *more: engine.interpreter(context).run(f"{HERE}normal/bounded.rs", name, *more, of="Bounded", this=x)
    one_of = Fraction(1)
    if name == "times":
        found = run("times", F.exactly(context, "factor"), F.exactly(context, "inexact"))
        exact = [polynomial((1, "factor", name)) for name in XS]
        needed = {("a", "factor"): one_of, ("a", "inexact"): one_of, **{tuple(sorted(("inexact", n))): one_of for n in XS}}
    elif name == "cross":
        found = run("cross", y)
        exact = cross([own(n) for n in XS], [own(n) for n in YS])
        needed = {("a", "b"): one_of, **{("a", n): one_of for n in YS}, **{("b", n): one_of for n in XS}}
    else:
        found = run(name, y)
        sign = 1 if name == "plus" else -1
        exact = [polynomial((1, p), (sign, q)) for p, q in zip(XS, YS)]
        needed = {("a",): one_of, ("b",): one_of}
    for component, polynomial_of in zip(found.fields["value"], exact):
        claim.needs(component, polynomial_of, found.fields["error"], lambda name: None, needed=needed)
    claim.keep(lambda of: bool({"a", "b", "inexact"} & set(of)) == (part == "errors"))


def bounded_difference(engine, claim, part):
    """From one point to another at the time of impact, which is up to `late` after `toi`."""
    pairs = {(f"q{end}{a}", f"p{end}{a}"): f"{'xy'[end]}{a}" for end in (0, 1) for a in AXES}
    context = Context(differences=pairs)
    point = lambda name, end: [F.exactly(context, f"{name}{end}{a}") for a in AXES]
    start, end_of = ([point("p", end), point("q", end)] for end in (0, 1))
    toi, late = F.exactly(context, "weight"), F.exactly(context, "late")
    step = Record("Step", start=start, end=end_of, toi=toi, late=late)
    found = engine.interpreter(context).run(f"{HERE}normal/bounded.rs", "difference", 0, 1, of="Step", this=step)
    needed = {tuple(sorted(("late", n))): Fraction(1) for n in XS + YS}
    for x, y, component in zip(XS, YS, found.fields["value"]):
        claim.needs(component, polynomial((1, "rest", x), (1, "weight", y)), found.fields["error"], lambda name: None, needed=needed)
    claim.keep(lambda of: ("late" in of) == (part == "errors"))


# Stored positions


def stored(engine, claim, is_finite=True, underflows=False):
    """A coordinate at a step against `rounding`."""
    context = Context(underflows=underflows, differences={("b", "a"): "D"})
    interpreter = engine.interpreter(context)
    # The weights of the other branch are `1 - t` and `t`.
    a, b, t = (F.exactly(context, name) for name in ("a", "b", "ft" if is_finite else "t"))
    interpreter.builtins.update({"if": lambda condition, go: is_finite if "is_finite" in repr(condition) else False})
    scope = interpreter.scope_at(f"{HERE}step.rs", "coordinate", "between", a, b, t)
    interpreter.methods["max"] = lambda x, y: F.exactly(context, "X")
    interpreter.methods["abs"] = lambda x: x
    found = interpreter.scope_at(f"{HERE}step.rs", "rounding", "difference", a, b)
    size, gap = found["size"], found["difference"]
    constant = lambda name: float(interpreter.constant(f"{HERE}step.rs", name))
    bound = stored_bound(engine, interpreter, found)
    value = scope["between"]
    if underflows:
        tiny = engine.constant("step", "UNDERFLOW")
        lost = F(context, {key: c for key, c in bound.terms.items() if any(n[0] == "n" for n in key[0])})
        every = value.plus(lost)
        claim.underflow(every, lambda name: Fraction(1), tiny * (1 - 64 * U))
        return
    relative = F(context, {key: c for key, c in bound.terms.items() if key[0]})
    if is_finite:
        # The sum before it is rounded is between the two: its rounding is of the larger one.
        sizes = lambda name: {"a": own("X"), "ft": {(): Fraction(1)}, "z": {(): Fraction(1)}}.get(name)
        exact = polynomial((1, "a"), (1, "D", "ft"))
        merged = {key: c for key, c in value.terms.items()}
        outer = set.intersection(*(set(es) for _, es in merged))
        (e,) = outer
        inner = F(context, {(names, tuple(x for x in es if x != e)): c for (names, es), c in merged.items()})
        # `(1 + e) (x + err)` with `|x| <= X` is off by `u X + (1 + u) err`.
        err = F(context, {(names, es + (e,) if es else es): c for (names, es), c in inner.terms.items()})
        rounding = F(context, {(("a", "z"), (e,)): Fraction(1), (("a", "z"), ()): Fraction(-1)})
        claim.needs(err.plus(rounding), exact, relative, sizes)
    else:
        sizes = lambda name: own("X") if name in "ab" else None
        exact = polynomial((1, "a", "s"), (1, "b", "t"))
        # Where the difference overflows it is not below the larger magnitude.
        joined = F(context, {(("X",), es): c for (names, es), c in relative.terms.items()})
        claim.needs(value, exact, joined, sizes)


def stored_bound(engine, interpreter, scope):
    """The last expression of `rounding`."""
    function = engine.sources.file(f"{HERE}step.rs").functions[None, "rounding"]
    from rust import Parser

    tokens = function.body
    start = max(i for i, (_, word) in enumerate(tokens) if word == ";")
    tree = Parser(tokens[start + 1 : -1]).expression()
    return interpreter.value(tree, scope, function.file, None)
