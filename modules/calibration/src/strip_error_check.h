// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/shared_errors.h>
#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// One component of the trajectory error estimated for one strip, against what was assumed of it.
struct StripErrorSize {
  std::string strip;
  int component = 0;   ///< east, north, up; pitch, roll, heading
  double rms = 0.0;    ///< over the strip, metres or radians
  double sigma = 0.0;  ///< a priori standard deviation, metres or radians

  double ratio() const { return rms / sigma; }
};

/// The components that exceed \a ratio a priori standard deviations, largest ratio first.
std::vector<StripErrorSize> largeStripErrors(const std::vector<StripErrors>& strips,
                                             const SharedErrorModel& model, double ratio);

/** \brief Reports estimated trajectory errors (strip corrections) that contradict the model.
 *
 * An error of the trajectory that the model does not contain (a wrong unit, datum or reference
 * point) is distributed between the strip corrections and the parameters that are correlated with
 * them, in proportion to their a priori variances. Corrections beyond three a priori standard
 * deviations give a warning, and so does a misfit that only the corrections reduce; beyond five, or
 * where both are found, the verdict is that parameters are affected. Names strip, component, size,
 * a priori standard deviation and likely causes. Call after the fits are in the result and before
 * judgeCalibration().
 */
void assessStripErrors(const SharedErrorModel& model, CalibrationResult& result);

}  // namespace pcl_als
