#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether the cost of `loft` grows like n log n, for kinds of stacks that boxes and grids have trouble with:

    python3 bench/families.py LOFT [--kinds KIND,...] [--sizes N,...] [--limit SECONDS]

A line for each: kind, command, points, CPU seconds, and how many times those of a quarter of the
points. 4 times the points should take at most 5 times the time. A kind ends with the first run
that takes longer than the limit, in CPU seconds.
"""
import argparse
import json
import math
import pathlib
import random
import resource
import subprocess
import tempfile


def ngon(n, radius, x=0, y=0, turn=0):
    angles = (2 * math.pi * i / n + turn for i in range(n))
    return [[x + radius * math.cos(a), y + radius * math.sin(a)] for a in angles]


def box(x, y, width, height):
    return [[x, y], [x + width, y], [x + width, y + height], [x, y + height]]


def ends(n):
    """Parts in a column, none over another."""
    count = n // 8
    return [(z, [box(0, 3 * i + 1.5 * z, 1, 1) for i in range(count)]) for z in range(2)]


def grid(n):
    """Small hexagons, shuffled."""
    side = math.isqrt(n // 18)

    def slice_at(dx):
        cells = [ngon(6, 0.3, i + dx, j) for i in range(side) for j in range(side)]
        random.Random(1).shuffle(cells)
        return cells

    return [(0, slice_at(0)), (1, slice_at(0.05)), (2, slice_at(0))]


def labels(n):
    """Labels of one part each."""
    return [(z, [ngon(12, 0.3, i) for i in range(n // 36)]) for z in range(3)]


def rings(n):
    """Long thin triangles between outlines of as many points."""
    k = n // 3
    return [(0, [ngon(k, 10)]), (1, [ngon(k, 11, turn=0.1)]), (2, [ngon(k, 10)])]


def mismatch(n):
    """Fans of a hundred triangles."""
    few = max(n // 100, 3)
    return [(0, [ngon(few, 10)]), (1, [ngon(n, 11)]), (2, [ngon(few, 10)])]


def triangle(n):
    """Fans of a third of all triangles."""
    return [(0, [ngon(n // 2, 10)]), (1, [ngon(3, 9)]), (2, [ngon(n // 2, 10)])]


def prism(n, gap=1.0):
    return [(z * gap, [ngon(n // 5, 10 + 0.2 * z, turn=z * 0.01)]) for z in range(5)]


def comb(teeth, length, is_upright):
    points = [[i, length * (i % 2)] for i in range(2 * teeth + 1)]
    back = [[2 * teeth, -1], [0, -1]]
    return [p if is_upright else p[::-1] for p in points + back]


def combs(n):
    """Two slices of combs whose teeth are side by side and do not cross."""
    teeth = n // 4
    return [(0, [comb(teeth, 200, True)]), (1, [[[x + 0.2, y] for x, y in comb(teeth, 200, True)]])]


def crossed_combs(n):
    """Teeth across teeth, each over a few: n points and as many crossings again."""
    count = n // 24
    lower = [[[x + 20 * i, y] for x, y in comb(3, 6, True)] for i in range(count)]
    upper = [[[x + 20 * i, y] for x, y in comb(3, 6, False)] for i in range(count)]
    return [(0, lower), (1, upper)]


def nested(n):
    """Outlines within each other."""
    count = n // 8
    return [(z, [ngon(4, 1 + i + 0.1 * z) for i in range(count)]) for z in range(2)]


# kind: how it is made, the options it is reconstructed with, whether its surface is checked as well
FAMILIES = {
    "ends": (ends, [], False),
    "grid": (grid, [], False),
    "labels": (labels, [], False),
    "rings": (rings, ["--smooth"], True),
    "mismatch": (mismatch, ["--smooth"], True),
    "triangle": (triangle, ["--smooth"], False),
    "fans": (triangle, [], True),
    "bars": (prism, [], True),
    "nested": (nested, [], True),
    "simplify": (prism, ["--simplify", "0.01"], False),
    "maxedge": (lambda n: prism(n, 0.5), ["--max-edge", "0.1"], False),
    "combs": (combs, [], True),
    "crossed": (crossed_combs, [], True),
}


def write_stack(kind, n, file):
    points = 0
    with open(file, "w") as out:
        for z, contours in FAMILIES[kind][0](n):
            line = {"z": z, "contours": contours}
            if kind == "labels":
                line["labels"] = [f"l{i}" for i in range(len(contours))]
            points += sum(map(len, contours))
            out.write(json.dumps(line) + "\n")
    return points


def seconds_of(command, limit):
    """CPU seconds; None where it does not end in time, or fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    bound = (math.ceil(limit), math.ceil(limit))
    try:
        subprocess.run(command, check=True, capture_output=True,
                       preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, bound))
    except subprocess.CalledProcessError:
        return None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def run_family(loft, kind, sizes, limit, folder):
    _, options, is_checked = FAMILIES[kind]
    last = {}
    for n in sizes:
        stack, surface = folder / "stack.ndjson", folder / "surface.ply"
        points = write_stack(kind, n, stack)
        make = [loft, "reconstruct", stack, "-o", surface, "--quiet", "--threads", "1"] + options
        commands = [(" ".join(["reconstruct"] + options), make)]
        if is_checked:
            commands.append(("check", [loft, "check", surface]))
        for name, command in commands:
            if name in last and last[name] is None:
                continue
            seconds = seconds_of(command, limit)
            before = last.get(name)
            ratio = f"{seconds / before:.1f}" if seconds is not None and before else ""
            shown = f"{seconds:.2f}" if seconds is not None else f"not in {limit:.0f}"
            print(f"| {kind} | {name} | {points:,} | {shown} | {ratio} |", flush=True)
            last[name] = seconds
            if seconds is None:
                break
        if last[commands[0][0]] is None:
            return


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("loft")
    parser.add_argument("--kinds", default=",".join(FAMILIES))
    parser.add_argument("--sizes", default="4000,16000,64000,256000,1000000")
    parser.add_argument("--limit", type=float, default=600)
    arguments = parser.parse_args()
    print("| kind | command | points | CPU seconds | times a quarter |\n| --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        for kind in arguments.kinds.split(","):
            sizes = [int(n) for n in arguments.sizes.split(",")]
            run_family(arguments.loft, kind, sizes, arguments.limit, pathlib.Path(folder))


if __name__ == "__main__":
    main()
