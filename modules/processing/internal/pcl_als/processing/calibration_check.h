// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

class Communicator;

/// Whether a calibration of an earlier flight holds for some strips.
struct CalibrationCheck {
  bool possible = false;    ///< false: no two strips overlap, or the calibration is no prior
  std::string not_checked;  ///< why not
  /// RMS normal distances of the pairs as delivered, and corrected with the calibration, metres.
  double rms_before = 0.0, rms_with_calibration = 0.0;
  /// By parameter, the largest difference to the calibration (by its standard deviation) first.
  std::vector<PriorDifference> differences;

  bool holds() const { return differences.empty() || !differences.front().significant; }
  /// One line: the misfit before and after, and the largest difference. \a name: of the
  /// calibration.
  std::string text(const std::string& name) const;
};

/// Whether a calibration may come from another flight than that of some files: none of its strips
/// was measured during the flight (isOfAnotherFlight()) or, where it does not tell their times, no
/// file has the name of one of its inputs.
bool mayBeOfAnotherFlight(const CalibrationResult& calibration,
                          const std::vector<std::string>& files, const Trajectory& flight);

struct CalibrationCheckOptions {
  std::optional<int> gps_week;
  int threads = 0;
  bool force = false;
  Communicator* processes = nullptr;
};

/** \brief Compares the strips of some files with a calibration: they are calibrated with it as the
 * prior, without any change since, from few points (300,000, 20,000 of them candidates).
 *
 * Reads the files twice; memory is that of a calibration with so few points. Nothing is written.
 * UsageError without a trajectory; InputError where the trajectory does not belong to the points.
 */
CalibrationCheck checkCalibration(const std::vector<std::string>& files,
                                  const CalibrationResult& calibration,
                                  const std::shared_ptr<const Trajectory>& flight,
                                  const CalibrationCheckOptions& options,
                                  const ProgressCallback& progress = {});

}  // namespace pcl_als
