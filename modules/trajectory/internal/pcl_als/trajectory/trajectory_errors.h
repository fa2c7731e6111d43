// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/** \brief Errors of the trajectory of each strip as estimated by a calibration, as functions of
 * time.
 *
 * X(as measured) = X(true) + position + the effect of the angles, which is that of boresight biases
 * (Eq. (8)): assumed - true, metres in the ground frame (east, north, up) and radians (pitch, roll,
 * heading). Linear in time between knots, constant for two seconds beyond the ends of a strip, zero
 * at all other times.
 */
class TrajectoryErrors {
 public:
  /// Strips of one pass have the same errors, which count once. InputError when the errors of
  /// strips that overlap in time differ, because they are not one function of time, when knots are
  /// not in order or a value is not finite.
  explicit TrajectoryErrors(const std::vector<StripErrors>& strips);

  bool empty() const { return strips_.empty(); }
  /// False, with errors of zero, at times that belong to no strip. Their standard deviations are
  /// linear between knots, too.
  bool at(double time, TrajectoryErrorKnot& errors) const;
  /// Correlations of the errors, linear between the times at which they are known; false where
  /// they are not, and at times that belong to no strip.
  bool correlationAt(double time, StripErrorCorrelation& correlation) const;

 private:
  /// The strip to which a time belongs; null: none.
  const StripErrors* stripAt(double time) const;

  std::vector<StripErrors> strips_;  ///< in order of time
};

}  // namespace pcl_als
