// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

struct FileCorrectionOptions {
  bool strip_corrections = false;  ///< correct the estimated errors of the trajectory as well
  bool invert = false;             ///< apply the biases instead of removing them
  bool keep_uncovered = false;  ///< points without trajectory stay unchanged; otherwise at most 1 %
  /// Refuse a trajectory that cannot belong to the points.
  bool check_trajectory = true;
  /// Continue with warnings where this check fails or the verdict of the calibration is not
  /// "usable", and with a level sensor where the scanner is not linear and has no attitude.
  bool force = false;
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  int threads = 0;              ///< 0: all cores; the result does not depend on it
};

struct FileCorrectionResult {
  std::uint64_t points = 0;
  CoverageCount coverage;
  /// how point times were reconciled with those of the flight; may be empty
  std::string time_remark;
  Warnings warnings;  ///< from the check of the trajectory
  /// Result of the recovery of attitude from this file, where the calibration has none for its
  /// times; otherwise empty.
  std::string attitude_remark;
};

/** \brief Applies a calibration to a point file: .las and .laz in constant memory on the raw
 * integers, with every other byte kept, .pcd through SystemBiasCorrection.
 *
 * Where the calibration recovered the attitude from the points, the attitude it contains is used,
 * so that a strip and its tiles are corrected alike. For times without it (another flight, a
 * calibration of an earlier version) pitch and crab are recovered from the points of this file.
 *
 * \param flight as delivered, made with trajectoryOptions(calibration)
 *
 * UsageError for input and output of different kinds or the same file, and for a calibration that
 * should not be applied; InputError for files that cannot be used; Cancelled. The output appears
 * only when it is complete.
 */
FileCorrectionResult correctPointFile(const std::filesystem::path& input,
                                      const std::filesystem::path& output,
                                      const CalibrationResult& calibration,
                                      std::shared_ptr<const Trajectory> flight,
                                      const FileCorrectionOptions& options = {},
                                      const ProgressCallback& progress = {});

}  // namespace pcl_als
