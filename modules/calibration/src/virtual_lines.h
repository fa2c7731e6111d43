// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include "synthetic_pairs.h"

namespace pcl_als {

/** \brief Possible additions to a block (section 2.2 of Habib et al. 2011); what, line and control
 * are set.
 *
 * For the longest line of each flying height: an opposite line, lines at half and at 1.75 times the
 * height, a crossing line, a parallel line in the same direction with 50 % overlap; and one or nine
 * control points. Additions that the block already has are omitted.
 */
std::vector<Advice> virtualAdditions(const ObservedBlock& block);

}  // namespace pcl_als
