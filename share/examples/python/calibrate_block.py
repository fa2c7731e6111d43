#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""calibrate_block.py TRAJECTORY CONTROL.csv CALIBRATION.json PLOT.png STRIP...

Estimates the biases of a laser scanning system from a block of strips, and plots the misfit of each
pair of strips before and after.
"""
import sys

import matplotlib

matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt
import numpy as np

import pcl_als

trajectory, control, output, plot, *strips = sys.argv[1:]


def report(progress):
    if progress.event == "end":
        print(f"{progress.phase}: {progress.text}", file=sys.stderr)


result = pcl_als.calibrate(strips, trajectory, control=control, progress=report)
result.write(output)
for parameter in result.parameters.values():
    print(f"{parameter.name:18} {parameter.bias:12.5g} {parameter.unit:6} std {parameter.std:9.2g}  {parameter.status}")
print("verdict:", result.verdict)

fig, (left, right) = plt.subplots(1, 2, figsize=(11, 4.5), layout="constrained")
places = np.arange(len(result.pairs))
left.bar(places - 0.2, [100 * pair.rms_before for pair in result.pairs], 0.4, label="before")
left.bar(places + 0.2, [100 * pair.rms_after for pair in result.pairs], 0.4, label="after")
left.set_xticks(places, [f"{pair.a} & {pair.b}" for pair in result.pairs], rotation=60)
left.set_ylabel("RMS of normal distances, cm")
left.set_title("Overlapping strips")
left.legend()
image = right.imshow(result.correlation, vmin=-1, vmax=1, cmap="RdBu_r")
right.set_xticks(range(len(result.correlation_order)), result.correlation_order, rotation=60, ha="right")
right.set_yticks(range(len(result.correlation_order)), result.correlation_order)
right.set_title("Correlation of the parameters")
fig.colorbar(image)
fig.savefig(plot, dpi=120)
