// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace pcl_als {

/// \file What AreaMatcher does with points that were flown and SyntheticPairs with those that were
/// not.

/// Standard deviations of a tilt from which on it is one: on less, pairs measure vertically.
constexpr double kSignificantTilt = 5.0;

/// Candidates of a strip in an area, of \a all in a block with \a meetings combinations of strip
/// and area.
template <typename Amount>
Amount candidatesPerStrip(Amount all, Amount meetings) {
  constexpr Amount kFewest = 150;
  return std::max(all / meetings, kFewest);
}

/// Effect on the normal distance of the pulse's stretch over the footprint, n'u range divergence
/// tan(incidence), with \a beam = u the unit vector of the pulse.
inline double stretchEffect(double range, const Eigen::Vector3d& beam,
                            const Eigen::Vector3d& normal, double divergence) {
  const double cosine = normal.dot(beam);
  return -range * divergence * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

}  // namespace pcl_als
