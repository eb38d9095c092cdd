"""The bounds: which functions of the sources are run on what, and what has to come out."""

import operator
import re
import struct
from fractions import Fraction
from functools import reduce

from prove import Refused, product, scaled, total
from rounded import Context, Double, F, Pair
from rust import Interpreter, Sources

HERE = "src/certified/"
AXES = "xyz"


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
        "Slope": ["thick/nearness"],
        "Step": ["normal/bounded"],
        "Bounded": ["normal/bounded"],
    }

    def __init__(self, root, texts=None):
        self.sources = Sources(root, texts)
        self.types = {name: [f"{HERE}{file}.rs" for file in files] for name, files in self.TYPES.items()}

    def interpreter(self, context, **more):
        exactly = lambda x: Double(x)
        builtins = {
            "if": lambda *_: context.choose([True, False]),
            "f64::abs": abs,
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
            "abs": abs,
            "map": lambda values, f: [f(x) for x in values],
            "each_ref": lambda values: values,
            "iter": lambda values: values,
            "then_some": lambda _, value: value,
            "sum": lambda value: value.sum() if isinstance(value, Pair) else summed(value),
        }
        return Interpreter(self.sources, builtins, methods, self.types)

    def constant(self, file, name, function=None):
        return Fraction(self.interpreter(Context()).constant(f"{HERE}{file}.rs", name, function))

    def largest(self):
        """What the factors of a cubic are below."""
        return self.constant("cubic", "LARGEST")

    def said(self, file, pattern):
        """A number that a comment states."""
        text = re.sub(r"\s*\n\s*///?\s*", " ", self.sources.file(f"{HERE}{file}.rs").text)
        found = set(re.findall(pattern, text))
        if len(found) != 1:
            raise Refused(f"{file}.rs says {pattern} as {sorted(found)}")
        return Fraction(found.pop())


def from_bits(bits):
    return struct.unpack("<d", struct.pack("<Q", int(bits)))[0]


def summed(values, plus=operator.add):
    return reduce(plus, values)


def differences(context, name):
    """A rounded difference at both ends of the step, on each axis."""
    return [Pair(*(F.exactly(context, f"{name}{end}{axis}").rounded() for end in "01")) for axis in AXES]


def limit(context, factor, names):
    """So many times the sum of some sizes."""
    return summed([F.size(context, name, factor=factor) for name in names], F.plus)


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
