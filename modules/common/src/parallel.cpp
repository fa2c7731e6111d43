// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include <pcl_als/common/parallel.h>

namespace pcl_als {

unsigned threadCount(int requested) {
  if (requested > 0) return static_cast<unsigned>(requested);
  return std::max(1U, std::thread::hardware_concurrency());
}

void parallelFor(std::size_t chunk_count, int threads,
                 const std::function<void(std::size_t)>& body) {
  const std::size_t workers = std::min<std::size_t>(threadCount(threads), chunk_count);
  if (workers <= 1) {
    for (std::size_t chunk = 0; chunk < chunk_count; ++chunk) body(chunk);
    return;
  }
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (std::size_t chunk = next++; chunk < chunk_count; chunk = next++) body(chunk);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = chunk_count;
    }
  };
  std::vector<std::thread> pool;
  try {
    for (std::size_t i = 1; i < workers; ++i) pool.emplace_back(work);
  } catch (const std::system_error&) {
    // No memory or permission for another thread: those that there are do the work.
  }
  work();
  for (std::thread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace pcl_als
