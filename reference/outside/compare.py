"""Compares the answers of the project's judges with those of `judge.py`, on fresh queries of every family.

    python reference/outside/compare.py PROGRAM [--count N] [--seed S] [--families A,B] [--plant FAULT]

PROGRAM is the command line, target/release/tunnelproof. Of each query it is compared whether there is
a contact, and both numbers that enclose the time of impact; of the certified path, too. A difference is
a line, with the query as `eval` reads it, and the exit code is 1.
"""

import argparse
import concurrent.futures
import datetime
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import time

try:
    import judge
except ModuleNotFoundError as missing:
    here = pathlib.Path(__file__).parent
    sys.exit(f"{missing.name} is not installed for this Python: {sys.executable} -m pip install -r {here / 'requirements.txt'}")

# Who answers, and which queries.
SUBJECTS = {
    "oracle": lambda query: True,
    "difference": lambda query: True,
    "certified": lambda query: True,
    "shadow": lambda query: query["kind"] == "edge-edge" and query.get("radius", 0) == 0,
}

# Keeps what it is asked, and takes none of it.
RECORD = """
import sys
with open(sys.argv[1], "a") as file:
    for line in sys.stdin:
        file.write(line)
        print('{"unsupported": true}', flush=True)
"""

# Wrong answers, to see that they are found.
FAULTS = {
    "miss": lambda toi: None,
    "hit": lambda toi: toi or (0.5, 0.5),
    "late": lambda toi: toi and (toi[0], math.nextafter(toi[1], 2.0)),
    "early": lambda toi: toi and (math.nextafter(toi[0], -1.0), toi[1]),
}


def run(*words):
    try:
        done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    except OSError as error:
        sys.exit(f"{words[0]}: it does not run: {error.strerror}")
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: exit code {done.returncode}\n{done.stderr}")
    return done.stdout


def families(program):
    """The names of the families of linear motion."""
    help_text = run(program, "certify", "--help")
    names = re.search(r"--family <.*?\[possible values: (.*?)\]", help_text, re.S)
    if not names:
        sys.exit(f"{program}: `certify --help` names no families; is it target/release/tunnelproof?")
    return [name for name in names[1].split(", ") if "turning_" not in name]


def queries(program, family, seed, count, folder):
    """The first queries of a family, named as `explain` takes them."""
    path = folder / f"{family}.record"
    script = folder / "record.py"
    script.write_text(RECORD)
    words = ["--threads", 1, "--one-judge", "--family", family, "--seed", seed, "--count", count]
    run(program, "certify", *words, "--subject", f"cmd:{sys.executable} {script} {path}")
    lines = [json.loads(line) for line in path.read_text().splitlines()]
    return [{**line, "id": f"{family}:{seed}:{index}"} for index, line in enumerate(lines)]


def answer(query):
    """Both numbers that enclose the time of impact, or None; and how long that took."""
    start = time.monotonic()
    enclosure = judge.time_of_impact(query)
    return enclosure, time.monotonic() - start


def said(line):
    toi = line.get("toi")
    return (toi["below"], toi["above"]) if line["hit"] else None


def number_of_queries(text):
    if not re.fullmatch("[0-9]+", text) or int(text) == 0:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least 1")
    return int(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--count", type=number_of_queries, default=34, help="queries of each family, at least 1")
    parser.add_argument("--seed", type=int, default=int(datetime.datetime.now().strftime("%y%j%H%M")))
    parser.add_argument("--families", help="some, separated by commas; by default all")
    parser.add_argument("--plant", choices=FAULTS, help="spoil every other answer")
    options = parser.parse_args()
    start = time.monotonic()
    names = families(options.program)
    if options.families:
        asked = options.families.split(",")
        unknown = [name for name in asked if name not in names]
        if unknown:
            sys.exit(f"no family of linear motion has this name: {', '.join(unknown)}; there are {', '.join(names)}")
        names = [name for name in names if name in asked]
    totals = {"queries": 0, "hits": 0, "answers compared": 0, "differences": 0}
    slowest = (0.0, "")
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ProcessPoolExecutor() as pool:
        for name in names:
            asked = queries(options.program, name, options.seed, options.count, pathlib.Path(folder))
            assert len(asked) == options.count, f"{name}: {len(asked)} queries"
            own = list(pool.map(answer, asked, chunksize=4))
            slowest = max(slowest, *((seconds, query["id"]) for (_, seconds), query in zip(own, asked)))
            own = [enclosure for enclosure, _ in own]
            if options.plant:
                own[::2] = map(FAULTS[options.plant], own[::2])
            totals["queries"] += len(own)
            totals["hits"] += sum(enclosure is not None for enclosure in own)
            file = pathlib.Path(folder) / f"{name}.jsonl"
            for subject, takes in SUBJECTS.items():
                taken = [(query, ours) for query, ours in zip(asked, own) if takes(query)]
                file.write_text("".join(json.dumps(query) + "\n" for query, _ in taken))
                lines = run(options.program, "eval", "--subject", subject, file).splitlines() if taken else []
                assert len(lines) == len(taken), f"{name}, {subject}: {len(lines)} answers"
                for (query, ours), line in zip(taken, map(json.loads, lines)):
                    totals["answers compared"] += 1
                    if said(line) != ours:
                        totals["differences"] += 1
                        print(f"{subject}: {said(line)}, outside judge: {ours}: {json.dumps(query)}")
    counts = ", ".join(f"{number:,} {what}" for what, number in totals.items())
    print(f"seed {options.seed}: {counts}, {len(names)} families, {time.monotonic() - start:.0f} s")
    print(f"slowest query of the outside judge: {slowest[1]}, {slowest[0]:.1f} s")
    if totals["queries"] == 0:
        sys.exit("no query was asked")
    sys.exit(1 if totals["differences"] else 0)


if __name__ == "__main__":
    main()
