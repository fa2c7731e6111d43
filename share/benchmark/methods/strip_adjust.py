#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""lidar-strip-adjust (Tasleem), pair by pair, with its defaults and 15 000 points of each strip.

Install: the Python package `lidar-strip-adjust`, https://github.com/daudee215/lidar-strip-adjust
(MIT), with numpy, scipy and scikit-learn. It must be found by `import lidar_strip_adjust`.
"""
import adapter
import pairwise

POINTS = 15_000  # every point costs a decomposition in Python


def main():
    try:
        import lidar_strip_adjust
        from lidar_strip_adjust.adjustment import StripAdjuster, apply_correction
    except ImportError as error:
        adapter.missing(f"lidar-strip-adjust is not installed ({error}): "
                        "see methods/strip_adjust.py")

    def align(fixed, moving):
        found = StripAdjuster().adjust(fixed, moving).params
        motion = pairwise.numpy.eye(4)
        motion[:3, 3] = apply_correction(pairwise.numpy.zeros((1, 3)), found)[0]
        motion[:3, :3] = (apply_correction(pairwise.numpy.eye(3), found) - motion[:3, 3]).T
        return motion
    pairwise.run(__doc__, "lidar-strip-adjust", getattr(lidar_strip_adjust, "__version__", "-"),
                 align, POINTS)


if __name__ == "__main__":
    main()
