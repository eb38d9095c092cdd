"""An exact judge of continuous collision detection that shares no code, language or library with the project.

Its arithmetic, factorisation and interval arithmetic are those of FLINT; what follows is its own.

The differences of a point of one side and a point of the other fill a polygon, whose corners are
linear in the time t. There is contact where the polygon is within the radius R of the origin. The
nearest point of the polygon is a corner, or strictly inside an edge or the polygon. For each of these
the squared distance of the span is a quotient of Gram determinants, p / q, and the foot of the
perpendicular is inside where other polynomials i are at least 0:

    contact(t)  <=>  for a corner, an edge or the polygon  q > 0, all i >= 0, p - R^2 q <= 0

The contact times are a closed set. So the first of them is 0 or a root of one of these polynomials.
The polynomials are factored into irreducible ones, their roots isolated by Sturm's theorem, and the
condition is evaluated at all of them in order. A polynomial is 0 at a root exactly if the irreducible
factor of the root divides it; otherwise balls of growing precision show its sign.
"""

import functools
import itertools
import struct

from flint import arb, ctx, fmpq, fmpq_poly, fmpz_poly

ONE = struct.unpack("<q", struct.pack("<d", 1.0))[0]


def float_of(bits):
    """The f64 at a place in the order of those from 0 on."""
    return struct.unpack("<d", struct.pack("<q", bits))[0]


def rational(number):
    return fmpq(*number.as_integer_ratio())


def sign(number):
    return (number > 0) - (number < 0)


# The question.


def polynomials(query):
    """The conditions of each feature: q, p - R^2 q, and those that are to be at least 0."""
    points = [[rational(float(x)) for x in point] for point in query["points"]]
    radius = query.get("radius", 0.0)
    parts = radius if isinstance(radius, list) else [radius]
    radius = sum((rational(float(part)) for part in parts), fmpq(0))
    # A power of two that makes all of them integers.
    scale = max([x.q for point in points for x in point] + [radius.q])
    a, b, c, d = (
        [fmpz_poly([(x * scale).p, ((y - x) * scale).p]) for x, y in zip(points[i], points[i + 4])]
        for i in range(4)
    )
    square = ((radius * scale) ** 2).p
    minus = lambda x, y: [s - t for s, t in zip(x, y)]
    if query["kind"] == "edge-edge":
        corners = [minus(c, a), minus(d, a), minus(d, b), minus(c, b)]
    else:
        corners = [minus(b, a), minus(c, a), minus(d, a)]
    yield from (of_corner(corner, square) for corner in corners)
    yield from (of_edge(x, y, square) for x, y in zip(corners, corners[1:] + corners[:1]))
    yield of_polygon(corners[0], corners[1], corners[-1], len(corners) == 4, square)


def dot(x, y):
    return sum((s * t for s, t in zip(x, y)), fmpz_poly())


def of_corner(x, square):
    return fmpz_poly([1]), dot(x, x) - square, []


def of_edge(x, y, square):
    e = [t - s for s, t in zip(x, y)]
    q, along = dot(e, e), -dot(x, e)
    return q, dot(x, x) * q - along * along - square * q, [along, q - along]


def of_polygon(x, y, z, is_parallelogram, square):
    e, f = [t - s for s, t in zip(x, y)], [t - s for s, t in zip(x, z)]
    ee, ef, ff, xe, xf, xx = dot(e, e), dot(e, f), dot(f, f), dot(x, e), dot(x, f), dot(x, x)
    q = ee * ff - ef * ef
    u, v = ef * xf - ff * xe, ef * xe - ee * xf
    # Of x + (u e + v f) / q, the foot of the perpendicular.
    p = xx * q + u * xe + v * xf
    return q, p - square * q, [u, v, q - u, q - v] if is_parallelogram else [u, v, q - u - v]


# Roots.


class Root:
    """A root of an irreducible polynomial: equal to low and high, or the only one between them."""

    def __init__(self, factor, low, high):
        self.factor, self.low, self.high = factor, low, high
        self.sign_below = sign(factor(low))
        self.power = 1

    def narrow(self):
        """Where the chord is 0, and a check: the number of parts that it is right for is squared each time (Abbott 2006)."""
        low, parts = self.low, 1 << self.power
        width = (self.high - low) / parts
        if width == 0:
            return
        chord = self.factor(low) / (self.factor(low) - self.factor(self.high)) * parts
        part = min(chord.p // chord.q, parts - 1)
        self.to(low + part * width)
        self.to(low + (part + 1) * width)
        self.power = min(2 * self.power, 512) if self.high - self.low <= width else max(self.power // 2, 1)

    def to(self, number):
        """Takes a number into account that is no root unless the factor is linear."""
        if self.low < number < self.high:
            if sign(self.factor(number)) == self.sign_below:
                self.low = number
            else:
                self.high = number

    def sign_of(self, polynomial):
        """The sign of a polynomial there."""
        if self.low == self.high:
            return sign(polynomial(self.low))
        precision = 64
        while True:
            ctx.prec = precision
            value = polynomial(arb(self.low).union(arb(self.high)))
            if value > 0 or value < 0:
                return 1 if value > 0 else -1
            if precision == 256 and fmpq_poly(polynomial) % fmpq_poly(self.factor) == 0:
                return 0
            while (self.high - self.low) * (1 << precision) > self.high:
                self.narrow()
            precision *= 2

    def enclosure(self):
        """The largest f64 that is not above it, and the smallest that is not below it."""
        below, above = 0, ONE
        while above - below > 1:
            middle = (below + above) // 2
            number = rational(float_of(middle))
            self.to(number)
            if number == self.low == self.high:
                return float_of(middle), float_of(middle)
            if number <= self.low:
                below = middle
            else:
                above = middle
        for end in (below, above):
            if rational(float_of(end)) == self.low == self.high:
                return float_of(end), float_of(end)
        return float_of(below), float_of(above)


def order(root, other):
    """Which of two different roots is smaller."""
    while True:
        if root.high <= other.low:
            return -1
        if other.high <= root.low:
            return 1
        max(root, other, key=lambda root: root.high - root.low).narrow()


def variations(chain, number):
    signs = [s for s in (sign(p(number)) for p in chain) if s]
    return sum(s != t for s, t in zip(signs, signs[1:]))


def roots_of(factor):
    """Those from 0 to 1 of an irreducible polynomial."""
    if factor.degree() == 1:
        root = fmpq(-factor[0], factor[1])
        return [Root(factor, root, root)] if 0 <= root <= 1 else []
    chain = [factor, factor.derivative()]
    while chain[-1].degree() > 0:
        rest = -(fmpq_poly(chain[-2]) % fmpq_poly(chain[-1])).numer()
        chain.append(rest / abs(rest.content()))
    return list(isolated(factor, chain))


def isolated(factor, chain):
    """No end of an interval is a root: an irreducible polynomial that is not linear has no rational one."""
    start, end = ((bits, rational(float_of(bits))) for bits in (0, ONE))
    stack = [(start, variations(chain, start[1]), end, variations(chain, end[1]))]
    while stack:
        start, before, end, after = stack.pop()
        (below, low), (above, high) = start, end
        if before - after == 1:
            yield Root(factor, low, high)
        elif before - after > 1:
            # Halves of the f64s first, which finds tiny roots in few steps.
            is_wide = above - below > 1
            number = rational(float_of((below + above) // 2)) if is_wide else (low + high) / 2
            variation = variations(chain, number)
            # Between neighbouring f64s places stay neighbours.
            bits = (below + above) // 2
            stack.append((start, before, (bits if is_wide else above, number), variation))
            stack.append(((bits if is_wide else below, number), variation, end, after))


# The answer.


def time_of_impact(query):
    """Of the first contact: the neighbouring f64s around it; None if there is none."""
    features = list(polynomials(query))
    start = Root(fmpz_poly([0, 1]), fmpq(0), fmpq(0))
    factors = {}
    for q, p, inside in features:
        for polynomial in [q, p, *inside]:
            if polynomial.degree() > 0:
                factors.update((str(factor), factor) for factor, _ in polynomial.factor()[1])
    roots = itertools.chain.from_iterable(map(roots_of, factors.values()))
    roots = [root for root in roots if root.high > 0]
    for root in [start, *sorted(roots, key=functools.cmp_to_key(order))]:
        for q, p, inside in features:
            if (
                root.sign_of(q) > 0
                and root.sign_of(p) <= 0
                and all(root.sign_of(polynomial) >= 0 for polynomial in inside)
            ):
                return root.enclosure()
    return None
