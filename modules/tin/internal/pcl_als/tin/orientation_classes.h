// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
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
};

/// Number to take of each class, given the size of each (points, or areas): as even as possible, \a
/// total at most.
template <typename Amount>
std::vector<Amount> evenShares(const std::vector<Amount>& available, Amount total) {
  std::vector<std::size_t> order(available.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return available[a] < available[b]; });
  std::vector<Amount> shares(available.size(), Amount{0});
  for (std::size_t i = 0; i < order.size(); ++i) {
    shares[order[i]] = std::min(available[order[i]], total / static_cast<Amount>(order.size() - i));
    total -= shares[order[i]];
  }
  return shares;
}

/// At most \a total members, as evenly over the classes as possible, evenly within each class.
template <typename T>
std::vector<T> chosenEvenly(const std::vector<std::vector<T>>& classes, std::size_t total) {
  std::vector<std::size_t> sizes;
  sizes.reserve(classes.size());
  for (const std::vector<T>& members : classes) sizes.push_back(members.size());
  const std::vector<std::size_t> shares = evenShares(sizes, total);
  std::vector<T> chosen;
  for (std::size_t c = 0; c < classes.size(); ++c) {
    for (std::size_t k = 0; k < shares[c]; ++k)
      chosen.push_back(classes[c][k * sizes[c] / shares[c]]);
  }
  return chosen;
}

}  // namespace pcl_als
