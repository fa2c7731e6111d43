// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/io/trajectory_io.h>

namespace pcl_als {

/// readTrajectoryFile() of trajectory_io.h with the two things that most callers state: the CRS of
/// the points and the unit of map coordinates.
TrajectoryFile readTrajectoryFile(const std::filesystem::path& path, const std::string& crs = {},
                                  const LengthUnit& unit = {});

/// The samples of readTrajectoryFile().
std::vector<TrajectorySample> readTrajectory(const std::filesystem::path& path,
                                             const std::string& crs = {},
                                             const LengthUnit& unit = {});

/// Reads control points: CSV id,x,y,z[,sigma], columns found by name, all four in \a unit.
/// InputError names file, line and column.
std::vector<ControlPoint> readControl(const std::filesystem::path& path,
                                      const LengthUnit& unit = {});

/// Reads places of known reflectance: CSV x,y,reflectance[,id][,sigma], columns found by name; a
/// target without an id is called by its number; places in \a unit. InputError names file, line and
/// column.
std::vector<ReferenceTarget> readReferenceTargets(const std::filesystem::path& path,
                                                  const LengthUnit& unit = {});

/// Reads the gain of a receiver by the value of its gain control: CSV value,gain (gain > 0), sorted
/// by value. InputError names file, line and column, or a value that comes twice.
std::vector<GainStep> readGainSteps(const std::filesystem::path& path);

/// Writes / reads calibration.json (its schema is in the module's README). Angles are arc-seconds
/// in the file.
void writeCalibration(const std::filesystem::path& path, const CalibrationResult& result);
CalibrationResult readCalibration(const std::filesystem::path& path);

}  // namespace pcl_als
