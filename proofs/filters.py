"""Claims about separating directions and about the cubic."""

import re
from fractions import Fraction

from engine import AXES, HERE, cross, differences, dot, ends, own, reach_name, sizes_of_ends
from prove import Refused, polynomial, scaled, text_of, total
from rounded import Context, F, U, decisions, runs, underflowed
from rust import Record

# Separation


def lost(bound):
    """What underflow takes from a computed bound, and what the bound has that is of no size."""
    of = lambda is_in: F(bound.context, {key: c for key, c in bound.terms.items() if is_in(key[0])})
    constant = sum(of(lambda names: not names).terms.values(), Fraction(0))
    return of(underflowed), constant * (1 - 64 * U)


def separated(engine, claim, file, of, options, kinds, underflows=False):
    """A direction separates: the margin against the error bound of the boxes."""

    def body(context):
        interpreter = engine.interpreter(context)
        motion = Record("Motion", **{name: differences(context, name) for name in "klm"})
        extent = [F.size(context, f"e{axis}").rounded() for axis in AXES]
        boxes = Record("SweptBoxes", extent=extent)
        d = [F.exactly(context, f"d{axis}") for axis in AXES]
        if of:
            return interpreter.run(f"{HERE}{file}.rs", "is_separated_by", d, boxes, of=of, this=motion)
        return interpreter.run(f"{HERE}{file}.rs", "is_separated_by", motion, d, boxes)

    largest = engine.constant("separate", "LARGEST")
    for context, is_separated in decisions(body, 3):
        all_hold(context, is_separated)
        (_, bound), (_, same), (border, below) = context.compared
        if border.terms != {((), ()): largest} or not bound.terms == same.terms == below.terms:
            raise Refused("another border")
    sizes = lambda name: own("e" + name[2]) if re.fullmatch(r"[klm][01][xyz]", name) else None
    for context, _ in runs(body, underflows=underflows):
        chosen(context, *kinds)
        for end, (margin, bound) in enumerate(context.compared[:2]):
            if underflows:
                taken, tiny = lost(bound)
                claim.underflow(margin.plus(taken), lambda name: Fraction(1), tiny)
                continue
            along = {name: dot(ends(name, end), [own(f"d{axis}") for axis in AXES]) for name in "klm"}
            exact = same_as_one_of(margin, [total(*(scaled(f, along[n]) for n, f in option.items())) for option in options])
            claim.needs(margin, exact, bound, sizes)


def all_hold(context, result):
    """That a decision is that all comparisons hold."""
    if result is not all(context.truths):
        raise Refused("a decision that is not that all comparisons hold")


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
    claim.underflow(cubic.fields["bernstein"][index], lambda name: engine.largest(), limit)


def coefficients(context):
    return [F.exactly(context, f"b{i}") for i in range(4)]


def cubic_of(engine, context):
    """A cubic with coefficients of which only their error is known."""
    error = F.size(context, "error")
    return Record("Cubic", bernstein=coefficients(context), error=error, permanent=F.size(context, "P"))


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
        bound = F(context, {key: c for key, c in found.terms.items() if "|error|" in key[0]})
        computed = F(context, {key: c for key, c in found.terms.items() if "|error|" not in key[0]}).opened()
        exact = same_as_one_of(computed, ends_of)
        claim.needs(computed, exact, bound, by_error(engine), needed={("error",): Fraction(24)})


def side(engine, claim):
    """The side of a contact: the value's error, and how much it changes over `2 u`."""

    def body(context):
        interpreter = engine.interpreter(context, **{"if": lambda condition, go, _: go(condition)})
        return interpreter.run(f"{HERE}thick/contact.rs", "side", cubic_of(engine, context), F.exactly(context, "t"))

    for truths, sign in ((True, False), 1), ((False, True), -1), ((False, False), 0):
        context = Context(truths=truths)
        if body(context) != sign:
            raise Refused("another sign")
    (found, bound), (minus, same) = context.compared
    if minus.terms != (-bound).terms or same.terms != found.terms:
        raise Refused("another bound below 0")
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
    limit = F.size(context, "B", factor=level * U)
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
    claim.at_most(text_of(start + depth * each), " * ".join([text_of(factor)] + [f"(1 + {e})" for e in es]), context.sizes)
