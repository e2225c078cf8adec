#!/usr/bin/env python3
"""Computes a plane in parts with HyperQueue (pip install hyperqueue).

    hyperqueue-parts.py PARTS [--server DIRECTORY] [--cpus CORES]

Without --server it starts a server and a worker on this machine. The plane, the store and the program are those of
plane.sh, or of IMPACT_ATLAS, DATA and PLANE in the environment. A task that crashes is started again by HyperQueue.
"""

import argparse
import os
import pathlib
import subprocess

from hyperqueue import Client, Job, LocalCluster
from hyperqueue.cluster import WorkerConfig
from hyperqueue.ffi.protocol import ResourceRequest

here = pathlib.Path(__file__).resolve().parent


def plane():
    """The program, the store and the options, as plane.sh sets them."""
    script = f'source "{here}/plane.sh" && printf "%s\\n" "$IMPACT_ATLAS" "$DATA" "$PLANE"'
    lines = subprocess.run(["bash", "-c", script], check=True, text=True, capture_output=True).stdout.splitlines()
    return lines[0], os.path.abspath(lines[1]), lines[2].split()


def submit(client, parts, cpus):
    program, data, options = plane()
    job = Job(max_fails=None)
    for part in range(1, parts + 1):
        job.program(
            [program, "map", *options, "--data", data, "--part", f"{part}/{parts}", "--backend", "cpu", "--threads", str(cpus)],
            name=f"part-{part}",
            stdout=None,
            resources=ResourceRequest(cpus=cpus),
            cwd=os.getcwd(),
        )
    client.wait_for_jobs([client.submit(job)])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("parts", type=int)
    parser.add_argument("--server")
    parser.add_argument("--cpus", type=int, default=1)
    arguments = parser.parse_args()
    if arguments.server:
        submit(Client(arguments.server), arguments.parts, arguments.cpus)
        return
    with LocalCluster() as cluster:
        cluster.start_worker(WorkerConfig())
        submit(cluster.client(), arguments.parts, arguments.cpus)


if __name__ == "__main__":
    main()
