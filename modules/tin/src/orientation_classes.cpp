// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/tin/orientation_classes.h>

namespace pcl_als {

std::size_t OrientationClasses::of(const Eigen::Vector3d& normal) {
  // Tangents of the steps, squared: most of a strip is flat and needs no angle.
  static const std::array<double, 3> kTangents{std::tan(kSlopeSteps[0]), std::tan(kSlopeSteps[1]),
                                               std::tan(kSlopeSteps[2])};
  const double rise = normal.x() * normal.x() + normal.y() * normal.y();
  const auto steeper = [&](int step) {
    return normal.z() <= 0.0 || rise >= kTangents[step] * kTangents[step] * normal.z() * normal.z();
  };
  if (!steeper(0)) return 0;
  const int step = !steeper(1) ? 0 : !steeper(2) ? 1 : 2;
  // Coordinates are multiples of a step, so directions along the axes and diagonals are common:
  // borders between classes lie aside, or rounding would decide.
  constexpr double kTieBreakingOffset = 0.1234;
  const double turn =
      std::fmod(std::atan2(normal.y(), normal.x()) + 3.0 * kPi + kTieBreakingOffset, 2.0 * kPi) /
      (2.0 * kPi);
  return static_cast<std::size_t>(1 + step * kAspects +
                                  std::min(kAspects - 1, static_cast<int>(turn * kAspects)));
}

}  // namespace pcl_als
