// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/time_alignment.h>

namespace pcl_als {

/// Standard deviations of a trajectory at a time; NaN where a file does not state one.
struct TrajectoryAccuracy {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double time = 0.0;                                               ///< seconds
  Eigen::Vector3d position = Eigen::Vector3d::Constant(kUnknown);  ///< east, north, up, metres
  Eigen::Vector3d angles = Eigen::Vector3d::Constant(kUnknown);    ///< roll, pitch, heading, rad
};

/// What the coordinates of a trajectory file are.
enum class TrajectoryCoordinates {
  map,         ///< easting, northing, height
  geographic,  ///< latitude, longitude, height
  geocentric,  ///< X, Y, Z from the centre of the Earth
};

/// Unit of angles whose column states none.
enum class AngleUnit { stated, degrees, radians, gon };

/// Meaning of roll, pitch and heading.
enum class AttitudeAxes {
  by_course,  ///< ned; of a yaw or a quaternion those under which the heading follows the course
  ned,        ///< roll right wing down, pitch nose up, heading clockwise from north
  enu,        ///< body forward-left-up: pitch nose down, yaw counter-clockwise from east
};

/// The north that headings count from.
enum class NorthReference {
  by_coordinates,  ///< grid north for map coordinates, else true north
  true_north,
  grid_north,
};

/// What a caller knows of trajectory files beyond what they state.
struct TrajectoryReading {
  std::string crs;      ///< of the points: the frame of the result
  std::string own_crs;  ///< of the files; default: WGS 84 (ITRF), map coordinates those of \a crs
  LengthUnit unit;      ///< of map coordinates; the result is in metres
  /// Names of the columns of text files in their order, as in a header; "skip" for others. Empty:
  /// by the header of the file.
  std::vector<std::string> columns;
  AngleUnit angles = AngleUnit::stated;  ///< degrees where nothing is stated
  AttitudeAxes axes = AttitudeAxes::by_course;
  NorthReference north = NorthReference::by_coordinates;
  /// Times are UTC: seconds that are added. Without it a column of UTC is used only where a GPS
  /// week beside it gives the leap seconds.
  std::optional<double> leap_seconds;
  /// Geoid undulation, subtracted from the heights of the files: metres, or the path of a grid that
  /// PROJ reads. Empty: none.
  std::string geoid;
};

/// TrajectoryFile::format of a trajectory that was reconstructed from points: its standard
/// deviations are not those of the trajectory that the points were computed with.
inline constexpr const char* kReconstructedFormat = "reconstructed from points";

/// Where the samples of a file stand in it.
struct SamplePlaces {
  bool lines = false;                  ///< of a text file; otherwise records
  std::vector<std::uint32_t> numbers;  ///< of the samples, from one

  /// "line 12", "record 12"
  std::string name(std::size_t sample) const {
    return (lines ? "line " : "record ") + std::to_string(numbers[sample]);
  }
};

/// A trajectory as a file holds it, in the frame of the points.
struct TrajectoryFile {
  std::vector<TrajectorySample> samples;  ///< in the order of the file
  SamplePlaces places;                    ///< of the samples; empty where files were joined
  /// What the file and the caller leave open: the samples hold the attitude as one of north, east,
  /// down until the course shows otherwise (settleAxes() of module trajectory).
  AttitudeForm attitude = AttitudeForm::heading;
  /// What the headings of the samples were turned by on their way to grid north, radians, where the
  /// attitude leaves something open; empty: nothing.
  std::vector<double> turns;
  std::string axes;  ///< remark on the axes that the course showed; empty where nothing was open
  /// "columns: time from GpsTime, heading from Azimuth"; empty where all have their plain names.
  std::string columns;
  std::string format;                        ///< "SBET", "text"
  std::string frame;                         ///< "latitude, longitude and ellipsoidal height, …"
  std::vector<TrajectoryAccuracy> accuracy;  ///< of the samples; empty where none is stated
  std::vector<std::string> remarks;          ///< conversions and assumptions, one line each
};

/** \brief Reads a trajectory: text with a header line, Applanix SBET (.out, .sbet), TerraScan
 * (.trj), RIEGL (.pof, with the .poq beside it) or Leica (.sol).
 *
 * Text: columns are found by the names in use (the module's README lists them) in any case, below
 * any number of lines that are no header; separator , ; tab or blanks; a line of units below the
 * header is read, and so are units in the names ("roll_rad"); seconds, metres and degrees
 * otherwise. Latitude and longitude may be degrees, minutes and seconds. Coordinates on the map, on
 * the ellipsoid or geocentric; the latter two are projected to the CRS of the points with PROJ, and
 * headings from true north turned by the meridian convergence.
 *
 * InputError names file, line (or record) and column, and has the hint where something may be
 * stated. Geographic coordinates without TrajectoryReading::crs are a UsageError.
 */
TrajectoryFile readTrajectoryFile(const std::filesystem::path& path,
                                  const TrajectoryReading& reading);

/** \brief Reads trajectories of one survey and joins them in order of time.
 *
 * Each path is a file or a folder, of which all files that may be a trajectory are read in order of
 * their names. Files may be of different formats. Seconds of the week and absolute times are
 * brought to one scale. A sample whose time and place (within 5 mm and 2e-5 rad) another file holds
 * is excluded; where files differ at times that both cover, InputError names both, the time and the
 * distance. The time between files remains a gap of the trajectory.
 */
TrajectoryFile readTrajectoryFiles(const std::vector<std::filesystem::path>& paths,
                                   const TrajectoryReading& reading);

/// Joins trajectories as readTrajectoryFiles() does. \a paths: of the files, for messages.
TrajectoryFile joinTrajectoryFiles(std::vector<TrajectoryFile> files,
                                   const std::vector<std::filesystem::path>& paths);

/// What a trajectory file states, without projection.
struct TrajectoryFacts {
  std::string format, frame, columns;
  std::size_t samples = 0;
  TimeRange times;
  std::string time_kind;     ///< "seconds of the GPS week"
  double median_step = 0.0;  ///< seconds
  bool attitude = false;     ///< of every sample
  /// As in TrajectoryFile, of \a local.
  AttitudeForm attitude_form = AttitudeForm::heading;
  std::string axes;                          ///< remark on the axes of the attitude
  std::vector<TrajectoryAccuracy> accuracy;  ///< empty where none is stated
  /// In order of time, positions east, north and up of the first sample, metres; of geographic
  /// coordinates on a sphere, of geocentric ones zero.
  std::vector<TrajectorySample> local;
  SamplePlaces places;  ///< of \a local
};
TrajectoryFacts inspectTrajectory(const std::filesystem::path& path,
                                  const TrajectoryReading& reading);

/// Whether a file in a folder is a trajectory by its name.
bool isTrajectoryFile(const std::filesystem::path& path);

/// The trajectory files that paths mean: themselves, or those of a folder. InputError for a folder
/// without any.
std::vector<std::filesystem::path> trajectoryPaths(const std::vector<std::filesystem::path>& paths);

}  // namespace pcl_als
