// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/linear_units.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// What to do with roll, pitch and heading of a trajectory file.
enum class AttitudeUse {
  where_given,  ///< use them where every sample has them
  needed,       ///< refuse a file without them
  ignore,       ///< positions only
  nominal,      ///< a level sensor whose heading is the course
};

struct FlightFileOptions {
  std::string crs;                   ///< of the points; for an SBET, which is in degrees
  LengthUnit unit;                   ///< of the coordinates of a CSV; default metre
  double line_fit_half_width = 0.0;  ///< seconds; 0: Trajectory's default
  AttitudeUse attitude = AttitudeUse::where_given;
};

/// How to read the flight that a calibration is applied with (and SystemCorrection is given).
FlightFileOptions flightFileOptions(const CalibrationResult& calibration);

struct FlightFile {
  std::shared_ptr<const Trajectory> trajectory;
  std::vector<std::string> remarks;  ///< columns, angles and repairs that a user should know of
};

/// Reads a trajectory (.csv, SBET .out/.sbet). A column named yaw is clockwise from north or
/// counter-clockwise from east: the course decides. InputError naming the file.
FlightFile readFlight(const std::filesystem::path& path, const FlightFileOptions& options = {});

}  // namespace pcl_als
