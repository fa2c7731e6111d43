// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <vector>

#include <pcl_als/calibration/adjustment.h>
#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/** \brief Standard deviation from which on a parameter counts as not determined by the data.
 *
 * Estimates this uncertain are no improvement on a freshly mounted system. Short of that they are
 * better made than held: what is confused with them (pitch with lever_arm_y) is only right together
 * with them, and a parameter that is wrongly held resembles errors of the trajectory.
 */
struct DeterminationLimits {
  double lever_arm = 0.08;                       ///< metres
  double roll_pitch = 60.0 * kRadiansPerArcsec;  ///< radians
  double heading = 180.0 * kRadiansPerArcsec;    ///< radians
  double range = 0.10;                           ///< metres
  double scan_angle_scale = 3e-4;                ///< unitless

  double of(SystemParameter p) const;
  /// What a parameter that is dropped may be wrong by (standard deviation), which the uncertainty
  /// of the others includes: 5 cm for lever arms, which can be surveyed; twice the limit for the
  /// rest.
  double whenHeld(SystemParameter p) const;
};

/// Which parameters are solved for, and why the others are not.
struct ParameterChoice {
  std::vector<SystemParameter> estimate;
  std::array<ParameterStatus, kSystemParameterCount> status{};
  std::array<std::string, kSystemParameterCount> reason;  ///< empty for an estimated parameter
  AdjustmentSolution solution;                            ///< with exactly these
};

/** \brief Drops from \a wanted what the observations cannot determine, one by one, each with the
 * reason.
 *
 * A parameter is not determined when the normal matrix is singular in a direction it takes part in,
 * or when its standard deviation exceeds \a limit_factor times its limit. Of the parameters that
 * one weak direction confuses, the one that can best be measured otherwise goes first: lever arm,
 * then scale, range, heading, pitch, roll.
 */
/// \param unknown not estimated and not known either (range_bias without control): the uncertainty
/// of the others includes that they may be wrong, as for those that are dropped.
ParameterChoice chooseParameters(const Adjustment& adjustment,
                                 const std::vector<SystemParameter>& wanted,
                                 const SystemVector& held, const DeterminationLimits& limits,
                                 double limit_factor,
                                 const std::vector<SystemParameter>& unknown = {});

/// The parameters that are tried where none is asked for: all but lever_arm_z, range_bias only with
/// control.
std::vector<SystemParameter> automaticParameters(bool with_control);

/// Puts estimates, standard deviations, correlations and statuses into a result, with a warning for
/// every parameter that is not determined. \a requested is empty where the choice was automatic.
void reportParameters(const ParameterChoice& choice, const std::vector<SystemParameter>& requested,
                      CalibrationResult& result);

/// "0.35 m", "12.4 arcsec", "0.00031": a value of a parameter in its interface unit.
std::string inUnit(SystemParameter parameter, double value);

}  // namespace pcl_als
