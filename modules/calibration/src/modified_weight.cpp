// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "modified_weight.h"

#include <cmath>

#include <Eigen/Geometry>

namespace pcl_als {

Eigen::Matrix3d patchRotation(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d helper = std::abs(normal.x()) < 0.7
                                     ? Eigen::Vector3d(Eigen::Vector3d::UnitX())
                                     : Eigen::Vector3d(Eigen::Vector3d::UnitY());
  Eigen::Matrix3d rotation;
  rotation.row(2) = normal;
  rotation.row(0) = helper.cross(normal).normalized();
  rotation.row(1) = normal.cross(rotation.row(0));
  return rotation;
}

Eigen::Matrix3d modifiedWeight(const Eigen::Matrix3d& weight, const Eigen::Vector3d& normal) {
  const Eigen::Matrix3d rotation = patchRotation(normal);
  const Eigen::Matrix3d in_patch = rotation * weight * rotation.transpose();
  Eigen::Matrix3d kept = Eigen::Matrix3d::Zero();
  kept(2, 2) = in_patch(2, 2);
  return rotation.transpose() * kept * rotation;
}

}  // namespace pcl_als
