// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string_view>

namespace pcl_als {

/// Source of the sensor's attitude in the model of a calibration; also needed to apply its
/// biases.
enum class AttitudeSource {
  none,        ///< none: vertical, aligned with the flight line (quasi-rigorous)
  points,      ///< pitch and crab from the points (quasi-rigorous, AttitudeRecovery)
  trajectory,  ///< roll, pitch and heading of the trajectory (rigorous)
  nominal,     ///< level, heading along the course (rigorous, for scanners that are not linear)
};

std::string_view toString(AttitudeSource attitude);
/// "rigorous" where the attitude is the trajectory's or nominal, else "quasi_rigorous".
std::string_view modelName(AttitudeSource attitude);

}  // namespace pcl_als
