// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/io/trajectory_io.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// Use of roll, pitch and heading of a trajectory file.
enum class AttitudeUse {
  where_given,  ///< use them if every sample has them
  needed,       ///< InputError for a file without them
  ignore,       ///< use the positions only
  nominal,      ///< assume a level sensor whose heading is the course
};

/// Information about trajectory files (TrajectoryReading), and how they are used.
struct TrajectoryLoadingOptions : TrajectoryReading {
  double line_fit_half_width = 0.0;  ///< seconds; 0: default of Trajectory::Options
  AttitudeUse attitude = AttitudeUse::where_given;
  bool keep_samples = false;  ///< whether LoadedTrajectory::samples is set
};

/// Options for loading the trajectory with which a calibration is applied (SystemCorrection).
TrajectoryLoadingOptions trajectoryLoadingOptions(const CalibrationResult& calibration);

struct LoadedTrajectory {
  std::shared_ptr<const Trajectory> trajectory;
  std::string format;                        ///< "SBET", "text", "several formats"
  std::string frame;                         ///< coordinates and datum of the file
  std::vector<std::string> remarks;          ///< for the user: columns, angles and repairs
  std::vector<TrajectoryAccuracy> accuracy;  ///< standard deviations of the files; may be empty
  /// The samples in the order of the files, with attitude if they have it (keep_samples).
  std::vector<TrajectorySample> samples;

  /// Whether the trajectory was reconstructed from points.
  bool reconstructed() const { return format == kReconstructedFormat; }
};

/// Reads a trajectory from files or folders of any format (readTrajectoryFiles()) and excludes
/// outliers. The course shows whether a yaw is clockwise from north or counter-clockwise from east,
/// and to which axes a quaternion refers (settleAxes()). InputError names the file; it has the hint
/// \a axes if the course does not show the axes of a quaternion.
LoadedTrajectory loadTrajectory(const std::vector<std::filesystem::path>& paths,
                                const TrajectoryLoadingOptions& options = {});
LoadedTrajectory loadTrajectory(const std::filesystem::path& path,
                                const TrajectoryLoadingOptions& options = {});

/// Makes the trajectory of a file whose samples have been screened (screenTrajectory()). \a name:
/// for messages.
LoadedTrajectory flightOf(TrajectoryFile file, const std::string& name,
                          const TrajectoryLoadingOptions& options = {});

/// The path and summary (inspectTrajectory()) of each file, with the axes that the course shows.
std::vector<std::pair<std::string, TrajectoryFacts>> inspectFlight(
    const std::vector<std::filesystem::path>& paths, const TrajectoryReading& reading);

}  // namespace pcl_als
