#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""check_delivery.py QUALITY.json PLOT.png STRIP...

Measures how well the overlapping strips of a delivery agree, and plots their height differences
with the limit of quality level 2 (USGS Lidar Base Specification).
"""
import json
import sys

import matplotlib

matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt

import pcl_als

output, plot, *strips = sys.argv[1:]
result = pcl_als.check(strips, quality_level=2)
with open(output, "w") as file:
    json.dump(result.to_dict(), file, indent=1)

judged = [pair for pair in result.block.pairs if pair.status == "judged"]
for pair in judged:
    level = "none" if pair.quality_level is None else f"QL{pair.quality_level}"
    print(f"{pair.a} & {pair.b}: RMSDz {pair.vertical.rms:.3f} m, mean {pair.vertical.mean:+.3f} m, {level}")
if not result.reliable:
    sys.exit(f"no reliable answer: {result.reason}")

fig, axes = plt.subplots(figsize=(8, 4.5), layout="constrained")
axes.boxplot([pair.sampled_offsets for pair in judged], whis=(5, 95), showfliers=False)
axes.set_xticks(range(1, len(judged) + 1), [f"{pair.a} & {pair.b}" for pair in judged], rotation=60)
axes.axhspan(-0.08, 0.08, color="tab:green", alpha=0.15, label="RMSDz of 8 cm")
axes.set_ylabel("height difference, m")
axes.set_title("Smooth ground in overlaps: quartiles, 5 % and 95 %")
axes.legend()
fig.savefig(plot, dpi=120)
