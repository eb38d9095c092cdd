"""Claims about one instant, normals and stored positions."""

from fractions import Fraction

from engine import AXES, HERE, cross, dot, limit, own
from filters import EDGE_MARGINS, chosen, lost, same_as_one_of
from prove import Refused, magnitudes, polynomial, scaled, total
from rounded import Context, F, U, runs
from rust import Record

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
        claim.needs(component, exact, F.size(context, f"e{axis}", factor=said * U), sizes)


def instant_distance(engine, claim, underflows=False):
    """The least corner along a direction, against its error."""

    def body(context):
        vector = lambda name: [F.exactly(context, f"{name}{a}").rounded() for a in AXES]
        edges = Record("Edges", **{name: vector(name) for name in "klm"}, extent=list(map(abs, vector("e"))))
        interpreter = engine.interpreter(context)
        interpreter.builtins["length"] = lambda _: F.size(context, "length")
        interpreter.builtins["largest"] = lambda _: F.size(context, "largest")
        direction = [F.exactly(context, f"d{a}") for a in AXES]

        plain = interpreter.methods["map"]
        # The difference over its size is any direction.
        interpreter.methods["map"] = lambda values, f: direction if values is given else plain(values, f)
        given = [F.exactly(context, f"g{a}") for a in AXES]
        return interpreter.scope_at(f"{HERE}discrete.rs", "distance", "error", edges, given, of="Edges")

    sizes = lambda name: own("e" + name[1]) if name[0] in "klm" else None
    along = {name: dot([own(f"{name}{a}") for a in AXES], [own(f"d{a}") for a in AXES]) for name in "klm"}
    options = [total(*(scaled(f, along[n]) for n, f in option.items())) for option in EDGE_MARGINS]
    for context, scope in runs(body, underflows=underflows):
        chosen(context, "smaller", "larger")
        error = scope["error"]
        if underflows:
            taken, tiny = lost(error)
            claim.underflow(scope["along"].plus(taken), lambda name: Fraction(1), tiny)
            continue
        relative = F(context, {key: c for key, c in error.terms.items() if key[0]})
        claim.needs(scope["along"], same_as_one_of(scope["along"], options), relative, sizes)


# The normal: vectors with a bound on the length of their error


def bounded(context, names, error):
    """A vector whose size is the sum of its components' magnitudes, up to a few roundings."""
    value = [F.exactly(context, name) for name in names]
    size = limit(context, 1, names)
    for _ in range(4):
        size = size.rounded()
    return Record("Bounded", value=value, size=size, error=F.size(context, error))


XS, YS = [f"x{a}" for a in AXES], [f"y{a}" for a in AXES]


def bounded_operation(engine, claim, name, part):
    """What an operation adds to the errors `a` and `b` of its operands: over all components."""
    context = Context()
    x, y = bounded(context, XS, "a"), bounded(context, YS, "b")
    run = lambda name, *more: engine.interpreter(context).run(f"{HERE}normal/bounded.rs", name, *more, of="Bounded", this=x)
    one_of = Fraction(1)
    if name == "times":
        found = run("times", F.size(context, "factor"), F.size(context, "inexact"))
        exact = [polynomial((1, "|factor|", name)) for name in XS]
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
    toi, late = F.size(context, "weight"), F.size(context, "late")
    step = Record("Step", start=start, end=end_of, toi=toi, late=late)
    found = engine.interpreter(context).run(f"{HERE}normal/bounded.rs", "difference", 0, 1, of="Step", this=step)
    needed = {tuple(sorted(("late", n))): Fraction(1) for n in XS + YS}
    for x, y, component in zip(XS, YS, found.fields["value"]):
        claim.needs(component, polynomial((1, "|rest|", x), (1, "|weight|", y)), found.fields["error"], lambda name: None, needed=needed)
    claim.keep(lambda of: ("late" in of) == (part == "errors"))


# Stored positions


def stored(engine, claim, is_finite=True, underflows=False):
    """A coordinate at a step against `rounding`."""
    context = Context(underflows=underflows, differences={("b", "a"): "D"})
    interpreter = engine.interpreter(context)
    # The weights of the other branch are `1 - t` and `t`.
    a, b, t = (F.exactly(context, name) for name in ("a", "b", "ft" if is_finite else "t"))
    interpreter.builtins.update({"if": lambda condition, *_: is_finite if "is_finite" in repr(condition) else False})
    scope = interpreter.scope_at(f"{HERE}step.rs", "coordinate", "between", a, b, t)
    interpreter.methods["max"] = larger_magnitude
    found = interpreter.scope_at(f"{HERE}step.rs", "rounding", "error", a, b)
    bound = stored_bound(engine, found)
    value = scope["between"]
    if underflows:
        tiny = engine.constant("step", "UNDERFLOW", "rounding")
        lost = F(context, {key: c for key, c in bound.terms.items() if any(n[0] == "n" for n in key[0])})
        every = value.plus(lost)
        claim.underflow(every, lambda name: Fraction(1), tiny * (1 - 64 * U))
        return
    relative = F(context, {key: c for key, c in bound.terms.items() if key[0]})
    if is_finite:
        # The sum before it is rounded is between the two: its rounding is of the larger one.
        sizes = lambda name: {"a": own("X"), "ft": {(): Fraction(1)}, "z": {(): Fraction(1)}}.get(name)
        exact = polynomial((1, "a"), (1, "D", "ft"))
        (e,) = set.intersection(*(set(es) for _, es in value.terms))
        # `(1 + e) (x + err)` with `|x| <= X` is off by `u X + (1 + u) err`: what is `a` alone has no error of its own.
        err = F(context, {(names, () if es == (e,) else es): c for (names, es), c in value.terms.items()})
        rounding = F(context, {(("a", "z"), (e,)): Fraction(1), (("a", "z"), ()): Fraction(-1)})
        claim.needs(err.plus(rounding), exact, relative, sizes)
    else:
        sizes = lambda name: own("X") if name in "ab" else None
        exact = polynomial((1, "a", "s"), (1, "b", "t"))
        # Where the difference overflows it is not below the larger magnitude.
        joined = F(context, {(("|X|",) if magnitudes(names) else (), es): c for (names, es), c in relative.terms.items()})
        claim.needs(value, exact, joined, sizes)


def larger_magnitude(x, y):
    if {x.leaf(), y.leaf()} != {("|a|", 1), ("|b|", 1)}:
        raise Refused("another one than the larger magnitude")
    return F.size(x.context, "X")


def stored_bound(engine, scope):
    """What `rounding` says of a coordinate that moves."""
    function = engine.sources.file(f"{HERE}step.rs").functions[None, "rounding"]
    start = max(i for i, token in enumerate(function.body) if token.text == ";")
    said = " ".join(token.text for token in function.body[start + 1 : -1])
    if said != "if start == end { 0.0 } else { error }":
        raise Refused(f"`rounding` says `{said}`")
    return scope["error"]
