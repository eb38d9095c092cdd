"""IPC Toolkit's continuous collision detection as a program that `tunnelproof certify` asks, over lines of JSON.

    pip install -r requirements.txt
    cargo run --release -- certify --subject 'cmd:python examples/ipctk/adapter.py tight-inclusion'

`tight-inclusion` is Tight-Inclusion CCD (Wang et al. 2021), `additive` additive CCD (Li et al. 2021), both as the toolkit calls them
by default, but for the largest number of iterations, which may be given as a second argument.
"""

import json
import sys

import ipctk

# What it logs goes to the standard output, where answers are due.
ipctk.set_logger_level(ipctk.LoggerLevel.off)

METHODS = {
    "tight-inclusion": ipctk.TightInclusionCCD,
    "additive": ipctk.AdditiveCCD,
}


def method(name: str, iterations: int | None) -> ipctk.NarrowPhaseCCD:
    """The method of this name."""
    settings = {} if iterations is None else {"max_iterations": iterations}
    return METHODS[name](**settings)


def toi(ccd: ipctk.NarrowPhaseCCD, query: dict) -> float | None:
    """The time of impact that the toolkit states, or `None` for a miss."""
    radius = query.get("radius", 0.0)
    # The toolkit's minimum distance is one number: the sum of two radii is rounded, as its users would have to.
    distance = sum(radius) if isinstance(radius, list) else radius
    points = [[float(x) for x in point] for point in query["points"]]
    decide = ccd.edge_edge_ccd if query["kind"] == "edge-edge" else ccd.point_triangle_ccd
    hit, time = decide(*points, min_distance=distance)
    return time if hit else None


def main() -> None:
    name, *rest = sys.argv[1:]
    ccd = method(name, int(rest[0]) if rest else None)
    for line in sys.stdin:
        query = json.loads(line)
        time = toi(ccd, query)
        answer = {"id": query["id"], "hit": time is not None}
        if time is not None:
            answer["toi"] = time
        print(json.dumps(answer), flush=True)


if __name__ == "__main__":
    main()
