// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "matched_block.h"

namespace pcl_als::bench {

/// The rigid body movement that brings one strip onto another: what is left between them.
struct Discrepancy {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();     ///< metres: east, north, up
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< radians about the same axes
  std::size_t points = 0;
};

/** \brief Discrepancy of two strips as the areas of a block show it, points of \a a against the
 * patches of \a b: three shifts and three small rotations about the centroid of the points, least
 * squares of the normal distances, robust, paired anew until it rests.
 */
Discrepancy discrepancyOf(const MatchedBlock& block, int a, int b);

}  // namespace pcl_als::bench
