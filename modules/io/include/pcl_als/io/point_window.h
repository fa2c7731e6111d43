// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/common/point_chunk.h>
#include <pcl_als/common/point_file_info.h>

namespace pcl_als {

/// The part of point files that is read.
struct PointWindow {
  /// Rectangle in plan, ground frame, metres; points on its edges are inside. Default: all points.
  std::optional<Eigen::AlignedBox2d> bounds;

  bool everything() const { return !bounds; }
};

/// Keeps the points inside; the others are removed.
void keepInside(const Eigen::AlignedBox2d& bounds, PointChunk& chunk);

/// Properties of a file as far as it is read: box and number of points (estimated from the area)
/// are those within the bounds.
PointFileInfo within(const PointWindow& window, PointFileInfo info);

}  // namespace pcl_als
