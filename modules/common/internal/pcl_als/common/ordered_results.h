// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <pcl_als/common/parallel.h>

namespace pcl_als {

/** \brief Calls take(i, compute(i)) for i = 0 … count - 1 in this order, for any number of threads.
 *
 * compute() runs on up to \a threads threads (0: all cores); at most 64 results exist at a time, so
 * that the memory of large results does not grow with \a count.
 */
template <typename Compute, typename Take>
void computeInOrder(std::size_t count, int threads, const Compute& compute, const Take& take) {
  constexpr std::size_t kBatch = 64;
  for (std::size_t first = 0; first < count; first += kBatch) {
    std::vector<decltype(compute(first))> results(std::min(kBatch, count - first));
    parallelFor(results.size(), threads, [&](std::size_t i) { results[i] = compute(first + i); });
    for (std::size_t i = 0; i < results.size(); ++i) take(first + i, results[i]);
  }
}

}  // namespace pcl_als
