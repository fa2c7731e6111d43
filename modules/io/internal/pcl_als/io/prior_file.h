// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>

#include <pcl_als/common/bias_prior.h>
#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// What earlier missions tell of a system: a calibration.json, or a history.json ("format":
/// "pcl_als history") with an instrument part of the same form.
struct PriorFile {
  std::string name;           ///< of the file
  CalibrationResult earlier;  ///< of a history: the instrument part only
  bool is_history = false;
  /// Standard deviations of the change of each parameter to a new mission, internal units: those
  /// that a history states in "change_std", missionChangeStd() for the others.
  SystemVector change_std = SystemVector::Zero();

  /** \brief The prior for a new mission, of the estimated parameters: their biases, with the
   * covariance D R D + diag(change_std^2) of their standard deviations D and correlations R.
   *
   * InputError where there is no estimated parameter, or their covariance is not positive definite
   * or not known.
   */
  BiasPrior prior() const;

  /// The calibration to apply: that of the file; of a history its instrument part, whose standard
  /// deviations and correlations are those of a new mission, with the changes to it.
  CalibrationResult calibration() const;
};

/// Reads such a file, by its "format". InputError for another file, and one that lacks what a prior
/// needs. Whether the calibration should be used is up to the caller (CalibrationResult::verdict).
PriorFile readPriorFile(const std::filesystem::path& path);

}  // namespace pcl_als
