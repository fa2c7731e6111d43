// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/path_evidence.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::detail {

/// What the rays through several returns of a pulse say of a trajectory: the vector from it to
/// where the points were measured from.
struct RayOffset {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< metres, east, north, up
  double std = 0.0;                                  ///< metres, along the offset
  double height = 0.0;  ///< metres, of the trajectory above the lower returns, mean
  Eigen::Vector2d course = Eigen::Vector2d::Zero();  ///< unit
  double along = 0.0;                                ///< metres, of the offset along the course
  double speed = 0.0;                                ///< metres per second

  /// Whether the offset is significant and larger than lever arms and a share of the height.
  bool exceeds(double share) const;
  /// The likely cause, and what can be stated about it; empty where none is known.
  Warning cause() const;
};

/// Of the rays of a strip; none where they are too few or do not determine all directions.
std::optional<RayOffset> rayOffset(const PathEvidence& evidence, const Trajectory& flight);

}  // namespace pcl_als::detail
