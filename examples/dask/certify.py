"""A method judged on a cluster: the same function on each part, and one certificate of all of them.

    pip install ./python 'dask[distributed]'
    python examples/dask/certify.py

Here the cluster is local; another is `Client("tcp://scheduler:8786")`. What comes out is what one machine gives, to the last
byte.
"""

import numpy as np
import tunnelproof
from dask.distributed import Client, LocalCluster

PARTS = 4
SETTINGS = {"name": "midway", "families": ["uniform", "lattice"], "count": 2000, "seed": 1}


def midway(kind, points, radii):
    """What the certified path says, with half of the time of impact: safe, and far too early."""
    if kind != "edge-edge":
        return None
    hits = tunnelproof.decide(kind, points, radii)
    return hits.hit, np.nan_to_num(hits.toi) / 2


def judge(part: int) -> str:
    """The certificate of one part, as JSON."""
    return tunnelproof.certify(midway, shard=(part, PARTS), **SETTINGS).json


def main() -> None:
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        with Client(cluster) as client:
            parts = client.gather(client.map(judge, range(1, PARTS + 1)))
    certificate = tunnelproof.merge(parts)
    print(certificate.text)
    assert certificate.json == tunnelproof.certify(midway, **SETTINGS).json
    print(f"{PARTS} parts on the cluster and one machine: the same certificate")


if __name__ == "__main__":
    main()
