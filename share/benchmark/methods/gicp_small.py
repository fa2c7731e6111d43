#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""small_gicp (Koide), pair by pair: GICP with its defaults, correspondences to 2 m.

Install: the Python package `small_gicp`, https://github.com/koide3/small_gicp (MIT). It must be
found by `import small_gicp` (PYTHONPATH).
"""
import os

import adapter
import pairwise

POINTS = 100_000


def main():
    try:
        import small_gicp
    except ImportError as error:
        adapter.missing(f"small_gicp is not installed ({error}): see methods/gicp_small.py")

    def align(fixed, moving):
        found = small_gicp.align(fixed, moving, max_correspondence_distance=2.0,
                                 num_threads=len(os.sched_getaffinity(0)))
        if not found.converged:
            raise RuntimeError("did not converge")
        return found.T_target_source
    version = getattr(small_gicp, "__version__", "-")
    pairwise.run(__doc__, "small_gicp, GICP", version, align, POINTS)


if __name__ == "__main__":
    main()
