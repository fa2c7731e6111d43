// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/trajectory/height_check.h>

#include "parameter_choice.h"
#include "shared_errors.h"

namespace pcl_als {

/// One component of the estimated trajectory error of one strip, with its prior.
struct StripErrorSize {
  std::string strip;
  int component = 0;   ///< east, north, up; pitch, roll, heading
  double rms = 0.0;    ///< over the strip, metres or radians
  double sigma = 0.0;  ///< a priori standard deviation, metres or radians

  double ratio() const { return rms / sigma; }
};

/// Ratios from which corrections are named, and beyond which the model is contradicted. The README
/// of the module has the distribution of the ratio in blocks without faults.
constexpr double kNoticeableCorrection = 3.0, kContradictingCorrection = 5.0;

/// The components that exceed \a ratio a priori standard deviations, largest ratio first.
std::vector<StripErrorSize> largeStripErrors(const std::vector<StripErrors>& strips,
                                             const SharedErrorModel& model, double ratio);

/// Dependence of one parameter on the a priori standard deviations that corrections exceed.
struct PriorEffect {
  SystemParameter parameter;
  double change = 0.0;        ///< of the estimate; metres, radians, 1
  double std = 0.0;           ///< as estimated
  double std_enlarged = 0.0;  ///< with the enlarged a priori standard deviations

  /// Whether it changes by more than one standard deviation, or loses more than half of its
  /// information.
  bool affected() const;
};

/** \brief Sensitivity of the parameters to corrections that exceed their a priori standard
 * deviations.
 *
 * The adjustment is solved again with the a priori standard deviation of each component in \a large
 * enlarged to the size of the correction (RMS over the strip); observations and weights are
 * unchanged.
 */
std::vector<PriorEffect> priorEffects(const std::vector<StripErrorSize>& large,
                                      const std::vector<std::string>& strips,
                                      const Adjustment& adjustment, const ParameterChoice& choice);

/** \brief Reports estimated trajectory errors (strip corrections) that contradict the model.
 *
 * An error of the trajectory that the model does not contain (a wrong unit, datum or reference
 * point) is distributed between the strip corrections and the parameters that are correlated with
 * them, in proportion to their a priori variances. Corrections beyond three a priori standard
 * deviations give a warning, and so does a misfit that only the corrections reduce; beyond five, or
 * where both are found, the verdict is that parameters are affected. Names strip, component, size,
 * a priori standard deviation and likely causes (of a reconstructed trajectory those of the one
 * that the points were computed with), and the parameters that are affected (\a effects), with the
 * change as the reason of each; where none is, corrections alone are no objection. Call after the
 * fits are in the result and before judgeCalibration().
 */
void assessStripErrors(const CalibrationSettings& settings, const std::vector<PriorEffect>& effects,
                       const HeightError& height, CalibrationResult& result);

/** \brief Assesses the effect of a wrong height of the trajectory on the parameters.
 *
 * With a trajectory that is too high by h, z of Eq. (8) is too low by h, and z dphi + dX stays the
 * same where lever_arm_x changes by -h boresight_roll; lever_arm_y likewise with boresight_pitch.
 * Where the lever arm is not estimated, the boresight angle changes instead, by up to its share
 * h / H of the flying height H. Through the scan angle, which appears too small, scan_angle_scale
 * changes by that share of itself and of range_bias / H, and range_bias through the cosine. An
 * error that is certain is an objection; one that may also be of the recorded angles is included in
 * the standard deviations.
 */
void assessHeight(const HeightError& error, const CalibrationSettings& settings,
                  CalibrationResult& result);

/// The standard deviation of the heights of a reconstructed trajectory as an error that may be.
HeightError uncertainHeight(double std, double height);

}  // namespace pcl_als
