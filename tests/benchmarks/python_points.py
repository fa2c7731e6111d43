#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""python_points.py: time and memory of ten million points to numpy and back (PYTHONPATH=build/python)."""
import resource
import time

import numpy as np

import pcl_als

COUNT = 10_000_000


def memory():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize() / 2**20


def measure(what, job, repeats=5):
    """Least time of some runs, and the memory of the process that the result takes."""
    times = []
    for _ in range(repeats):
        before, start = memory(), time.perf_counter()
        result = job()
        times.append(time.perf_counter() - start)
        grown = memory() - before
        del result
    print(f"| {what} | {1e3 * min(times):.3f} | {grown:.0f} |")


points = pcl_als.empty_points(COUNT)
points["z"] = np.arange(COUNT) % 1000
strip = pcl_als.Strip(points)
columns = {name: np.ascontiguousarray(points[name]) for name in points.dtype.names}


def fill():
    made = pcl_als.empty_points(COUNT)
    for name, values in columns.items():
        made[name] = values
    return pcl_als.Strip(made)


print("| step, 10 million points of 48 bytes | time, ms | memory, MB |\n|---|---|---|")
measure("`strip.points`", lambda: strip.points)
measure("`Strip(points)`, a view as a whole", lambda: pcl_als.Strip(points))
measure("`Strip(points[1:])`, a copy", lambda: pcl_als.Strip(points[1:]))
measure("eleven arrays into `empty_points()`", fill)
measure("`strip.ground()`", strip.ground)
