// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// A point as the calibration uses it; position in the ground frame, in double.
struct CalibrationPoint {
  Eigen::Vector3d position;  ///< metres
  double time = 0.0;         ///< seconds, in the time system of the trajectory
  /// As recorded, degrees; NaN: none
  float scan_angle = std::numeric_limits<float>::quiet_NaN();
  std::uint8_t return_number = 1;
  std::uint8_t number_of_returns = 1;
  std::uint8_t classification =
      0;  ///< ASPRS code; noise (7, 18) and vegetation (3-5) are left out where given
  std::uint8_t flags = 0;  ///< PointFlag; withheld points are left out

  bool isSingle() const { return number_of_returns <= 1; }
  bool isLast() const { return return_number >= number_of_returns; }
};

/// True for a point that may be part of a solid surface: a last return, not withheld, not noise,
/// not vegetation.
bool isSurfacePoint(const CalibrationPoint& point);

}  // namespace pcl_als
