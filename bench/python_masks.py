#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""From masks of 100 labels to vertices and faces: Python against the program, in turn.

    LOFT=build/release/app/loft PYTHONPATH=build/release/python python3 bench/python_masks.py

Both start from the same pixels: numpy's in memory, an uncompressed NRRD file. Processor seconds and
seconds; the program's are those that it reports for reading and for making surfaces. Then how much
memory the vertices take.
"""

import json
import os
import resource
import statistics
import subprocess
import tempfile
import time

import numpy as np

import loft

SHAPE = (60, 400, 400)
SPACING = (3.0, 1.0, 1.0)


def volume():
    """Balls in a grid of 10 by 10, that wander."""
    z, y, x = np.indices(SHAPE, dtype=np.float32)
    pixels = np.zeros(SHAPE, dtype=np.uint16)
    for k in range(100):
        middle = (30 + 5 * np.sin(k), 20 + 40 * (k // 10), 20 + 40 * (k % 10))
        inside = ((1.4 * (z - middle[0])) ** 2 + (y - middle[1] - 2 * np.sin(z / 4)) ** 2
                  + (x - middle[2] - 2 * np.cos(z / 5)) ** 2 < (14 + 3 * np.cos(k)) ** 2)
        pixels[inside] = k + 1
    return pixels


def write_nrrd(path, pixels):
    header = (f"NRRD0004\ntype: uint16\ndimension: 3\nsizes: {pixels.shape[2]} {pixels.shape[1]} "
              f"{pixels.shape[0]}\nspacings: {SPACING[2]} {SPACING[1]} {SPACING[0]}\n"
              "encoding: raw\nendian: little\n\n")
    with open(path, "wb") as file:
        file.write(header.encode())
        file.write(pixels.tobytes())


def by_python(pixels):
    begin = time.perf_counter(), time.process_time()
    made = loft.reconstruct(loft.Stack.from_mask(pixels, SPACING), threads=1)
    arrays = [(one.vertices, one.faces) for one in made.values()]
    return time.perf_counter() - begin[0], time.process_time() - begin[1], arrays


def by_program(path, output):
    words = [os.environ.get("LOFT", "loft"), "reconstruct", path, "-o", output, "-q", "--json",
             "--threads", "1"]
    report = json.loads(subprocess.run(words, stdout=subprocess.PIPE, check=True).stdout)
    return sum(s for stage, s in report["seconds"].items() if stage not in ("total", "write"))


def resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def main():
    pixels = volume()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "labels.nrrd")
        write_nrrd(path, pixels)
        ratios = []
        for i in range(9):
            theirs = by_program(path, os.path.join(folder, "out.ply"))
            ours, busy, arrays = by_python(pixels)
            ratios.append(ours / theirs)
            print(f"program {theirs:.3f} s, Python {ours:.3f} s ({busy:.3f} of a processor): "
                  f"{ratios[-1]:.3f}")
        print(f"median {statistics.median(ratios):.3f} times the program's time, "
              f"{len(arrays)} labels, {sum(len(f) for _, f in arrays)} triangles")
    made = loft.reconstruct(loft.Stack.from_mask(pixels, SPACING), threads=1)
    before = resident()
    vertices = [one.vertices for one in made.values()]
    size = sum(array.nbytes for array in vertices)
    print(f"vertices of {size / 1e6:.2f} MB take {(resident() - before) / 1e6:.2f} MB more memory")


if __name__ == "__main__":
    main()
