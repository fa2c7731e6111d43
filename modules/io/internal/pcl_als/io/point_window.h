// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/point_file_info.h>

namespace pcl_als {

/// The part of point files that is read, and how.
struct PointWindow {
  /// Rectangle in plan, ground frame, metres; points on its edges are inside. Default: all points.
  std::optional<Eigen::AlignedBox2d> bounds;
  /// Distance between points that suffices, metres: of COPC files only the levels of the octree up
  /// to the first one with this spacing are read, other files are refused; 0: all points.
  double resolution = 0.0;
  /// Read what is intact of damaged or truncated .las and .laz files (PointReader::damage()).
  bool keep_readable = false;
  /// Field with the channel of the scanner (PointChunk::channel): "user_data" or the name of an
  /// extra-bytes field (of a PCD: of any field); empty or "scanner_channel": that of point formats
  /// 6-10, which a PCD has in its flags.
  std::string channel_field;
  /// Extra-bytes field of .las and .laz whose values are PointChunk::extra; empty: none.
  std::string extra_field;
  /// Columns of .xyz files in their order ("skip": not used); empty: as their header names them.
  std::vector<std::string> columns;

  /// Whether all points are read and damaged files are refused.
  bool everything() const { return !bounds && !(resolution > 0.0) && !keep_readable; }
};

/// "the points at x 84900 to 84950 m, y 447500 to 447600 m", "…, 2 m apart".
std::string describe(const PointWindow& window);

/// Ends a job where no file has a point in the window: InputError that states what the first one
/// covers.
[[noreturn]] void refuseEmptyWindow(const std::vector<std::filesystem::path>& files,
                                    const PointWindow& window);

/// Keeps the points inside; the others are removed.
void keepInside(const Eigen::AlignedBox2d& bounds, PointChunk& chunk);

/// Properties of a file as far as it is read: box and number of points (estimated from the area)
/// are those within the bounds.
PointFileInfo within(const PointWindow& window, PointFileInfo info);

}  // namespace pcl_als
