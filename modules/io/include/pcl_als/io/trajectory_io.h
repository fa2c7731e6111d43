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

/// Standard deviations of a trajectory at one time; NaN for those that a file does not state.
struct TrajectoryAccuracy {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double time = 0.0;                                               ///< seconds
  Eigen::Vector3d position = Eigen::Vector3d::Constant(kUnknown);  ///< east, north, up, metres
  Eigen::Vector3d angles = Eigen::Vector3d::Constant(kUnknown);    ///< roll, pitch, heading, rad
};

/// Kind of the coordinates of a trajectory file.
enum class TrajectoryCoordinates {
  map,         ///< easting, northing, height
  geographic,  ///< latitude, longitude, height
  geocentric,  ///< X, Y, Z from the centre of the Earth
};

/// Unit of the angles of a text file. stated: that of the column, degrees if it states none.
enum class AngleUnit { stated, degrees, radians, gon };

/// Meaning of roll, pitch and heading.
enum class AttitudeAxes {
  by_course,  ///< ned; for a yaw or quaternion the axes with which the heading follows the course
  ned,        ///< roll right wing down, pitch nose up, heading clockwise from north
  enu,        ///< body forward-left-up: pitch nose down, yaw counter-clockwise from east
};

/// The north to which headings refer.
enum class NorthReference {
  by_coordinates,  ///< grid north with map coordinates, else true north
  true_north,
  grid_north,
};

/// Information about trajectory files that the files themselves do not state.
struct TrajectoryReading {
  std::string crs;  ///< CRS of the points, which is the frame of the result
  /// CRS of the files; default: \a crs for map coordinates, WGS 84 (ITRF) for others.
  std::string own_crs;
  LengthUnit unit;  ///< of map coordinates in the files; the result is in metres
  /// Names of the columns of text files in their order, as in a header line; "skip" for columns
  /// that are not used. Empty: the header line of the file.
  std::vector<std::string> columns;
  AngleUnit angles = AngleUnit::stated;
  AttitudeAxes axes = AttitudeAxes::by_course;
  NorthReference north = NorthReference::by_coordinates;
  /// Leap seconds, which are added to times in UTC. Without them, a column of UTC is used only if
  /// the GPS week of another column gives the leap seconds.
  std::optional<double> leap_seconds;
  /// Geoid undulation that is subtracted from the heights of the files: a number of metres, or the
  /// path of a grid that PROJ reads. Empty: none.
  std::string geoid;
};

/// TrajectoryFile::format of a trajectory that was reconstructed from points. Its standard
/// deviations are not those of the trajectory from which the points were computed.
inline constexpr const char* kReconstructedFormat = "reconstructed from points";

/// Line or record numbers of the samples of a file, for messages.
struct SamplePlaces {
  bool lines = false;                  ///< lines of a text file; otherwise records
  std::vector<std::uint32_t> numbers;  ///< by sample, counted from one

  /// "line 12", "record 12"
  std::string name(std::size_t sample) const {
    return (lines ? "line " : "record ") + std::to_string(numbers[sample]);
  }
};

/// The contents of a trajectory file in the frame of the points.
struct TrajectoryFile {
  std::vector<TrajectorySample> samples;  ///< in the order of the file
  SamplePlaces places;                    ///< of the samples; empty if files were joined
  /// Whether the axes of the attitude are still open. The samples then hold it as if it referred to
  /// north, east, down, until settleAxes() of module trajectory determines the axes by the course.
  AttitudeForm attitude = AttitudeForm::heading;
  /// By sample: the rotation from the north of the file to grid north that its heading contains,
  /// radians. Empty if the axes are known or no heading was rotated.
  std::vector<double> turns;
  std::string axes;  ///< remark on the axes that the course showed; empty if they were known
  /// "columns: time from GpsTime, heading from Azimuth"; empty if all have their plain names.
  std::string columns;
  std::string format;                        ///< "SBET", "text"
  std::string frame;                         ///< "latitude, longitude and ellipsoidal height, …"
  std::vector<TrajectoryAccuracy> accuracy;  ///< by sample; empty if none is stated
  std::vector<std::string> remarks;          ///< conversions and assumptions, one line each
};

/** \brief Reads a trajectory: text with a header line, Applanix SBET (.out, .sbet), TerraScan
 * (.trj), RIEGL (.pof, with the .poq of the same name) or Leica (.sol).
 *
 * The columns of a text file are found by their names, which the page of module io lists, without
 * regard to case; lines before the header are skipped. They are separated by commas, semicolons,
 * tabs or blanks. Units are read from a line below the header or from the names ("roll_rad");
 * otherwise they are seconds, metres and degrees. Latitude and longitude may be degrees, minutes
 * and seconds. Geographic and geocentric coordinates are projected to the CRS of the points with
 * PROJ, and headings from true north are reduced to grid north by the meridian convergence.
 *
 * InputError names file, line (or record) and column; its hint() states what the caller may add.
 * UsageError for geographic coordinates without TrajectoryReading::crs.
 */
TrajectoryFile readTrajectoryFile(const std::filesystem::path& path,
                                  const TrajectoryReading& reading);

/** \brief Reads the trajectory files of one block and joins them in order of time.
 *
 * Each path is a file or a folder, whose trajectory files (isTrajectoryFile()) are read in order of
 * their names. The formats of the files may differ. Seconds of the week and absolute times are
 * brought to one time scale. Samples at times that another file covers are excluded if they lie on
 * its path (within 2 cm and 1e-4 rad, plus a tolerance for manoeuvres between its samples);
 * otherwise InputError names both files, the time and the distance. The time between files remains
 * a gap of the trajectory.
 */
TrajectoryFile readTrajectoryFiles(const std::vector<std::filesystem::path>& paths,
                                   const TrajectoryReading& reading);

/// Joins trajectories as readTrajectoryFiles() does. \a paths: those of the files, for messages.
TrajectoryFile joinTrajectoryFiles(std::vector<TrajectoryFile> files,
                                   const std::vector<std::filesystem::path>& paths);

/// Summary of the contents of a trajectory file, without projection.
struct TrajectoryFacts {
  std::string format, frame, columns;
  std::size_t samples = 0;
  TimeRange times;
  std::string time_kind;     ///< "seconds of the GPS week"
  double median_step = 0.0;  ///< seconds
  bool attitude = false;     ///< whether every sample has attitude
  /// Form of the attitude of \a local, as TrajectoryFile::attitude.
  AttitudeForm attitude_form = AttitudeForm::heading;
  std::string axes;                          ///< remark on the axes of the attitude
  std::vector<TrajectoryAccuracy> accuracy;  ///< empty if none is stated
  /// The samples in order of time. Positions are east, north and up from the first sample, metres:
  /// on a sphere for geographic coordinates, zero for geocentric ones.
  std::vector<TrajectorySample> local;
  SamplePlaces places;  ///< of \a local
};
/// Reads the summary of a file. InputError as readTrajectoryFile(); no CRS is needed.
TrajectoryFacts inspectTrajectory(const std::filesystem::path& path,
                                  const TrajectoryReading& reading);

/// Whether a file counts as a trajectory by its name, as for files in a folder.
bool isTrajectoryFile(const std::filesystem::path& path);

/// The trajectory files that paths stand for: files themselves, and the trajectory files of
/// folders. UsageError for no path and for a file that is given twice, InputError for a folder
/// without a trajectory file.
std::vector<std::filesystem::path> trajectoryPaths(const std::vector<std::filesystem::path>& paths);

}  // namespace pcl_als
