# SPDX-License-Identifier: MIT
"""Times scipy and matplotlib on the samples of `fields_workload make`: fields_peers.py SAMPLES FOLDER"""
import sys
import time

import matplotlib.tri
import numpy
from scipy.interpolate import CloughTocher2DInterpolator, LinearNDInterpolator

count, folder = sys.argv[1:]
samples = numpy.loadtxt(f"{folder}/terrain_{count}.xyz")
queries = numpy.loadtxt(folder + "/queries_100000.xy")
places, values = samples[:, :2], samples[:, 2]


def matplotlib_linear():
    triangles = matplotlib.tri.Triangulation(places[:, 0], places[:, 1])
    ask = matplotlib.tri.LinearTriInterpolator(triangles, values)
    return lambda at: ask(at[:, 0], at[:, 1])


peers = {
    "scipy linear": lambda: LinearNDInterpolator(places, values),
    "scipy cubic": lambda: CloughTocher2DInterpolator(places, values),
    "matplotlib linear": matplotlib_linear,
}
for name, build in peers.items():
    started = time.process_time()
    ask = build()
    built = time.process_time() - started
    started = time.process_time()
    ask(queries)
    asked = time.process_time() - started
    print(f"{name}: build {built * 1e3:.1f} ms, query {asked * 1e6 / len(queries):.3f} us", flush=True)
