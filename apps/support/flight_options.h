// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/processing/trajectory_loading.h>

#include "command_line.h"

namespace pcl_als::app {

/// Declares -trajectory, what is known of its files, -gps_week and -line_fit; \a use: what the
/// trajectory is for; empty: it is needed.
void addFlightOptions(CommandLine& line, const std::string& use = {});

/// UsageError for a value of one of these options that no trajectory can be read with, also where
/// none is read.
void checkFlightOptions(const CommandLine& line);

/// -gps_week; empty when it is to be found from the data.
std::optional<int> gpsWeek(const CommandLine& line);

/// -force: continue with a warning where the tool refuses because of \a reason.
void addForceOption(CommandLine& line, const std::string& reason = "inputs do not belong together");

/// "applied", "applies"
struct CalibrationUse {
  const char *passive, *active;
};
/// Refuses a calibration that its verdict says not to use; with -force there is a warning instead.
void requireUsable(const CommandLine& line, const std::string& file,
                   const CalibrationVerdict& verdict, const CalibrationUse& use);
/// The calibration of -calibration. InputError for one whose verdict is not usable; with -force a
/// warning on stderr.
CalibrationResult usableCalibration(const CommandLine& line);

/// -model auto, quasi_rigorous, rigorous or nominal.
void addModelOption(CommandLine& line);
AttitudeUse attitudeUse(const CommandLine& line);

/// Those of them that state what is known of the files.
void addTrajectoryOptions(CommandLine& line, const std::string& use = {});

/// The values of -trajectory.
std::vector<std::filesystem::path> trajectoryFiles(const CommandLine& line);

/// Declares -trajectory_accuracy; \a use: what the accuracies are for.
void addAccuracyOption(CommandLine& line, const std::string& use);
/// The records of its file; empty without it.
std::vector<TrajectoryAccuracy> accuracies(const CommandLine& line);

/// What the options state of the files of -trajectory.
TrajectoryReading trajectoryReading(const CommandLine& line, const std::string& points_crs);

/// Reads -trajectory as a step of its own. An SBET is projected to -crs, else to \a points_crs.
/// \a half_width: trajectory window in seconds where -line_fit is not given; 0: the library's.
/// \a points: files for -trajectory reconstruct; empty: a UsageError. \a accuracy gets what the
/// files state, if not null.
std::shared_ptr<const Trajectory> loadTrajectory(const CommandLine& line,
                                                 const std::string& points_crs, double half_width,
                                                 AttitudeUse attitude,
                                                 const std::vector<std::string>& points = {},
                                                 LoadedTrajectory* whole = nullptr);

}  // namespace pcl_als::app
