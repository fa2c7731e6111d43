// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/trajectory/trajectory_errors.h>

namespace pcl_als {

/** \brief Covariance of the errors that remain after a correction: those of the eight system
 * parameters and the six of the trajectory at a time.
 *
 * Order: SystemParameter, then east, north, up, pitch, roll, heading; m, rad, 1. With the estimate
 * s of the trajectory errors of a strip and their a posteriori covariance S (with the parameters:
 * correlated), the remaining errors have the covariance S where s is removed (strip corrections),
 * and else the mean square S + s s'. At times that no strip of the calibration covers, or where it
 * has no a posteriori covariance, the trajectory errors are independent of the parameters, with the
 * given standard deviations of the trajectory or, where there are none, those of
 * CalibrationResult::error_levels.
 */
class CalibrationCovariance {
 public:
  static constexpr int kSize = kSystemParameterCount + 6;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  struct Options {
    bool strip_corrections = false;  ///< the estimated errors of the strips are removed
    /// Standard deviations of the trajectory in order of time; position_std and angles_std (pitch,
    /// roll, heading) are used.
    std::vector<TrajectoryErrorKnot> accuracy;
  };

  /// InputError for strip corrections that cannot be used (TrajectoryErrors).
  CalibrationCovariance(const CalibrationResult& calibration, const Options& options);

  Matrix at(double time) const;
  /// Whether the calibration has a posteriori covariances of the trajectory errors at a time.
  bool isKnown(double time) const;
  const ErrorLevels& levels() const { return levels_; }
  /// Of the system parameters alone (m, rad, 1); zero for those that were not estimated.
  const SystemMatrix& parameters() const { return parameters_; }

 private:
  /// A priori standard deviations of the trajectory errors.
  Eigen::Matrix<double, 6, 1> priorStd(double time) const;

  bool strip_corrections_;
  std::vector<TrajectoryErrorKnot> accuracy_;
  ErrorLevels levels_;
  std::optional<TrajectoryErrors> errors_;
  std::vector<SystemParameter> order_;
  SystemVector std_;
  SystemMatrix parameters_;
};

}  // namespace pcl_als
