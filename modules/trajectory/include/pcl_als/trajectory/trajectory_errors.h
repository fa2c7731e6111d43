// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/** \brief What a calibration found to be wrong with the trajectory of each strip, by time.
 *
 * X(as measured) = X(true) + position + the effect of the angles, which act as boresight biases do
 * (Eq. (8)): assumed - true, metres in the ground frame (east, north, up) and radians (pitch, roll,
 * heading). Linear in time between knots, constant for two seconds beyond a strip's ends, zero at
 * all other times.
 */
class TrajectoryErrors {
 public:
  /// InputError when strips overlap in time (two scanners at once: their errors are not one
  /// function of time), when knots are not in order or a value is not finite.
  explicit TrajectoryErrors(const std::vector<StripErrors>& strips);

  bool empty() const { return strips_.empty(); }
  /// False, and zero, at times of no strip.
  bool at(double time, TrajectoryErrorKnot& errors) const;

 private:
  std::vector<std::vector<TrajectoryErrorKnot>> strips_;  ///< in order of time
};

}  // namespace pcl_als
