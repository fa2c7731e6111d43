// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// A return near a target.
struct TargetPoint {
  Eigen::Vector2d place;  ///< metres, ground frame
  double intensity = 0.0;
};

/// Where a circular target is searched for.
struct TargetSearch {
  Eigen::Vector2d centre;  ///< expected, metres, ground frame
  double radius = 1.0;     ///< of the target, metres
  double window = 2.0;     ///< largest difference from the expected centre, each coordinate, metres
  double noise = 0.02;     ///< standard deviation of the coordinates of returns, metres
  double blur = 0.05;      ///< standard deviation of a return's place in its footprint, metres
};

enum class TargetStatus : std::int8_t {
  located,
  too_few_points,
  no_contrast,  ///< the intensities do not show a target of this size
  ambiguous,    ///< several places are possible, or a large region is
  at_edge,      ///< the target may lie outside of the window
};

/// The reason why a target was not located, for messages: "its contrast is not significant".
std::string_view reasonOf(TargetStatus status);

struct TargetLocation {
  TargetStatus status = TargetStatus::too_few_points;
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();      ///< mean of the posterior, metres
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of the posterior, m^2
  double contrast = 0.0;     ///< difference of the two levels over the noise of an intensity
  double blur = 0.0;         ///< standard deviation of the edge, metres
  double on_target = 0.0;    ///< number of returns on the target
  std::vector<int> certain;  ///< returns that lie on the target with high probability

  bool located() const { return status == TargetStatus::located; }
};

/** \brief Locates a circular target by its contrast of intensity.
 *
 * The intensity of a return at the distance d from the centre is b + D h((R - d) / s) with unknown
 * levels, the normal distribution function h and the blur s of the edge, and noise whose variance
 * is larger at the edge, by a factor of 1 + 4 k^2 h (1 - h): the places of returns have errors too.
 * Levels and noise are integrated out in closed form, blur and k over a few values, and the
 * posterior of the centre is evaluated on a grid that is refined where it is not negligible. Its
 * mean and covariance are valid for few returns as well, where it is nearly uniform within a
 * region. Two errors that the likelihood does not contain are added to the covariance: those of the
 * coordinates of the returns at the edge, and of ground whose brightness varies slowly along it.
 *
 * The target may be brighter or darker than the ground. It is located a second time with the ground
 * next to it alone, because brightness varies.
 */
TargetLocation locateTarget(const std::vector<TargetPoint>& points, const TargetSearch& search);

}  // namespace pcl_als
