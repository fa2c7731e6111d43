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
  where_given,  ///< use them where every sample has them
  needed,       ///< refuse a file without them
  ignore,       ///< positions only
  nominal,      ///< a level sensor whose heading is the course
};

/// What is known of the files (TrajectoryReading), and how they are used.
struct TrajectoryLoadingOptions : TrajectoryReading {
  double line_fit_half_width = 0.0;  ///< seconds; 0: Trajectory's default
  AttitudeUse attitude = AttitudeUse::where_given;
  bool keep_samples = false;  ///< LoadedTrajectory::samples
};

/// Options for reading the flight for a calibration that is applied (by SystemCorrection).
TrajectoryLoadingOptions trajectoryLoadingOptions(const CalibrationResult& calibration);

struct LoadedTrajectory {
  std::shared_ptr<const Trajectory> trajectory;
  std::string format;                ///< "SBET", "text", "several formats"
  std::string frame;                 ///< coordinates and datum of the file
  std::vector<std::string> remarks;  ///< remarks for the user on columns, angles and repairs
  std::vector<TrajectoryAccuracy> accuracy;  ///< that the files state; may be empty
  /// In the order of the files, with attitude where they have it.
  std::vector<TrajectorySample> samples;

  /// Whether it was reconstructed from points.
  bool reconstructed() const { return format == kReconstructedFormat; }
};

/// Reads a trajectory from files or folders of any format (readTrajectoryFiles()). Whether a column
/// named yaw is clockwise from north or counter-clockwise from east, and which axes a quaternion
/// refers to, is determined from the course (settleAxes()). InputError naming the file; with the
/// hint to state the axes where the course does not show those of a quaternion.
LoadedTrajectory loadTrajectory(const std::vector<std::filesystem::path>& paths,
                                const TrajectoryLoadingOptions& options = {});
LoadedTrajectory loadTrajectory(const std::filesystem::path& path,
                                const TrajectoryLoadingOptions& options = {});

/// A trajectory whose samples were screened (screenTrajectory()), as it is used. \a name: for
/// messages.
LoadedTrajectory flightOf(TrajectoryFile file, const std::string& name,
                          const TrajectoryLoadingOptions& options = {});

/// The facts of each file (inspectTrajectory()), with the axes that the course shows.
std::vector<std::pair<std::string, TrajectoryFacts>> inspectFlight(
    const std::vector<std::filesystem::path>& paths, const TrajectoryReading& reading);

}  // namespace pcl_als
