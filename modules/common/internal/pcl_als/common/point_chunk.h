// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_als/common/lidar_return.h>

namespace pcl_als {

/// Points as columns: ground frame in metres and double, one entry per point in each.
struct PointChunk {
  std::vector<double> x, y, z, gps_time;
  std::vector<float> intensity, scan_angle;
  std::vector<std::uint16_t> point_source_id;
  std::vector<std::uint8_t> return_number, number_of_returns, classification,
      flags;  ///< PointFlag
  std::vector<std::uint8_t> user_data;
  /// Of the scanner, from the field that the reader was given (PointWindow::channel_field); 0 where
  /// none is recorded. Writers do not use it.
  std::vector<std::uint8_t> channel;
  /// Values of PointWindow::extra_field, NaN where they are not recorded; empty where no such field
  /// is read. Writers do not use it.
  std::vector<double> extra{};

  std::size_t size() const { return x.size(); }
  void resize(std::size_t count);
  /// The points of these rows, in this order.
  PointChunk select(const std::vector<std::size_t>& rows) const;
  /// The point of a row. \a time: of the trajectory, seconds.
  LidarReturn point(std::size_t row, double time) const;
};

}  // namespace pcl_als
