#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""normalise_intensity.py TILE OUTPUT PLOT.png

Corrects the intensities of a tile for range, incidence and atmosphere where no trajectory was
delivered: it is reconstructed from the points.
"""
import sys

import matplotlib

matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt
import numpy as np

import pcl_als

tile, output, plot = sys.argv[1:]
flight = pcl_als.reconstruct_trajectory([tile])
print(f"{len(flight)} positions reconstructed, {flight.end_time - flight.start_time:.0f} s")
for remark in flight.remarks:
    print("note:", remark)

air = pcl_als.Atmosphere(visibility_km=23.0, temperature_c=15.0, pressure_kpa=101.3)
settings = pcl_als.IntensitySettings(keep_uncovered=True)
result = pcl_als.correct_intensity([tile], [output], flight, settings=settings, atmosphere=air)
for status, points in result.points_by_status.items():
    print(f"{status:20} {points:10}")

fig, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
for name, label in ((tile, "as delivered"), (output, "normalised")):
    points = np.concatenate([strip.points for strip in pcl_als.read_strips([name])])
    angle = np.abs(points["scan_angle"])
    edges = np.linspace(0, angle.max() + 1e-3, 21)
    place = np.digitize(angle, edges) - 1
    means = [points["intensity"][place == i].mean() if (place == i).any() else np.nan for i in range(20)]
    axes.plot((edges[:-1] + edges[1:]) / 2, means / np.nanmean(means), marker="o", label=label)
axes.set_xlabel("scan angle, degrees")
axes.set_ylabel("mean intensity, relative")
axes.set_title("Intensity over the swath")
axes.legend()
fig.savefig(plot, dpi=120)
