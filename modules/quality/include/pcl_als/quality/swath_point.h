// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// A point as a check uses it; position in the ground frame, in double. 48 bytes.
struct SwathPoint {
  Eigen::Vector3d position;  ///< metres
  double time = 0.0;         ///< seconds; 0 when the file has none
  float intensity = 0.0F;    ///< digital number
  float scan_angle = 0.0F;   ///< degrees, the file's sign
  std::uint8_t return_number = 1;
  std::uint8_t number_of_returns = 1;
  std::uint8_t classification = 0;  ///< ASPRS code
  std::uint8_t flags = 0;           ///< PointFlag

  bool isSingle() const { return number_of_returns <= 1; }
  bool isLast() const { return return_number >= number_of_returns; }
};

/// False for points that no check uses: withheld, noise (7, 18), not finite.
bool isCheckable(const SwathPoint& point);

/// True for a checkable point that may be part of a solid surface: a last return, not on water (9).
/// Vegetation is removed by dropHighVegetation().
bool isSolid(const SwathPoint& point);

/** \brief Removes the points of one strip that are classified as vegetation (3-5) and more than one
 * metre above the lowest point of their cell of 5 m.
 *
 * Vegetation nearer to the ground is kept: many classifications assign to vegetation all points
 * some centimetres or decimetres above a ground that was determined from all strips together.
 * Without these, the low points of every strip would remain, and the higher strip would appear
 * lower.
 */
void dropHighVegetation(std::vector<SwathPoint>& points);

}  // namespace pcl_als
