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

/// Candidates of a strip in an area, for \a all candidates of a block, the number of combinations
/// of strip and area, and that of two strips and area in both directions. Where many strips overlap
/// each other they are fewer, so that a block has about six pairs for each of \a all, but a strip
/// has some 300 pairs in an area where it has 40 to 150 candidates.
template <typename Amount>
Amount candidatesPerStrip(Amount all, Amount strips_in_areas, Amount pairs_in_areas) {
  constexpr Amount kPairs = 6, kFewestPairs = 300, kFewest = 40, kEnough = 150;
  const Amount pairs = std::max<Amount>(1, pairs_in_areas);
  const Amount fewest =
      std::clamp<Amount>(kFewestPairs * strips_in_areas / pairs, kFewest, kEnough);
  return std::max(std::min(all / strips_in_areas, kPairs * all / pairs), fewest);
}

/// Effect of the stretch of the pulse over the footprint on the normal distance, n'u range
/// divergence tan(incidence), with \a beam = u the unit vector of the pulse.
inline double stretchEffect(double range, const Eigen::Vector3d& beam,
                            const Eigen::Vector3d& normal, double divergence) {
  const double cosine = normal.dot(beam);
  return -range * divergence * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

}  // namespace pcl_als
