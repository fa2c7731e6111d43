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

/// readTrajectoryFile() of trajectory_io.h with the two settings that most callers need: the CRS of
/// the points (needed for geographic coordinates) and the unit of map coordinates.
TrajectoryFile readTrajectoryFile(const std::filesystem::path& path, const std::string& crs = {},
                                  const LengthUnit& unit = {});

/// The samples of readTrajectoryFile().
std::vector<TrajectorySample> readTrajectory(const std::filesystem::path& path,
                                             const std::string& crs = {},
                                             const LengthUnit& unit = {});

/// Reads control points: CSV id,x,y,z[,sigma], lengths in \a unit, columns found by name. Further
/// columns describe planar patches (nx,ny,nz,extent) and targets (diameter,sigma_plan), see
/// ControlPoint. InputError names file, line and column.
std::vector<ControlPoint> readControl(const std::filesystem::path& path,
                                      const LengthUnit& unit = {});

/// Reads targets of known reflectance: CSV x,y,reflectance[,id][,sigma], coordinates in \a unit,
/// columns found by name. A target without an id is named by its number. InputError names file,
/// line and column.
std::vector<ReferenceTarget> readReferenceTargets(const std::filesystem::path& path,
                                                  const LengthUnit& unit = {});

/// Reads the gain of a receiver as a function of the AGC value: CSV value,gain (gain > 0). The
/// result is sorted by value. InputError names file, line and column, or a repeated value.
std::vector<GainStep> readGainSteps(const std::filesystem::path& path);

/// Writes and reads calibration.json, in which angles are in arc-seconds. The format is described
/// on the page of module io; share/schema has its JSON Schema. InputError names file and field.
void writeCalibration(const std::filesystem::path& path, const CalibrationResult& result);
CalibrationResult readCalibration(const std::filesystem::path& path);

}  // namespace pcl_als
