// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <vector>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/calibration_result.h>

#include "adjustment.h"

namespace pcl_als {

/// The parameters that are estimated, and the reasons for the others.
struct ParameterChoice {
  std::vector<SystemParameter> estimate;
  std::array<ParameterStatus, kSystemParameterCount> status{};
  std::array<std::string, kSystemParameterCount> reason;  ///< empty for an estimated parameter
  AdjustmentSolution solution;                            ///< with exactly these
  HeldParameters held;  ///< others, whose possible size the covariance of the solution includes
};

/** \brief Excludes of \a wanted the parameters that the observations cannot determine, one at a
 * time, each with the reason.
 *
 * A parameter is not determined when the normal matrix is singular in a direction in which it has a
 * component, or when its standard deviation exceeds \a limit_factor times its limit. Of the
 * parameters that cannot be separated in one direction, the one that is most easily measured
 * otherwise is excluded first: lever arm, then scale, range, heading, pitch, roll.
 */
/// \param unknown parameters that are neither estimated nor known (range_bias without control): the
/// uncertainty of the others includes their possible size, as for those that are excluded.
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

}  // namespace pcl_als
