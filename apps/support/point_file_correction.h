// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/bias_evaluator.h>

namespace pcl_als::app {

/// What to do to a point file.
struct PointFileCorrection {
  std::shared_ptr<const Trajectory> trajectory;
  SystemVector biases = SystemVector::Zero();                 ///< assumed - true: m, rad, 1
  std::shared_ptr<const TrajectoryErrors> trajectory_errors;  ///< strip corrections; null: none
  bool recover_attitude = false;  ///< pitch and crab from the points; the trajectory has none
  bool invert = false;            ///< put the biases in instead of taking them out
  bool keep_uncovered = false;    ///< points without trajectory stay; else at most 1 %
  /// Whether to refuse a trajectory that the points cannot have been measured from.
  bool check_trajectory = true;
  bool force = false;           ///< go on where that check refuses, with warnings
  std::optional<int> gps_week;  ///< of times that are seconds of the week
  int threads = 0;
};

struct PointFileCorrectionResult {
  std::uint64_t points = 0;
  CoverageCount coverage;
  std::string time_remark;  ///< how point times were matched to the trajectory's; may be empty
  std::vector<std::string> warnings;           ///< of the trajectory's check
  std::string attitude_remark;                 ///< what was recovered; may be empty
  std::vector<AttitudeRecovery::Pass> passes;  ///< by which the attitude was recovered
};

/** \brief Corrects a point file into another: .las and .laz in constant memory on the raw integers,
 * .pcd through SystemBiasCorrection.
 *
 * \a progress is called now and then with the fraction done, by one thread at a time. UsageError
 * for input and output of different kinds or the same file; InputError for what the files cannot
 * serve. The output appears only when it is complete.
 */
PointFileCorrectionResult correctPointFile(const std::filesystem::path& input,
                                           const std::filesystem::path& output,
                                           const PointFileCorrection& correction,
                                           const std::function<void(double)>& progress);

}  // namespace pcl_als::app
