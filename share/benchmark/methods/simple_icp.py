#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""simpleICP (Glira), pair by pair, with 2 000 correspondences.

Install: the Python package `simpleicp`, https://github.com/pglira/simpleICP (MIT), with numpy,
scipy, pandas and lmfit. It must be found by `import simpleicp` (PYTHONPATH).
"""
import adapter
import pairwise

POINTS, CORRESPONDENCES = 50_000, 2_000


def main():
    try:
        import simpleicp
        from simpleicp import PointCloud, SimpleICP
    except ImportError as error:
        adapter.missing(f"simpleICP is not installed ({error}): see methods/simple_icp.py")

    def align(fixed, moving):
        icp = SimpleICP(verbose=False)
        icp.add_point_clouds(PointCloud(fixed, columns=["x", "y", "z"]),
                             PointCloud(moving, columns=["x", "y", "z"]))
        try:
            return icp.run(correspondences=CORRESPONDENCES, max_overlap_distance=2.0)[0]
        except Exception as error:  # its own exceptions derive from Exception alone
            raise RuntimeError(error) from error
    pairwise.run(__doc__, "simpleICP", getattr(simpleicp, "__version__", "-"), align, POINTS)


if __name__ == "__main__":
    main()
