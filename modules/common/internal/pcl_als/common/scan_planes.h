// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// Unit normals of the planes in which a scanner deflects its pulses, in the body frame
/// (right-forward-up), pointing forward: of a scanner with several planes (looks ahead and back,
/// crossing lines). Empty: one plane, across the body.
using ScanPlanes = std::vector<Eigen::Vector3d>;

/// The normal of the plane that contains a pulse. Planes that intersect in the pulse give the same
/// scan angle.
inline Eigen::Vector3d scanPlaneOf(const ScanPlanes& planes, const Eigen::Vector3d& in_body) {
  Eigen::Vector3d nearest = Eigen::Vector3d::UnitY();
  double least = -1.0;
  for (const Eigen::Vector3d& normal : planes) {
    const double off = std::abs(normal.dot(in_body));
    if (least >= 0.0 && off >= least) continue;
    least = off;
    nearest = normal;
  }
  return nearest;
}

}  // namespace pcl_als
