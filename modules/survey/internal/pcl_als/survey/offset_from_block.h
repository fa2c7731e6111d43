// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_als {

/** \brief Where coordinates that should lie within a block lie instead, and the likely reason.
 *
 * Tried are exchanged axes, feet for metres and the reverse, another number of the zone before the
 * eastings, and the neighbouring zones of 6 and 3 degrees; a reason is named where it is the only
 * one under which the coordinates would lie within the block.
 */
struct OffsetFromBlock {
  double distance = 0.0;  ///< metres between the boxes in plan; zero where they intersect
  std::string cause;      ///< "they would lie within it with x and y exchanged"; empty: unknown

  /// \param given box of the coordinates, metres; \param block box of the block, metres
  OffsetFromBlock(const Eigen::AlignedBox2d& given, const Eigen::AlignedBox2d& block);

  /// "412.3 km beside the strips; its coordinates would lie within them with x and y exchanged"
  std::string text() const;
};

}  // namespace pcl_als
