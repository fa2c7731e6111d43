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

/// Use of roll, pitch and heading of a trajectory file.
enum class AttitudeUse {
  where_given,  ///< use them where every sample has them
  needed,       ///< refuse a file without them
  ignore,       ///< positions only
  nominal,      ///< a level sensor whose heading is the course
};

struct FlightFileOptions {
  std::string crs;  ///< of the points; for an SBET, which has geographic coordinates
  LengthUnit unit;  ///< of the coordinates of a CSV; default metre
  double line_fit_half_width = 0.0;  ///< seconds; 0: Trajectory's default
  AttitudeUse attitude = AttitudeUse::where_given;
};

/// Options for reading the flight for a calibration that is applied (by SystemCorrection).
FlightFileOptions flightFileOptions(const CalibrationResult& calibration);

struct FlightFile {
  std::shared_ptr<const Trajectory> trajectory;
  std::vector<std::string> remarks;  ///< remarks for the user on columns, angles and repairs
};

/// Reads a trajectory (.csv, SBET .out/.sbet). Whether a column named yaw is clockwise from north
/// or counter-clockwise from east is determined from the course. InputError naming the file.
FlightFile readFlight(const std::filesystem::path& path, const FlightFileOptions& options = {});

}  // namespace pcl_als
