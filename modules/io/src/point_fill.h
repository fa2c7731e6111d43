// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/point_types.h>
#include <pcl_als/io/point_reader.h>

namespace pcl_als::detail {

/// One row of a chunk as a point relative to \a origin.
inline PointLidar pointOf(const PointChunk& chunk, std::size_t row, const Eigen::Vector3d& origin) {
  PointLidar point(static_cast<float>(chunk.x[row] - origin.x()),
                   static_cast<float>(chunk.y[row] - origin.y()),
                   static_cast<float>(chunk.z[row] - origin.z()));
  point.gps_time = chunk.gps_time[row];
  point.intensity = chunk.intensity[row];
  point.scan_angle = chunk.scan_angle[row];
  point.point_source_id = chunk.point_source_id[row];
  point.return_number = chunk.return_number[row];
  point.number_of_returns = chunk.number_of_returns[row];
  point.classification = chunk.classification[row];
  point.flags = chunk.flags[row];
  point.user_data = chunk.user_data[row];
  return point;
}

}  // namespace pcl_als::detail
