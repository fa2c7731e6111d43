// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Geometry>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/point_file_info.h>

namespace pcl_als {

/// The box of the rows [from, to) of a chunk.
Eigen::AlignedBox3d boxOf(const PointChunk& chunk, std::size_t from, std::size_t to);

/// Whether the header states a box that contains \a points, up to a step of the coordinates.
bool headerBoxContains(const PointFileInfo& info, const Eigen::AlignedBox3d& points);

/// Whether the header states the box of all points of the file, up to a step of the coordinates,
/// because writers round differently. An empty box is stated by every header.
bool headerBoxIsRight(const PointFileInfo& info, const Eigen::AlignedBox3d& points);

/// "the header's bounding box is wrong: it says (…) to (…), the points reach from (…) to (…)";
/// empty where it is right.
std::string headerBoxRemark(const PointFileInfo& info, const Eigen::AlignedBox3d& points);

}  // namespace pcl_als
