// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/processing/checked_block.h>

namespace pcl_als {

/// Whether a delivery keeps a quality level of the USGS Lidar Base Specification.
struct DeliveryRequirement {
  int level = 2;  ///< 0 to 3
  bool kept = false;
  std::size_t pairs = 0;             ///< that were measured
  std::size_t control_points = 0;    ///< that were used; 0: the absolute accuracy was not checked
  std::vector<std::string> reasons;  ///< why it is not kept: every pair and figure

  /// "the delivery does not keep QL2: strips 1 and 2: RMSDz 9.2 cm, more than the 8 cm that are
  /// allowed; and 3 more reasons" or "the delivery keeps QL2"
  std::string describe() const;
};

/** \brief Compares a checked delivery with the limits of a quality level (QualityLevelLimits).
 *
 * The level is kept if something was measured and all of this holds:
 * - the RMSDz of every measured pair of strips is within the limit between swaths (Table 2);
 * - every pair whose overlap is at least CheckSettings::minimum_overlap was measured: a pair under
 *   forest or water, or one with the same points twice, does not show that the level is kept;
 * - where control is given, a strip covers at least one of its points and the RMSE of the heights
 *   is within the absolute limit (Table 4).
 * Without control, the level is that of the agreement of the strips alone. Repeatability within a
 * strip, density and voids are not assessed. \a level: 0 to 3; UsageError for another.
 */
DeliveryRequirement requireLevel(const CheckedBlock& block, int level);

}  // namespace pcl_als
