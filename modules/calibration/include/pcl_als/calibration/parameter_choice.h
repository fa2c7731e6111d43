// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <vector>

#include <pcl_als/calibration/adjustment.h>
#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/** \brief Standard deviation above which a parameter counts as not determined by the data.
 *
 * Estimates with a larger standard deviation are no improvement on a newly mounted system. Below
 * the limits, estimating a parameter is better than holding it: parameters correlated with it
 * (pitch with lever_arm_y) are correct only together with it, and a parameter held at a wrong value
 * resembles trajectory errors.
 */
struct DeterminationLimits {
  double lever_arm = 0.08;                       ///< metres
  double roll_pitch = 60.0 * kRadiansPerArcsec;  ///< radians
  double heading = 180.0 * kRadiansPerArcsec;    ///< radians
  double range = 0.10;                           ///< metres
  double scan_angle_scale = 3e-4;                ///< unitless
  /// Metres: an estimate within two standard deviations of zero, one of which moves points at the
  /// edge of the swath by more, is called not determined. As the limit of lever arms, and the RMSDz
  /// that the USGS Lidar Base Specification allows at QL1 and QL2.
  double on_points = 0.08;

  /// The limits for a flying height (metres above ground): those of angles and of the scale are
  /// larger below 275 m, where 60 arcsec move points by less than a lever arm's limit does.
  DeterminationLimits atHeight(double height) const;
  double of(SystemParameter p) const;
  /// Standard deviation of a parameter that is not estimated, which the uncertainty of the others
  /// includes: 5 cm for lever arms, which can be surveyed; twice the limit for the others.
  double whenHeld(SystemParameter p) const;
};

/// The parameters that are estimated, and the reasons for the others.
struct ParameterChoice {
  std::vector<SystemParameter> estimate;
  std::array<ParameterStatus, kSystemParameterCount> status{};
  std::array<std::string, kSystemParameterCount> reason;  ///< empty for an estimated parameter
  AdjustmentSolution solution;                            ///< with exactly these
};

/** \brief Leaves out of \a wanted the parameters that the observations cannot determine, one at a
 * time, each with the reason.
 *
 * A parameter is not determined when the normal matrix is singular in a direction in which it has a
 * component, or when its standard deviation exceeds \a limit_factor times its limit. Of the
 * parameters that cannot be separated in one direction, the one that is most easily measured
 * otherwise is left out first: lever arm, then scale, range, heading, pitch, roll.
 */
/// \param unknown parameters that are neither estimated nor known (range_bias without control): the
/// uncertainty of the others includes their possible size, as for those that are left out.
ParameterChoice chooseParameters(const Adjustment& adjustment,
                                 const std::vector<SystemParameter>& wanted,
                                 const SystemVector& held, const DeterminationLimits& limits,
                                 double limit_factor,
                                 const std::vector<SystemParameter>& unknown = {});

/// The parameters of an automatic choice: all but lever_arm_z; range_bias with control only; either
/// where something is known of it (SharedErrorModel::biases).
std::vector<SystemParameter> automaticParameters(bool with_control,
                                                 const SharedErrorModel& model = {});

/// Puts estimates, standard deviations, correlations and statuses into a result, with a warning for
/// every parameter that is not determined. \a requested is empty where the choice was automatic.
void reportParameters(const ParameterChoice& choice, const std::vector<SystemParameter>& requested,
                      CalibrationResult& result);

/// "0.35 m", "12.4 arcsec", "0.00031": a value of a parameter in its interface unit.
std::string inUnit(SystemParameter parameter, double value);

}  // namespace pcl_als
