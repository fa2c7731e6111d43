// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// What a check reads of a point. Position in the ground frame, double. 48 bytes.
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
/// Vegetation is a matter of dropHighVegetation().
bool isSolid(const SwathPoint& point);

/** \brief Drops the points of one strip that are classified as vegetation (3-5) and lie more than
 * one metre above the lowest point of their cell of 5 m.
 *
 * Vegetation nearer to the ground stays: many classifications assign to vegetation everything that
 * lies some centimetres or decimetres above a ground that was found in all strips together. Leaving
 * that out would keep the low points of every strip and move the higher strip down.
 */
void dropHighVegetation(std::vector<SwathPoint>& points);

}  // namespace pcl_als
