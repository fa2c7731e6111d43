#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""waveform_speed.py BUILD [WAVEFORMS=2000]: pcl_als_waveform beside least squares of SciPy, in one run.

Simulates a forest with waveforms of a Gaussian pulse, decomposes the file with one thread, and adjusts some of
its waveforms with scipy.optimize.least_squares: a sum of Gaussians on a constant baseline with analytic derivatives,
started at the peaks of scipy.signal.find_peaks (of five standard deviations, as many as pcl_als_waveform finds at
most). Prints processor time, waveforms per second and residuals by the number of echoes. Times of pcl_als_waveform
contain reading and writing; those of SciPy contain the adjustment only.
"""
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.optimize import least_squares
from scipy.signal import find_peaks

WIDTH = 4.0 / 2.3548  # of the pulse, samples of 1 ns


def model(p, t):
    amplitude, centre, width = p[1::3, None], p[2::3, None], p[3::3, None]
    return p[0] + (amplitude * np.exp(-0.5 * ((t - centre) / width) ** 2)).sum(axis=0)


def derivatives(p, t):
    columns = [np.ones_like(t)]
    for amplitude, centre, width in zip(p[1::3], p[2::3], p[3::3]):
        u = (t - centre) / width
        value = np.exp(-0.5 * u * u)
        columns += [value, amplitude * value * u / width, amplitude * value * u * u / width]
    return np.stack(columns, axis=1)


def adjusted(samples, echoes, noise):
    """Sum of squared residuals of the adjustment, and its processor time."""
    t = np.arange(len(samples), dtype=float)
    began = time.process_time()
    baseline = np.median(samples)
    peaks, _ = find_peaks(np.convolve(samples - baseline, [0.25, 0.5, 0.25], "same"), height=5 * noise)
    largest = sorted(sorted(peaks, key=lambda i: -samples[i])[:echoes])
    start = [baseline]
    for i in largest:
        start += [samples[i] - baseline, float(i), WIDTH]
    try:
        # Fewer echoes than were found elsewhere have larger residuals, which is part of the comparison.
        found = least_squares(lambda p: model(p, t) - samples, start, jac=lambda p: derivatives(p, t), method="lm")
        rss = 2.0 * found.cost
    except ValueError:
        rss = np.nan
    return rss, time.process_time() - began, len(largest)


def run(tool, *arguments):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([tool, *arguments, "-quiet"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    tools, wanted = os.path.join(sys.argv[1], "bin", "pcl_als_"), int(sys.argv[2]) if len(sys.argv) > 2 else 2000
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        run(tools + "simulate", "-preset", "small", "-scale", "0.5", "-density", "2", "-trees", "4", "-waveforms", "-output",
            "block")
        given = ("block/strip1.las", "echoes.las", "-pulse_width", "4", "-threads", "1")
        seconds = min(run(tools + "waveform", *given) for _ in range(3))
        run(tools + "waveform", *given, "-output", "some.json")
        with open("some.json", encoding="utf-8") as file:
            counts = json.load(file)["counts"]
        numbers = np.linspace(0, counts["points"] - 1, wanted).astype(int)
        run(tools + "waveform", *given, "-output", "all.json", "-waveforms", ",".join(map(str, numbers)))
        with open("all.json", encoding="utf-8") as file:
            waveforms = json.load(file)["waveforms"]
    each = seconds / counts["waveforms"]
    print(f"pcl_als_waveform: {counts['waveforms']} waveforms, {counts['echoes']} echoes, {seconds:.2f} s, "
          f"{1 / each:.0f} waveforms a second with reading and writing")
    print("| echoes | waveforms | samples | SciPy, a second | fewer echoes found | residuals, RMS, counts | SciPy |")
    print("|---|---|---|---|---|---|---|")
    all_seconds = 0.0
    for echoes in range(1, 7):
        chosen = [w for w in waveforms if len(w["echoes"]) == echoes]
        if not chosen:
            continue
        own, other, used, fewer, count = 0.0, 0.0, 0.0, 0, 0
        for w in chosen:
            samples = np.array(w["samples"])
            rss, spent, found = adjusted(samples, echoes, w["noise"])
            used += spent
            if not np.isfinite(rss):
                continue
            fewer += found < echoes
            own += ((samples - np.array(w["model"])[::4]) ** 2).sum()
            other += rss
            count += len(samples)
        all_seconds += used
        print(f"| {echoes} | {len(chosen)} | {count / len(chosen):.0f} | {len(chosen) / used:.0f} | {fewer} | "
              f"{(own / count) ** 0.5:.3f} | {(other / count) ** 0.5:.3f} |")
    print(f"SciPy takes {all_seconds / len(waveforms) / each:.0f} times as long for waveforms of this mixture")


if __name__ == "__main__":
    main()
