// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <chrono>
#include <vector>

#include <pcl_als/common/shared_vectors.h>
#include <pcl_als/processing/delivery_checker.h>

namespace pcl_als {

namespace detail {

using Clock = std::chrono::steady_clock;

inline double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Collective: the differences at all control points.
void shareDifferences(Communicator* processes, const SharedItems& items,
                      std::vector<std::vector<ControlDifference>>& differences);
/// Collective: the alignments of all pairs, and the time that they took.
void shareAlignments(Communicator* processes, const SharedItems& items,
                     std::vector<CheckedPair>& pairs);

}  // namespace detail
}  // namespace pcl_als
