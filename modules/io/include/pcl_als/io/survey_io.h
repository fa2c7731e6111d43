// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// A trajectory as a file holds it.
struct TrajectoryFile {
  std::vector<TrajectorySample> samples;  ///< in the order of the file
  /// The heading's column is called yaw. Some write yaw counter-clockwise from east; the samples
  /// hold it as a heading, clockwise from north, until the course shows otherwise.
  bool heading_is_yaw = false;
  /// "columns: time from GpsTime, heading from Azimuth"; empty where all have their plain names.
  std::string columns;
};

/** \brief Reads a trajectory: CSV or Applanix SBET (.out, .sbet).
 *
 * CSV: a header line and the columns time,x,y,z[,roll,pitch,heading] in any order, separator , ;
 * tab or blanks; seconds, metres, degrees. Columns are found by the names in use (GpsTime, Easting,
 * Height, Azimuth, ...; the module's README lists them) in any case; angles in radians where the
 * name contains the unit ("roll_rad"). SBET: projected to \a crs with PROJ, meridian convergence
 * applied to the heading = platform heading - wander angle.
 *
 * InputError names file, line (or record) and column. SBET without \a crs is a UsageError that
 * names the option.
 *
 * \param unit that the coordinates of a CSV count in; samples are in metres. An SBET is brought to
 * metres from the unit of \a crs
 */
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
