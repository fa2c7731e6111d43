// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <pcl_als/common/attitude_form.h>
#include <pcl_als/io/trajectory_io.h>

#include "csv_table.h"

namespace pcl_als::detail {

/// What a column of a trajectory holds.
enum class TrajectoryQuantity {
  time,
  x,
  y,
  z,
  roll,
  pitch,
  heading,
  quaternion_w,
  quaternion_x,
  quaternion_y,
  quaternion_z,
  latitude,
  longitude,
  geocentric_x,
  geocentric_y,
  geocentric_z,
  orthometric_height,
  week,
  utc_time,
  date,
  sd_east,
  sd_north,
  sd_up,
  sd_roll,
  sd_pitch,
  sd_heading,
  reconstructed,  ///< any value: the trajectory was reconstructed from points
};
constexpr std::size_t kTrajectoryQuantities = 27;

/// A column that was recognised: where it stands, its name in the file, and the factor to internal
/// units (radians for angles, otherwise 1).
struct TrajectoryColumn {
  std::size_t index = CsvTable::npos;
  std::string name;
  double factor = 1.0;
  std::string unit{};  ///< plain, as stated; of a date the order of its parts (ymd)

  bool present() const { return index != CsvTable::npos; }
};

/** \brief The columns of a trajectory, recognised by the names in use.
 *
 * Case, blanks, underscores, hyphens and dots are ignored, so GpsTime, gps_time and "GPS Time" are
 * one name. A unit may follow in brackets or after an underscore: "Roll [deg]", "pitch_rad",
 * "X (m)", or stand in a line below. InputError, naming the columns, where a quantity that is
 * needed is missing (with all accepted names), where two columns match one quantity, and where a
 * unit is not known.
 */
class TrajectoryColumns {
 public:
  /// \a angles: unit of angles that state none.
  TrajectoryColumns(const CsvTable& table, AngleUnit angles, bool projects);

  /// Whether names are those of a header: a time and a place are among them.
  static bool recognise(const std::vector<std::string_view>& names);
  /// Whether a column is a latitude or longitude.
  static bool isGeodetic(std::string_view name);

  const TrajectoryColumn& operator[](TrajectoryQuantity quantity) const {
    return columns_[static_cast<std::size_t>(quantity)];
  }
  TrajectoryCoordinates coordinates() const { return coordinates_; }
  /// Whether heights are above a geoid by their name.
  bool orthometric() const;
  /// The three columns of the place: x, y, z; latitude, longitude, height; or X, Y, Z.
  std::array<TrajectoryQuantity, 3> place() const;
  /// By the names of the columns: roll, pitch and heading, or a quaternion where one of them lacks.
  AttitudeForm attitude() const { return attitude_; }
  bool headingIsTrue() const { return heading_is_true_; }
  /// "columns: time from GpsTime, heading from Azimuth"; empty where all have their plain names.
  std::string describe() const;

 private:
  void assign(const CsvTable& table, std::size_t index, AngleUnit angles);
  bool mayRepeat(std::size_t quantity) const;
  void chooseCoordinates(const CsvTable& table, bool projects);
  void chooseAttitude(const CsvTable& table);
  [[noreturn]] void refuseIncomplete(const CsvTable& table, TrajectoryQuantity missing) const;
  bool has(TrajectoryQuantity quantity) const { return (*this)[quantity].present(); }

  std::array<TrajectoryColumn, kTrajectoryQuantities> columns_;
  TrajectoryCoordinates coordinates_ = TrajectoryCoordinates::map;
  AttitudeForm attitude_ = AttitudeForm::heading;
  bool heading_is_true_ = false;
};

}  // namespace pcl_als::detail
