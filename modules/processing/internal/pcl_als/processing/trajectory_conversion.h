// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/processing/trajectory_loading.h>

namespace pcl_als {

struct TrajectoryConversionOptions {
  TrajectoryReading reading;  ///< of the files; its CRS is also that of an SBET that is written
  const CalibrationResult* calibration = nullptr;  ///< to be applied; null: none
  bool strip_corrections = true;                   ///< apply those that the calibration holds
  bool force = false;                              ///< accept a calibration that is not usable
  /// Standard deviations over time, in place of those that the files state.
  std::vector<TrajectoryAccuracy> accuracy;
};

struct TrajectoryConversion {
  std::size_t samples = 0;
  std::vector<std::filesystem::path> written;
};

/// UsageError unless the extension is that of a trajectory that can be written: .csv, or .sbet and
/// .out with a CRS.
void checkTrajectoryOutput(const std::filesystem::path& output, const std::string& crs);

/// Writes a trajectory as .csv with columns of standard deviations, or as .sbet or .out with
/// NAME_smrmsg.out where they are known; returns the files.
std::vector<std::filesystem::path> writeTrajectoryFile(
    const std::filesystem::path& output, const std::vector<TrajectorySample>& samples,
    const std::vector<TrajectoryAccuracy>& accuracy, const std::string& crs,
    bool reconstructed = false);

/** \brief Reads trajectory files, corrects them by a calibration (correctTrajectory()) and writes
 * one trajectory: .csv, or .sbet and .out as SBET.
 *
 * With strip corrections, standard deviations are those after the calibration (a posteriori), at
 * times that it covers. At other times, and without strip corrections, those of the positions are
 * those of the trajectory with those of the lever arm; without any for the trajectory they are not
 * known. A CSV holds them as columns; beside an SBET, NAME_smrmsg.out is written. None are written
 * where none are known.
 *
 * UsageError for another extension and for an SBET without a CRS, InputError for files that cannot
 * be used.
 */
TrajectoryConversion convertTrajectory(const std::vector<std::filesystem::path>& paths,
                                       const std::filesystem::path& output,
                                       const TrajectoryConversionOptions& options,
                                       const ProgressCallback& progress = {});

}  // namespace pcl_als
