// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/planning/block_advice.h>

namespace pcl_als {

/** \brief What could be added to a block, by section 2.2 of Habib et al. 2011; what, line and
 * control are filled.
 *
 * For the longest line of each flying height: an opposite one, one at half and at 1.75 times the
 * height, a crossing one, a parallel one in the same direction with 50 % overlap; then one control
 * point and nine. What the block has already is left out.
 */
std::vector<Advice> virtualAdditions(const ObservedBlock& block);

}  // namespace pcl_als
