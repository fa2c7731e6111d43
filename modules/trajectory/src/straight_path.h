// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/trajectory/path_evidence.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

namespace pcl_als::detail {

/** \brief A straight line at constant speed through the rays of a pass.
 *
 * Least absolute deviations, so that rays which miss it hardly affect it. It is what a path with
 * more freedom is compared with: over a few seconds no aircraft leaves it by more than some metres.
 */
struct StraightPath {
  double time = 0.0;                                   ///< seconds, of the position
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, ground frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< metres per second
  Eigen::Matrix<double, 6, 6> covariance;              ///< of position and velocity
  double height = 0.0;                                 ///< metres above the lower returns, mean
  double fitting = 0.0;                                ///< share of the rays that pass through it
  std::size_t rays = 0;

  /// The position at a time, with the uncertainty of a bend since the middle.
  PathSample at(double time) const;
};

/// Of the rays at some times; none where they do not determine a line.
std::optional<StraightPath> straightPath(const PathEvidence& evidence, const TimeRange& span);

}  // namespace pcl_als::detail
