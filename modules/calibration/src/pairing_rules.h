// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// \file What AreaMatcher does with points that were flown and SyntheticPairs with those that were
/// not.

/// Standard deviations of a tilt from which on it is one: on less, pairs measure vertically.
constexpr double kSignificantTilt = 5.0;

constexpr int kAspects = 8;
constexpr std::array<double, 3> kSlopeSteps{0.087, 0.26, 0.52};  // radians: 5, 15, 30 degrees
constexpr std::size_t kOrientationClasses = 1 + kSlopeSteps.size() * kAspects;

/// Class of a surface's orientation: 0 for flat, then slope step times aspect.
inline std::size_t orientationClass(const Eigen::Vector3d& normal) {
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

/// How much of each class to take so that classes are as even as their sizes allow and the sum is
/// at most \a total.
template <typename Amount>
std::vector<Amount> evenShares(const std::vector<Amount>& sizes, Amount total) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  std::vector<Amount> shares(sizes.size(), Amount{0});
  for (std::size_t i = 0; i < order.size(); ++i) {
    shares[order[i]] = std::min(sizes[order[i]], total / static_cast<Amount>(order.size() - i));
    total -= shares[order[i]];
  }
  return shares;
}

/// Points of a strip in an area that look for patches, of \a all in a block where strips and areas
/// meet \a meetings times.
template <typename Amount>
Amount candidatesPerStrip(Amount all, Amount meetings) {
  constexpr Amount kFewest = 150, kMost = 2000;
  return std::clamp(all / meetings, kFewest, kMost);
}

/// Effect on the normal distance of the pulse's stretch over the footprint, n'u range divergence
/// tan(incidence), with \a beam = u the unit vector of the pulse.
inline double stretchEffect(double range, const Eigen::Vector3d& beam,
                            const Eigen::Vector3d& normal, double divergence) {
  const double cosine = normal.dot(beam);
  return -range * divergence * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

}  // namespace pcl_als
