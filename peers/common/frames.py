"""A program that answers queries in the binary form of docs/bring-your-own.md, and times each answer.

At the end of its input it says how long the engine took, in one line of JSON on the standard error.
"""

import json
import os
import struct
import sys
import time

QUERY = struct.Struct("<QII26d")
ANSWER = struct.Struct("<IQIId")

SKIN = float(os.environ.get("PEERS_SKIN", 0))

_times = []


def timed(call, *arguments, **options):
    """What ``call`` returns. Only the engine's own call belongs in it."""
    start = time.perf_counter_ns()
    result = call(*arguments, **options)
    _times.append(time.perf_counter_ns() - start)
    return result


def serve(answer):
    """Answers until the input ends. ``answer(kind, points, radii)`` gives a time, ``None`` for a miss, or
    ``NotImplemented``; ``points`` are eight of three numbers, those at the start first."""
    output = os.fdopen(os.dup(1), "wb")
    # What the engine prints must not be taken for answers.
    os.dup2(2, 1)
    while header := sys.stdin.buffer.read(4):
        query = QUERY.unpack(sys.stdin.buffer.read(int.from_bytes(header, "little")))
        number, kind, radii, numbers = query[0], query[1], query[3:5], query[5:]
        points = [numbers[3 * i : 3 * i + 3] for i in range(8)]
        toi = answer(("edge-edge", "vertex-face")[kind], points, radii)
        verdict = 2 if toi is NotImplemented else 0 if toi is None else 1
        output.write(ANSWER.pack(24, number, verdict, 0, toi if verdict == 1 else 0.0))
        output.flush()
    if _times:
        times = sorted(_times)
        at = lambda share: times[min(len(times) - 1, int(share * len(times)))]
        said = {"calls": len(times), "mean_ns": sum(times) / len(times), "median_ns": at(0.5)}
        print(json.dumps({**said, "p99_ns": at(0.99), "worst_ns": times[-1]}), file=sys.stderr)
