// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <utility>

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
  constexpr double kTieBreakingOffset = 0.1234;  // radians
  static const double kCos = -std::cos(kTieBreakingOffset), kSin = -std::sin(kTieBreakingOffset);
  double x = kCos * normal.x() - kSin * normal.y(), y = kSin * normal.x() + kCos * normal.y();
  std::size_t aspect = 0;  // eighth of a turn
  if (y < 0.0) {
    aspect += 4;
    x = -x;
    y = -y;
  }
  if (x <= 0.0) {
    aspect += 2;
    std::swap(x, y);
    y = -y;
  }
  if (y >= x) ++aspect;
  return 1 + static_cast<std::size_t>(step) * kAspects + aspect;
}

}  // namespace pcl_als
