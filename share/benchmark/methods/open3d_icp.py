#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026, the pcl_als authors
"""Open3D, pair by pair: point-to-plane ICP, correspondences to 2 m and then to 0.5 m.

Install: the Python package `open3d`, http://www.open3d.org (MIT), Debian's python3-open3d. It must
be found by `import open3d`.
"""
import adapter
import pairwise

POINTS, NEIGHBOURS, ITERATIONS = 100_000, 20, 50


def main():
    try:
        import open3d
    except ImportError as error:
        adapter.missing(f"Open3D is not installed ({error}): see methods/open3d_icp.py")
    icp = open3d.pipelines.registration

    def cloud(points):
        return open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))

    def align(fixed, moving):
        target, source = cloud(fixed), cloud(moving)
        target.estimate_normals(open3d.geometry.KDTreeSearchParamKNN(NEIGHBOURS))
        motion = pairwise.numpy.eye(4)
        for distance in (2.0, 0.5):
            motion = icp.registration_icp(
                source, target, distance, motion, icp.TransformationEstimationPointToPlane(),
                icp.ICPConvergenceCriteria(max_iteration=ITERATIONS)).transformation
        return motion
    pairwise.run(__doc__, "Open3D, point-to-plane ICP", open3d.__version__, align, POINTS)


if __name__ == "__main__":
    main()
