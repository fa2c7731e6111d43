// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <pcl_als/common/point_flag.h>

namespace pcl_als {

/// A return of a pulse as the jobs process it: position in double, in the ground frame. 48 bytes.
struct LidarReturn {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres
  double time = 0.0;       ///< seconds, in the time system of the trajectory; 0 when there is none
  float intensity = 0.0F;  ///< digital number
  /// As recorded, degrees; NaN: none
  float scan_angle = std::numeric_limits<float>::quiet_NaN();
  std::uint8_t return_number = 1;
  std::uint8_t number_of_returns = 1;
  std::uint8_t classification = 0;  ///< ASPRS code
  std::uint8_t flags = 0;           ///< PointFlag
  std::uint8_t channel = 0;         ///< of the scanner; 0 where none is recorded
  std::uint8_t user_data = 0;       ///< as recorded; its meaning is that of the software before

  bool isSingle() const { return number_of_returns <= 1; }
  bool isLast() const { return return_number >= number_of_returns; }
  bool isWithheld() const { return (flags & kWithheld) != 0; }
  bool isNoise() const { return classification == 7 || classification == 18; }
  bool isVegetation() const { return classification >= 3 && classification <= 5; }
};

}  // namespace pcl_als
