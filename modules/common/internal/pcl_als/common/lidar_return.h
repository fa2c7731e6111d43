// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// Bits of PointLidar::flags, as LAS 1.4 names them; bits 6 and 7 hold the scanner channel.
enum PointFlag : std::uint8_t {
  kSynthetic = 1,
  kKeyPoint = 2,
  kWithheld = 4,
  kOverlap = 8,
  kScanDirection = 16,
  kEdgeOfFlightLine = 32,
};

/// A return of a pulse as the jobs process it: position in double, in the ground frame. 48 bytes.
struct LidarReturn {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres
  double time = 0.0;       ///< seconds, in the time system of the trajectory; 0 when there is none
  float intensity = 0.0F;  ///< digital number
  /// As recorded, degrees; NaN: none
  float scan_angle = std::numeric_limits<float>::quiet_NaN();
  std::uint8_t return_number = 1;
  std::uint8_t number_of_returns = 1;
  std::uint8_t classification = 0;  ///< ASPRS code
  std::uint8_t flags = 0;           ///< PointFlag
  std::uint8_t channel = 0;         ///< of the scanner; 0 where none is recorded
  std::uint8_t user_data = 0;       ///< as recorded; its meaning is that of the software before

  bool isSingle() const { return number_of_returns <= 1; }
  bool isLast() const { return return_number >= number_of_returns; }
  bool isWithheld() const { return (flags & kWithheld) != 0; }
  bool isNoise() const { return classification == 7 || classification == 18; }
  bool isVegetation() const { return classification >= 3 && classification <= 5; }
};

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
