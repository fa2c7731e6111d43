// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_als {

/// A point and a patch that are to coincide.
struct PointOnPatch {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;               ///< of the patch, unit
  double signed_normal_distance = 0.0;  ///< normal . (point - patch), metres
};

/** \brief One step of the rigid motion that minimises the distances of points from the planes of
 * their patches: robust least squares of the normal distances. Directions in which no patch
 * determines the motion to 10 m are left unchanged; identity for fewer than six points.
 */
Eigen::Affine3d patchMotion(const std::vector<PointOnPatch>& points);

}  // namespace pcl_als
