"""Times of impact of the newer public benchmark, compared with ours.

Sample-Scalable-CCD-Data states them as exact expressions in Mathematica's WXF, a file for each query, in SCENE/roots. Here they
are evaluated by FLINT in balls, and have to be between the two neighbouring floats that the oracle states.

    python3 roots.py PROGRAM SCENE...
"""

import json
import subprocess
import sys
import tarfile
from pathlib import Path

from flint import arb, ctx, fmpq, fmpz_poly

ctx.prec = 600

# Functions of numbers, each of one or more arguments.
OPERATIONS = {
    "Times": lambda a, b: a * b,
    "Plus": lambda a, b: a + b,
}


def varint(data, at):
    number = shift = 0
    while True:
        byte = data[at]
        at += 1
        number |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return number, at


def read(data, at):
    """The expression that starts at a byte, and where it ends. A function is its head and its arguments."""
    token, at = chr(data[at]), at + 1
    if token in "CjiL":
        size = {"C": 1, "j": 2, "i": 4, "L": 8}[token]
        return int.from_bytes(data[at : at + size], "little", signed=True), at + size
    length, at = varint(data, at)
    if token == "f":
        head, at = read(data, at)
        arguments = []
        for _ in range(length):
            argument, at = read(data, at)
            arguments.append(argument)
        return (head, arguments), at
    text = data[at : at + length].decode()
    if token not in "sSI":
        raise ValueError(f"a token {token!r} is not read")
    return int(text) if token == "I" else text, at + length


def polynomial(expression):
    """The polynomial in the slot of a pure function, whose coefficients are integers."""
    if isinstance(expression, int):
        return fmpz_poly([expression])
    head, arguments = expression
    if head == "Slot":
        return fmpz_poly([0, 1])
    if head == "Power":
        return polynomial(arguments[0]) ** arguments[1]
    result = polynomial(arguments[0])
    for argument in arguments[1:]:
        result = OPERATIONS[head](result, polynomial(argument))
    return result


def root(function, number):
    """The root of this number, from 1; the real ones come first, in their order."""
    roots = [root for root, _ in polynomial(function[1][0]).complex_roots()]
    real = sorted((root.real for root in roots if root.imag == 0), key=lambda root: root.mid())
    return real[number - 1]


def value(expression):
    """A number as a ball."""
    if isinstance(expression, int):
        return arb(expression)
    head, arguments = expression
    if head == "Rational":
        return arb(fmpq(*arguments))
    if head == "Root":
        return root(*arguments[:2])
    numbers = [value(argument) for argument in arguments]
    if head == "Power":
        return numbers[0] ** numbers[1]
    result = numbers[0]
    for number in numbers[1:]:
        result = OPERATIONS[head](result, number)
    return result


def times(archive):
    """The first time of each query that has one, by its number."""
    found = {}
    with tarfile.open(archive) as files:
        for member in files:
            if not member.name.endswith("_roots.wxf"):
                continue
            number = int(member.name.rsplit("_q", 1)[1].split("_")[0])
            data = files.extractfile(member).read()
            if data[:2] != b"8:":
                raise ValueError(f"{member.name} is not WXF")
            (_, solutions), _ = read(data, 2)
            rules = [dict((name, of) for _, (name, of) in solution) for _, solution in solutions]
            balls = [value(rule["t"]) for rule in rules if "t" in rule]
            inside = [ball for ball in balls if ball >= 0 and ball <= 1]
            if inside:
                found[number] = min(inside, key=lambda ball: ball.mid())
    return found


def compare(program, scene):
    """How many times agree, and the names of the queries whose do not."""
    agree, wrong = 0, []
    for archive in sorted(Path(scene).glob("roots/*_roots.tar.gz")):
        queries = Path(scene) / "queries" / (archive.name.removesuffix("_roots.tar.gz") + ".csv")
        lines = subprocess.run([program, "eval", queries], check=True, capture_output=True, text=True)
        answers = {int(a["id"].rsplit("#", 1)[1]): a for a in map(json.loads, lines.stdout.splitlines())}
        for number, ball in times(archive).items():
            toi = answers[number].get("toi")
            if toi and arb(toi["below"]) <= ball.upper() and ball.lower() <= arb(toi["above"]):
                agree += 1
            else:
                wrong.append(f"{queries}#{number}: {ball}, and the oracle says {toi}")
    return agree, wrong


def main():
    program, *scenes = sys.argv[1:]
    failed = False
    for scene in scenes:
        agree, wrong = compare(program, scene)
        print(f"{scene}: {agree} times of impact agree, {len(wrong)} do not")
        print("\n".join(wrong))
        failed |= bool(wrong) or agree == 0
    sys.exit(failed)


if __name__ == "__main__":
    main()
