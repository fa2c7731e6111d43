// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als::registration {

/// A point of one cloud and its conjugate patch in the other: one equation.
struct PatchPair {
  Eigen::Vector3d normal;    ///< unit, in the target's frame
  Eigen::Vector3d position;  ///< of the source's side (point or foot), moved, working coordinates
  double distance;           ///< normal . (source's side - target's side), metres
  double start_distance;     ///< the same before the source was moved
  double variance;           ///< of the distance, in units of sigma0^2
  std::uint32_t group;       ///< of the jackknife
  bool source_point;         ///< a point of the source in a patch of the target, or the reverse
};
using PatchPairs = std::vector<PatchPair>;

}  // namespace pcl_als::registration
