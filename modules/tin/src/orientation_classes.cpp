// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/tin/orientation_classes.h>

namespace pcl_als {

std::size_t OrientationClasses::of(const Eigen::Vector3d& normal) {
  constexpr double kPi = 3.14159265358979323846;
  const double slope = std::atan2(std::hypot(normal.x(), normal.y()), normal.z());
  if (slope < kSlopeSteps[0]) return 0;
  const int step = slope < kSlopeSteps[1] ? 0 : slope < kSlopeSteps[2] ? 1 : 2;
  // Coordinates are multiples of a step, so directions along the axes and diagonals are common:
  // borders between classes lie aside, or rounding would decide.
  constexpr double kAside = 0.1234;
  const double turn =
      std::fmod(std::atan2(normal.y(), normal.x()) + 3.0 * kPi + kAside, 2.0 * kPi) / (2.0 * kPi);
  return static_cast<std::size_t>(1 + step * kAspects +
                                  std::min(kAspects - 1, static_cast<int>(turn * kAspects)));
}

std::vector<std::size_t> OrientationClasses::evenShares(const std::vector<std::size_t>& available,
                                                        std::size_t total) {
  std::vector<std::size_t> order(available.size()), shares(available.size(), 0);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return available[a] < available[b]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    shares[order[i]] = std::min(available[order[i]], total / (order.size() - i));
    total -= shares[order[i]];
  }
  return shares;
}

}  // namespace pcl_als
