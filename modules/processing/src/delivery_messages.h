// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/shared_vectors.h>
#include <pcl_als/processing/delivery_check.h>

namespace pcl_als {

namespace detail {

/// Collective: the differences at all control points.
void shareDifferences(Communicator* processes, const SharedItems& items,
                      std::vector<std::vector<ControlDifference>>& differences);
/// Collective: the alignments of all pairs, and the time that they took.
void shareAlignments(Communicator* processes, const SharedItems& items,
                     std::vector<CheckedPair>& pairs);

}  // namespace detail
}  // namespace pcl_als
