"""Claims about the stages with a radius."""

import re
from fractions import Fraction

from doubled import double_sizes
from doubled import points as corners
from engine import AXES, HERE, cross, differences, dot, ends, limit, own, sizes_of_ends, summed
from filters import all_hold, chosen, same_as_one_of
from places import Located, kept, said_at, sizes_at_time
from prove import Refused, polynomial, product, scaled, total
from rounded import Context, Double, F, H, Pair, U, decisions, runs
from rust import Record

# With a radius


LEAST_CORNERS = {
    "edges": ("EdgeEdge", "edges", ("smaller", "larger"), [{"m": 1, **l, **k} for l in ({}, {"l": 1}) for k in ({}, {"k": -1})]),
    "face": ("VertexFace", "face/mod", ("smaller", "smaller"), [{"m": 1}, {"m": 1, "l": 1}, {"m": 1, "k": -1}]),
}


def is_proof(context):
    """Of an `if`: where one of what it compares is not so, there is no bound."""

    def proof(condition, go, otherwise):
        all_hold(context, go(condition))
        if go(otherwise) != float("inf"):
            raise Refused("a bound that is no proof")
        return True

    return proof


def needs_both_margins(engine):
    """A plane separates for the whole step if both margins are above 0."""

    def body(context):
        interpreter, margins = engine.interpreter(context), [F.exactly(context, name) for name in ("start", "end")]
        interpreter.given["Moving", "margins"] = margins
        is_separated = interpreter.run(f"{HERE}thick/advance.rs", "is_separated_by", None, of="Moving", this=Record("Moving"))
        return margins, is_separated

    for context, (margins, is_separated) in decisions(body, 2):
        all_hold(context, is_separated)
        if [(x.terms, y.terms) for x, y in context.compared] != [(margin.terms, {}) for margin in margins]:
            raise Refused("a margin that is not compared with 0")


def thick_margin(engine, claim, kind, part):
    """A plane keeps the two more than the radius apart: all that is taken from the least corner."""
    of, file, kinds, options = LEAST_CORNERS[kind]

    def body(context):
        interpreter = engine.interpreter(context)
        interpreter.builtins["if"] = is_proof(context)
        interpreter.builtins["K::least_corner"] = lambda *x: interpreter.apply(
            engine.sources.file(f"{HERE}{file}.rs").functions[of, "least_corner"], list(x)
        )
        motion = Record("Motion", **{name: differences(context, name) for name in "klm"})
        boxes = Record("SweptBoxes", extent=[F.size(context, f"e{axis}").rounded() for axis in AXES])
        this = Record("Moving", motion=motion, boxes=boxes, radius=F.size(context, "R"))
        return interpreter.run(f"{HERE}thick/advance.rs", "margins", [F.exactly(context, f"d{axis}") for axis in AXES], of="Moving", this=this)

    borders = [engine.constant("thick/advance", name) for name in ("SMALLEST", "LARGEST")]
    sizes = lambda name: own("e" + name[2]) if re.fullmatch(r"[klm][01][xyz]", name) else None
    needs_both_margins(engine)
    # It looks at what the `if` is of.
    list(decisions(body, 3))
    for context, found in runs(body):
        chosen(context, *kinds)
        above, below, finite = context.compared
        if above[1].terms != {((), ()): borders[0]} or any(x.terms != {((), ()): borders[1]} for x in (below[0], finite[0])):
            raise Refused("other borders")
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
        bound = limit(context, said * U, [f"{name}{axis}" for name in "KLM"])
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
        bound = limit(context, said * U, [f"{name}{axis}" for name in "KLM"])
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


def slope_along(engine, context, direction, kinds):
    """What is computed of a direction."""
    u, v, _ = DIRECTIONS[direction]
    interpreter = engine.interpreter(context)
    interpreter.builtins.update({"K::FIRST": 2, "if": lambda *_: False})
    vectors = located_vector(context, "d", kinds)
    of = Record("Direction", u=float(u), v=float(v), is_free=False)
    here = Record("Instant", difference=located_vector(context, "m", kinds))
    vector = lambda name: [F.size(context, f"{name}{axis}").rounded() for axis in AXES]
    edges, add = [vector("K"), vector("L")], lambda x, y: [p + q for p, q in zip(x, y)]
    size = add(add(*edges), vector("M"))
    most = interpreter.run(f"{HERE}thick/nearness.rs", "reach", *edges, of="Direction", this=of)
    return interpreter.run(f"{HERE}thick/nearness.rs", "new", vectors, most, here, size, F.size(context, "W"), of="Slope")


def slope_of(engine, claim, direction, part):
    """The product of a direction and the difference, against its error."""
    context = Context()
    slope = slope_along(engine, context, direction, ("", "w", "r"))
    exact = dot([own(f"d{axis}") for axis in AXES], [own(f"m{axis}") for axis in AXES])
    bound = slope.fields["error"]
    relative = F(context, {key: c for key, c in bound.terms.items() if key[0]})
    claim.needs(slope.fields["value"], exact, relative, nearness_sizes(engine, DIRECTIONS[direction][2]), merge=Located.merge)
    kept(claim, part)


def slope_size(engine, claim):
    """The size of a slope and its error, up to a rounding: what it is used for outweighs some."""
    context = Context()
    slope = Record("Slope", value=F.exactly(context, "d"), error=F.size(context, "error"))
    found = engine.interpreter(context).run(f"{HERE}thick/nearness.rs", "size", of="Slope", this=slope)
    near = 1 - 2 * U
    claim.needs(F.exactly(context, "d", factor=near), {}, found, lambda name: None, needed={("error",): near})


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
    sizes_of = [[F.size(context, f"{name}{axis}").rounded().rounded() for axis in AXES] for name in "KL"]
    scope = interpreter.scope_at(
        f"{HERE}thick/nearness.rs", "least_normal", "error", vectors, sizes_of, F.size(context, "W")
    )
    exact = cross([own(f"k{a}") for a in AXES], [own(f"l{a}") for a in AXES])
    near = engine.said("thick/nearness", r"a component of a direction is within `(\d+) u v` of the exact one")
    sizes = lambda name: sizes_at_time(name, near * U)
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
    size = [F.size(context, f"s{a}").rounded().rounded() for a in AXES]
    square = interpreter.run(f"{HERE}motion.rs", "dot", size, size)
    slope_error = interpreter.run(f"{HERE}thick/refine_toi.rs", "slope_error", square)

    def sizes(name):
        kind, letter, axis = re.fullmatch(r"(r?)([wv])([xyz])", name).groups()
        # The velocity is at most twice the size.
        return polynomial((said * U if kind else (2 if letter == "v" else 1), f"s{axis}"))

    exact = dot([own(f"w{a}") for a in AXES], [own(f"v{a}") for a in AXES])
    claim.needs(found, exact, slope_error, sizes)


def exact_differences(engine, context, file):
    """What a kind's differences are, and `two_difference` of two corners: without error, by its name."""
    tokens = engine.sources.file(f"{HERE}{file}.rs").constants["DIFFERENCES"]
    numbers = [int(token.text) for token in tokens if token.kind == "number"]
    pairs = dict(zip(zip(numbers[::2], numbers[1::2]), "klm"))

    def difference(to, start):
        lanes = []
        for x, y in zip(start.ends, to.ends):
            (p, _), (q, _) = x.leaf(), y.leaf()
            lanes.append(F.exactly(context, f"{pairs['abcd'.index(p[0]), 'abcd'.index(q[0])]}{p[1:]}"))
        return Double(Pair(*lanes))

    return {"K::DIFFERENCES": [list(pair) for pair in pairs], "two_difference": difference}


def excess_at_time(engine, claim):
    """The difference of a place at a time in double-double arithmetic."""
    double_sizes(engine)
    said = engine.said("thick/doubled", r"the sum `24 h s`: below `(\d+) h s`")
    for file in ("edges", "face/mod"):
        context = Context()
        interpreter = engine.interpreter(context)
        interpreter.builtins.update(exact_differences(engine, context, file))
        u, v, t = (F.exactly(context, name) for name in ("fu", "fv", "ft"))
        xy, zz = interpreter.run(f"{HERE}thick/doubled.rs", "difference_at", corners(context), t, Record("Spot", u=u, v=v))
        sizes = lambda name: {(): Fraction(1)} if name[0] == "f" else sizes_of_ends(name)
        for axis, lane in (("x", xy.exact.ends[0]), ("y", xy.exact.ends[1]), ("z", zz.exact.ends[0])):
            at = lambda name: polynomial((1, f"{name}0{axis}"), (1, f"{name}1{axis}", "ft"), (-1, f"{name}0{axis}", "ft"))
            exact = total(at("m"), product(own("fv"), at("l")), scaled(-1, product(own("fu"), at("k"))))
            bound = limit(context, said * H, [f"{name}{axis}" for name in "KLM"])
            claim.needs(lane, exact, bound, sizes)


def with_error(context, name):
    """An exact number and what it is off by, `r`."""
    return F(context, {((f"{kind}{name}",), ()): Fraction(1) for kind in ("", "r")})


def doubled_edges(engine, context):
    """`K` and `L` at a time in double-double arithmetic, `D` the difference at a place; and their sizes."""
    double_sizes(engine)
    errors = {
        "k": engine.said("refine", r"the sum within `24 h k` more \(bounds at the operations\): `([\d.]+) h k`"),
        "d": engine.said("thick/doubled", r"the sum `24 h s`: below `(\d+) h s`"),
    }
    errors["l"] = errors["k"]
    edges = [Double(Pair(with_error(context, f"k{a}"), with_error(context, f"l{a}"))) for a in AXES]

    def sizes(name):
        kind, letter, axis = re.fullmatch(r"(r?)([kld])([xyz])", name).groups()
        return polynomial((errors[letter] * H if kind else 1, f"{letter.upper()}{axis}"))

    return edges, sizes


def sum_of_products(context, factor, *names):
    """So many times the sum over the axes of some products of sizes."""
    sizes = [F.size(context, *(f"{name}{a}" for name, a in zip(pair, axes)), factor=factor) for pair, axes in names]
    return summed(sizes, F.plus)


def doubled_slopes(engine, claim):
    """The products of the difference at a place with `K` and `L`."""
    context = Context()
    edges, sizes = doubled_edges(engine, context)
    interpreter = engine.interpreter(context)
    x, y, z = (with_error(context, f"d{a}") for a in AXES)
    interpreter.builtins["difference_at"] = lambda *_: [Double(Pair(x, y)), Double(Pair(z, z))]
    found = interpreter.run(f"{HERE}thick/doubled.rs", "slopes_at", None, edges, None, Record("Instant", spot=None))
    error = engine.constant("thick/doubled", "SLOPE_ERROR")
    for name, slope in zip("kl", found):
        exact = dot([own(f"{name}{a}") for a in AXES], [own(f"d{a}") for a in AXES])
        bound = sum_of_products(context, error, *(((name.upper(), "D"), (a, a)) for a in AXES))
        claim.needs(slope, exact, bound, sizes)


def doubled_normal(engine, claim):
    """`K x L` at a time in double-double arithmetic."""
    context = Context()
    edges, sizes = doubled_edges(engine, context)
    found = engine.interpreter(context).run(f"{HERE}thick/doubled.rs", "normal_of", edges)
    error = engine.constant("thick/doubled", "MINOR_ERROR")
    exact = cross([own(f"k{a}") for a in AXES], [own(f"l{a}") for a in AXES])
    for i, component in enumerate(found):
        first, second = AXES[(i + 1) % 3], AXES[(i + 2) % 3]
        bound = sum_of_products(context, error, (("K", "L"), (first, second)), (("K", "L"), (second, first)))
        claim.needs(component, exact[i], bound, sizes)


def sharp_corner(engine, claim, kind):
    """A corner's product with a normal, both in double-double arithmetic, at both ends of the step."""
    double_sizes(engine)
    _, file, _, _ = LEAST_CORNERS[kind]
    said = engine.said("thick/sharp_plane", r"its product is within `(\d+) h S`")
    for u, v in engine.interpreter(Context()).constant(f"{HERE}{file}.rs", "CORNERS"):
        context = Context()
        interpreter = engine.interpreter(context)

        def is_above(condition, go, _):
            kind, operator, x, y = condition
            if (kind, operator) != ("binary", ">"):
                raise Refused(f"a condition of another kind: {condition}")
            return go(x) > go(y)

        interpreter.builtins.update(exact_differences(engine, context, file) | {"if": is_above})
        normal = [Double(Pair(F.exactly(context, f"n{a}"), F.exactly(context, f"n{a}"))) for a in AXES]
        products = interpreter.run(f"{HERE}thick/sharp_plane.rs", "products", corners(context), normal)
        found = interpreter.run(f"{HERE}thick/sharp_plane.rs", "corner", products, u, v)
        sizes = lambda name: own(f"N{name[1]}") if name[0] == "n" else sizes_of_ends(name)
        for end, lane in enumerate(found.exact.ends):
            at = {name: dot(ends(name, end), [own(f"n{a}") for a in AXES]) for name in "klm"}
            exact = total(at["m"], scaled(v, at["l"]), scaled(-u, at["k"]))
            bound = sum_of_products(context, said * H, *(((name, "N"), (a, a)) for name in "KLM" for a in AXES))
            claim.needs(lane, exact, bound, sizes)


def change_in_a_step(engine, claim):
    """What `Instant` takes for the change of a vector."""
    context = Context()
    found = engine.interpreter(context).run(f"{HERE}thick/instant.rs", "change", differences(context, "k"))
    said = engine.said("thick/turning", r"A change, of magnitude up to `2 e`, is within `([\d.]+) u e`")
    for axis, component in zip(AXES, found):
        exact = polynomial((1, f"k1{axis}"), (-1, f"k0{axis}"))
        claim.needs(component, exact, F.size(context, f"K{axis}", factor=said * U), sizes_of_ends)


def turning(engine, claim, kind, index, part):
    """A coefficient of what a corner has beyond the radius of a plane that turns; `c` are changes, `n` the normal, `d` its turn."""
    _, file, _, _ = LEAST_CORNERS[kind]
    said = [
        engine.said("thick/turning", r"a component of a vector at a time is within `([\d.]+) u e`"),
        engine.said("thick/turning", r"A change, of magnitude up to `2 e`, is within `([\d.]+) u e`"),
    ]
    normal, turn = ([own(f"{name}{a}") for a in AXES] for name in "nd")
    corners = engine.interpreter(Context()).constant(f"{HERE}{file}.rs", "CORNERS")
    for u, v in corners:
        context = Context()
        interpreter = engine.interpreter(context)
        vectors = [located_vector(context, name, ("", "r")) for name in "klm"]
        changes = [located_vector(context, f"c{name}", ("", "r")) for name in "klm"]
        boxes = Record("SweptBoxes", extent=[F.size(context, f"e{a}").rounded() for a in AXES])
        this = Record("Moving", boxes=boxes, radius=F.size(context, "R"))
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
    share = ("1/" + length, "|R|")
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
