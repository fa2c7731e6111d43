// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/processing/checked_block.h>

namespace pcl_als {

/// Whether a delivery satisfies a quality level of the USGS Lidar Base Specification.
struct DeliveryRequirement {
  int level = 2;  ///< 0 to 3
  bool kept = false;
  std::size_t pairs = 0;             ///< measured pairs of strips of different passes
  std::size_t control_points = 0;    ///< control points used; 0: absolute accuracy was not checked
  std::vector<std::string> reasons;  ///< every pair and figure that does not satisfy the level

  /// "the delivery does not keep QL2: strips 1 and 2: RMSDz 9.2 cm, more than the 8 cm that are
  /// allowed; and 3 more reasons" or "the delivery keeps QL2"
  std::string describe() const;
};

/** \brief Compares a checked delivery with the limits of a quality level (QualityLevelLimits).
 *
 * The level is kept if a pair or a control point was measured and all of these conditions hold:
 * - the RMSDz of every measured pair of strips is within the limit between swaths (Table 2);
 * - every pair whose overlap is at least CheckSettings::minimum_overlap was measured; a pair under
 *   forest or water, or with the same points twice, does not show that the level is kept;
 * - if control is given, a strip covers at least one of its points and the RMSE of the heights is
 *   within the absolute limit (Table 4).
 * Without control, the result concerns the agreement of the strips only. Repeatability within a
 * strip, density and voids are not assessed. UsageError for a \a level other than 0 to 3.
 */
DeliveryRequirement requireLevel(const CheckedBlock& block, int level);

}  // namespace pcl_als
