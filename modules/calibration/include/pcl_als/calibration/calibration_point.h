// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace pcl_als {

/// What the calibration reads of a point. Position in the ground frame, double.
struct CalibrationPoint {
  Eigen::Vector3d position;  ///< metres
  double time = 0.0;         ///< seconds, on the trajectory's clock
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

/// A square that is calibrated on; points up to \a margin outside are read too, so that its TIN is
/// that of the whole.
struct CalibrationArea {
  Eigen::Vector2d minimum;  ///< metres, ground frame
  double size = 0.0;        ///< metres, side
  double margin = 0.0;      ///< metres

  bool contains(const Eigen::Vector3d& p) const {
    return p.x() >= minimum.x() && p.y() >= minimum.y() && p.x() < minimum.x() + size &&
           p.y() < minimum.y() + size;
  }
  bool covers(const Eigen::Vector3d& p) const {
    return p.x() >= minimum.x() - margin && p.y() >= minimum.y() - margin &&
           p.x() < minimum.x() + size + margin && p.y() < minimum.y() + size + margin;
  }
};

}  // namespace pcl_als
