// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <vector>

#include "csv_table.h"

namespace pcl_als::detail {

/// What a column of a trajectory holds.
enum class TrajectoryQuantity { time, x, y, z, roll, pitch, heading };
constexpr std::size_t kTrajectoryQuantities = 7;

/// A column that was recognised: where it stands, its name in the file, and the factor to internal
/// units (radians for angles, otherwise 1).
struct TrajectoryColumn {
  std::size_t index = CsvTable::npos;
  std::string name;
  double factor = 1.0;

  bool present() const { return index != CsvTable::npos; }
};

/** \brief The columns of a trajectory, recognised by the names in use.
 *
 * Case, blanks, underscores, hyphens and dots are ignored, so GpsTime, gps_time and "GPS Time" are
 * one name. A unit may follow in brackets or after an underscore: "Roll [deg]", "pitch_rad",
 * "X (m)". InputError, naming the columns, where a quantity that is needed is missing (with all
 * accepted names), where two columns match one quantity, and where a unit is not m, s, deg or rad.
 */
class TrajectoryColumns {
 public:
  explicit TrajectoryColumns(const CsvTable& table);

  const TrajectoryColumn& operator[](TrajectoryQuantity quantity) const {
    return columns_[static_cast<std::size_t>(quantity)];
  }
  /// Whether the heading's column is called yaw, which some write counter-clockwise from east.
  bool headingIsYaw() const { return heading_is_yaw_; }
  /// "columns: time from GpsTime, heading from Azimuth"; empty where all have their plain names.
  std::string describe() const;

 private:
  void assign(const CsvTable& table, std::size_t index);
  void checkComplete(const CsvTable& table) const;

  std::array<TrajectoryColumn, kTrajectoryQuantities> columns_;
  bool heading_is_yaw_ = false;
};

}  // namespace pcl_als::detail
