// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

namespace pcl_als {

struct ReconstructionOptions {
  TrajectoryReconstruction::Settings settings;
  StripChoice strips;  ///< strips that are used; default all
  /// Read the points again to recover pitch and crab (AttitudeRecovery), and so the heading.
  bool attitude = true;
  SurveyObserver observer;  ///< called during the first reading
};

/// The flight of a survey, from its points.
struct ReconstructedTrajectory {
  std::vector<TrajectorySample> samples;     ///< in order of time, gaps between strips
  std::vector<TrajectoryAccuracy> accuracy;  ///< of each sample
  std::vector<ReconstructedPath> paths;      ///< in order of time, those without a result, too
  std::string attitude;                      ///< its source, or why there is none
  Warnings warnings;
  /// Why the result is not complete: paths with more than a tenth of the points are not determined;
  /// empty otherwise.
  std::string incomplete;

  /// As a trajectory that was read from a file.
  LoadedTrajectory asFile(const TrajectoryLoadingOptions& options = {}) const;
};

/** \brief Reconstructs the trajectory of a survey from its points (TrajectoryReconstruction).
 *
 * Reads the files once, and a second time for the attitude; memory depends on the duration of the
 * flight. The strips of \a survey are chosen anew.
 *
 * InputError, with the reason, where no path is determined; Cancelled.
 */
ReconstructedTrajectory reconstructTrajectory(SurveyReader& survey,
                                              const ReconstructionOptions& options = {},
                                              const ProgressCallback& progress = {});

/// The trajectory of point files, positions only, as one that was read from a file. UsageError
/// without any file.
LoadedTrajectory reconstructTrajectory(const std::vector<std::string>& points,
                                       const TrajectoryLoadingOptions& options, int threads,
                                       const ProgressCallback& progress = {});

/// Writes it as .csv with columns of standard deviations, or as .sbet or .out with NAME_smrmsg.out;
/// returns the files. UsageError for another extension, and for an SBET without a CRS; InputError
/// for an SBET of a flight without attitude.
std::vector<std::filesystem::path> writeReconstruction(const ReconstructedTrajectory& flight,
                                                       const std::filesystem::path& output,
                                                       const std::string& crs);

}  // namespace pcl_als
