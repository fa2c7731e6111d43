// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Classes of a surface's orientation, for choosing points evenly over slopes and aspects.
 *
 * Class 0 is flat (under 5 degrees); then eight aspects for each of the slopes 5 to 15, 15 to 30
 * and over 30 degrees.
 */
struct OrientationClasses {
  static constexpr std::array<double, 3> kSlopeSteps{0.087, 0.26, 0.52};  ///< radians
  static constexpr int kAspects = 8;
  static constexpr std::size_t kCount = 1 + kSlopeSteps.size() * kAspects;

  /// The class of an upward normal (any length).
  static std::size_t of(const Eigen::Vector3d& normal);

  /// How many to take of each class, given how many there are: as even as they allow, \a total at
  /// most.
  static std::vector<std::size_t> evenShares(const std::vector<std::size_t>& available,
                                             std::size_t total);
};

}  // namespace pcl_als
