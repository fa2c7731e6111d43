// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pcl_als {

/// Two groups of control points whose heights contradict each other.
struct ControlGroups {
  double separation = 0.0;                 ///< metres, between the groups' means
  std::vector<std::string> lower, higher;  ///< ids, by the height of the strips above the points

  /// "0.298 m higher above 19 of them (A, B, …) than above the other 18 (C, D, …)"
  std::string describe() const;
};

/** \brief Divides heights of strips above control points into two groups that exclude each other.
 *
 * The split of the sorted heights with the largest separation of two means in standard deviations
 * of the groups. A normal distribution split at its median has means 2.7 standard deviations of the
 * groups apart, a uniform one 3.5; two groups are found from 4.5 on, where the smaller group has a
 * fifth of the points, or two, and the distance is five expected standard deviations. Fewer than
 * six points have none. The data do not show which of the groups is correct.
 *
 * \param heights id and height of the strips above each control point, metres
 * \param expected_std metres: standard deviation of a height, if control were as accurate as stated
 */
std::optional<ControlGroups> controlGroups(std::vector<std::pair<std::string, double>> heights,
                                           double expected_std);

}  // namespace pcl_als
