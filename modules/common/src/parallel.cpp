// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/thread_limit.h>

namespace pcl_als {
namespace {

std::atomic<int> limit{0};          // 0: the number of cores
std::atomic<unsigned> reserved{0};  // threads beside their callers

/// Of the failures of several chunks that of the first one. Chunks are begun in order, so it is the
/// same one however threads are scheduled.
class FirstFailure {
 public:
  void keep(std::size_t chunk, std::exception_ptr failure) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (failure_ && chunk_ < chunk) return;
    chunk_ = chunk;
    failure_ = std::move(failure);
  }
  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::mutex mutex_;
  std::size_t chunk_ = 0;
  std::exception_ptr failure_;
};

}  // namespace

void limitThreads(int most) {
  limit = most;
}

unsigned threadCount(int requested) {
  const int count = requested > 0 ? requested : limit.load();
  if (count > 0) return static_cast<unsigned>(count);
  return std::max(1U, std::thread::hardware_concurrency());
}

int requiredThreads(int threads) {
  if (threads >= 0) return threads;
  throw UsageError("number of threads: must be 0 (all cores) or more, not " +
                   std::to_string(threads));
}

unsigned reserveThreads(unsigned wanted, unsigned most) {
  unsigned busy = reserved;
  for (;;) {
    const unsigned granted = busy < most ? std::min(wanted, most - busy) : 0;
    if (granted == 0 || reserved.compare_exchange_weak(busy, busy + granted)) return granted;
  }
}

void releaseThreads(unsigned count) {
  reserved -= count;
}

void parallelFor(std::size_t chunk_count, int threads,
                 const std::function<void(std::size_t)>& body) {
  const std::size_t workers = std::min<std::size_t>(threadCount(threads), chunk_count);
  const unsigned most = std::max(threadCount(threads), threadCount(0)) - 1;
  const unsigned helpers =
      workers > 1 ? reserveThreads(static_cast<unsigned>(workers) - 1, most) : 0;
  if (helpers == 0) {
    for (std::size_t chunk = 0; chunk < chunk_count; ++chunk) body(chunk);
    return;
  }
  std::atomic<std::size_t> next{0};
  FirstFailure failure;
  const auto work = [&] {
    std::size_t chunk = next++;
    try {
      for (; chunk < chunk_count; chunk = next++) body(chunk);
    } catch (...) {
      failure.keep(chunk, std::current_exception());
      next = chunk_count;
    }
  };
  const auto help = [&work] {
    work();
    releaseThreads(1);
  };
  std::vector<std::thread> pool;
  try {
    while (pool.size() < helpers) pool.emplace_back(help);
  } catch (const std::system_error&) {
    // No memory or permission for another thread: those that there are do the work.
    releaseThreads(helpers - static_cast<unsigned>(pool.size()));
  }
  work();
  for (std::thread& thread : pool) thread.join();
  failure.rethrow();
}

}  // namespace pcl_als
