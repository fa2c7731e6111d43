// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_als {

/// A point and the patch it is to be brought to.
struct PointOnPatch {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;               ///< of the patch, unit
  double signed_normal_distance = 0.0;  ///< normal . (point - patch), metres
};

/** \brief The rigid motion, one step, that brings points closest to their patches' planes: robust
 * least squares of the normal distances. Directions that no patch fixes to 10 m are left alone;
 * identity for fewer than six points.
 */
Eigen::Affine3d patchMotion(const std::vector<PointOnPatch>& points);

}  // namespace pcl_als
