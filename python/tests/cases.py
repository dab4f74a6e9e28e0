# SPDX-License-Identifier: MIT
"""What tests share: shapes, random stacks, and a seed that a failure can be made again with."""

import os
import random
import sys
import threading

import numpy as np

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
# Sanitizers make all of it ten times as slow.
IS_SANITIZED = "asan" in os.environ.get("LD_PRELOAD", "")
SAMPLES = os.path.join(os.path.dirname(__file__), "..", "..", "samples")


def failures_in_threads(work, count):
    """What work(0), work(1), ... raised, each in a thread of its own, all at once."""
    failures = []

    def run(number):
        try:
            work(number)
        except BaseException as error:  # noqa: B902
            failures.append(error)

    threads = [threading.Thread(target=run, args=(number,)) for number in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return failures


def seeded():
    """A generator of random numbers; LOFT_SEED gives one again."""
    seed = int(os.environ.get("LOFT_SEED", random.randrange(2**31)))
    print(f"LOFT_SEED={seed}", file=sys.stderr)
    return np.random.default_rng(seed)


def star(random_, centre=(0.0, 0.0), radius=1.0, points=24):
    """A ring around a place."""
    angles = np.arange(points) * (2 * np.pi / points)
    radii = radius * random_.uniform(0.6, 1.4, points)
    return np.stack([centre[0] + radii * np.cos(angles), centre[1] + radii * np.sin(angles)], 1)


def random_slices(random_, count=6, labels=("",)):
    """Slices with a star or two of each label."""
    slices = []
    for i in range(count):
        rings = {}
        for k, label in enumerate(labels):
            middle = (10.0 * k, 0.0)
            rings[label] = [star(random_, middle + random_.normal(0, 0.3, 2)) for _ in range(1 + i % 2)]
        slices.append((float(i), rings))
    return slices


def ball(size=24, radius=8.0, stretch=1.0):
    """A mask, z, y, x."""
    z, y, x = np.mgrid[:size, :size, :size] - (size - 1) / 2
    return (stretch * z) ** 2 + y**2 + x**2 < radius**2
