#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How Loft scales as a job of others.

    PYTHONPATH=build/release/python python3 bench/scale.py archive [--studies 2000]
    LOFT=build/release/app/loft python3 bench/scale.py huge [--vertices 100000000] [--folder DIR]

archive: synthetic studies of 20 labels each, by Dask with one worker and with two; the share of
twice the speed, in percent, median of the rounds.
huge: one stack, made on the fly, in one run out of core and in 8 ranges; whether the bytes are the
same, seconds and peak memory of each job.
"""

import argparse
import hashlib
import os
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np


def study(number, labels=20, slices=16, points=48):
    """Organs that wander and swell on their way up, as what loft.Stack takes."""
    random = np.random.default_rng(number)
    angles = np.arange(points) * (2 * np.pi / points)
    made = []
    middles = np.stack([np.arange(labels) % 5 * 40.0, np.arange(labels) // 5 * 40.0], 1)
    for z in range(slices):
        middles = middles + random.normal(0, 0.6, middles.shape)
        radii = 10 + 4 * np.sin(0.4 * z + np.arange(labels))[:, None]
        radii = radii * (1 + 0.05 * random.normal(size=(labels, points)))
        rings = {f"organ{k:02}": [middles[k] + radii[k][:, None] * np.c_[np.cos(angles), np.sin(angles)]]
                 for k in range(labels)}
        made.append((3.0 * z, rings))
    return made


def volumes(number):
    import loft

    return [one.volume for one in loft.reconstruct(study(number), threads=1).values()]


def archive(arguments):
    from distributed import Client, LocalCluster

    def seconds(client, numbers):
        begin = time.perf_counter()
        client.gather(client.map(volumes, numbers, pure=False))
        return time.perf_counter() - begin

    rounds = []
    per_round = arguments.studies // arguments.rounds
    clusters = [LocalCluster(n_workers=n, threads_per_worker=1, dashboard_address=None)
                for n in (1, 2)]
    clients = [Client(cluster) for cluster in clusters]
    for client in clients:
        seconds(client, range(4))  # imports
    for i in range(arguments.rounds):
        numbers = range(i * per_round, (i + 1) * per_round)
        one, two = (seconds(client, numbers) for client in clients)
        rounds.append(one / two)
        print(f"{per_round} studies: {one:.1f} s by 1 worker, {two:.1f} s by 2: {one / two:.3f} times")
    speed = statistics.median(rounds)
    print(f"median {speed:.3f} times as fast: {50 * speed:.0f} % of twice")
    for client, cluster in zip(clients, clusters):
        client.close()
        cluster.close()


def write_huge(path, vertices, rings=100, points=1000):
    """A stack of so many contour vertices, slice by slice: a grid of rods that swell."""
    angles = np.arange(points) * (2 * np.pi / points)
    circle = np.c_[np.cos(angles), np.sin(angles)]
    side = int(np.ceil(np.sqrt(rings)))
    places = np.stack(np.divmod(np.arange(rings), side), 1)[:, ::-1] * 3.0
    with open(path, "w") as file:
        for z in range(max(2, vertices // (rings * points))):
            radii = 1 + 0.2 * np.sin(0.1 * z + np.arange(rings))
            contours = []
            for place, radius in zip(places, radii):
                xy = np.char.mod("%.5f", (place + radius * circle).ravel())
                contours.append("[[" + "],[".join(map(",".join, xy.reshape(-1, 2))) + "]]")
            file.write(f'{{"z": {z}, "contours": [{",".join(contours)}]}}\n')
    return z + 1


def run(words):
    """Seconds and peak megabytes of a job."""
    begin = time.perf_counter()
    child = subprocess.Popen(words)
    _, status, used = os.wait4(child.pid, 0)
    if status != 0:
        sys.exit(f"{' '.join(words)}: status {status}")
    return time.perf_counter() - begin, used.ru_maxrss / 1024


def digest(path):
    state = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 24):
            state.update(block)
    return state.hexdigest()


def huge(arguments):
    loft = os.environ.get("LOFT", "loft")
    with tempfile.TemporaryDirectory(dir=arguments.folder) as folder:
        stack = os.path.join(folder, "huge.ndjson")
        slices = write_huge(stack, arguments.vertices)
        print(f"{arguments.vertices} contour vertices in {slices} slices, "
              f"{os.path.getsize(stack) / 1e9:.2f} GB")
        common = [loft, "reconstruct", stack, "-q", "--threads", "1"]
        whole = os.path.join(folder, "whole.ply")
        print("whole: %.1f s, %.0f MB" % run([*common, "--out-of-core", "-o", whole]))
        expected = digest(whole)
        os.remove(whole)
        cuts = [i * (slices - 1) // 8 for i in range(9)]
        parts = []
        for first, last in zip(cuts, cuts[1:]):
            parts.append(os.path.join(folder, f"part{first}.ply"))
            print(f"slabs {first}..{last}: %.1f s, %.0f MB" % run(
                [*common, "--slabs", f"{first}..{last}", "-o", parts[-1]]))
        print("join: %.1f s, %.0f MB" % run([loft, "join", "-q", *parts, "-o", whole]))
        print("the same bytes" if digest(whole) == expected else "OTHER BYTES")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(required=True)
    command = commands.add_parser("archive")
    command.add_argument("--studies", type=int, default=2000)
    command.add_argument("--rounds", type=int, default=5)
    command.set_defaults(run=archive)
    command = commands.add_parser("huge")
    command.add_argument("--vertices", type=int, default=100_000_000)
    command.add_argument("--folder")
    command.set_defaults(run=huge)
    arguments = parser.parse_args()
    arguments.run(arguments)


if __name__ == "__main__":
    main()
