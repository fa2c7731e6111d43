// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>

namespace pcl_als {

/// Number of threads to use for a request: itself when positive, else what the machine has.
unsigned threadCount(int requested);
/// The number of threads of a setting: 0 (all cores, the default everywhere) or more; UsageError
/// for a negative one.
int requiredThreads(int threads);

/** \brief Calls body(chunk) once for every chunk in [0, chunk_count), on up to \a threads threads.
 *
 * Which thread runs a chunk is not fixed; a result that must not depend on the number of threads is
 * kept per chunk and combined in chunk order afterwards. Of the exceptions thrown by bodies that
 * of the first chunk is rethrown here once all threads ended.
 */
void parallelFor(std::size_t chunk_count, int threads,
                 const std::function<void(std::size_t chunk)>& body);

}  // namespace pcl_als
