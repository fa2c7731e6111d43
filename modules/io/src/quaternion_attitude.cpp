// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "quaternion_attitude.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/attitude_form.h>

namespace pcl_als::detail {

std::optional<Eigen::Vector3d> anglesOfQuaternion(const Eigen::Vector4d& wxyz) {
  const double norm = wxyz.norm();
  if (!(std::abs(norm - 1.0) <= kQuaternionTolerance)) return std::nullopt;
  const double w = wxyz[0] / norm, x = wxyz[1] / norm, y = wxyz[2] / norm, z = wxyz[3] / norm;
  // Elements of R: its third row is (-sin pitch, cos pitch sin roll, cos pitch cos roll), its first
  // column (cos pitch cos yaw, cos pitch sin yaw, -sin pitch).
  const double roll = std::atan2(2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y));
  const double pitch = std::asin(std::clamp(2.0 * (w * y - x * z), -1.0, 1.0));
  const double yaw = std::atan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z));
  return Eigen::Vector3d(roll, pitch, wholeTurn(yaw));
}

}  // namespace pcl_als::detail
