// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

namespace pcl_als {

// Rules that measured pairs (AreaMatcher) and synthetic pairs of planned lines (SyntheticPairs of
// module planning) have in common.

/// Tilt over its standard deviation above which it is significant; below, distances are vertical.
constexpr double kSignificantTilt = 5.0;

/// Candidates of a strip in an area, for \a all candidates of a block and the number of
/// combinations of strip and area.
template <typename Amount>
Amount candidatesPerStrip(Amount all, Amount strips_in_areas) {
  constexpr Amount kFewest = 150;
  return std::max(all / strips_in_areas, kFewest);
}

/// Effect of the stretch of the pulse over the footprint on the normal distance, n'u range
/// divergence tan(incidence), with \a beam = u the unit vector of the pulse.
inline double stretchEffect(double range, const Eigen::Vector3d& beam,
                            const Eigen::Vector3d& normal, double divergence) {
  const double cosine = normal.dot(beam);
  return -range * divergence * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

}  // namespace pcl_als
