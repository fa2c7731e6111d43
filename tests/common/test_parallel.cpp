// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/thread_limit.h>

namespace pcl_als {
namespace {

TEST(ParallelFor, RunsEveryChunkOnce) {
  for (const int threads : {0, 1, 2, 7}) {
    std::vector<std::atomic<int>> runs(1000);
    parallelFor(runs.size(), threads, [&](std::size_t chunk) { ++runs[chunk]; });
    for (const auto& count : runs) EXPECT_EQ(count, 1);
  }
}

TEST(ParallelFor, OneThreadGoesInOrder) {
  std::vector<std::size_t> order;
  parallelFor(5, 1, [&](std::size_t chunk) { order.push_back(chunk); });
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4}));
}

TEST(ParallelFor, NoChunksNoCalls) {
  parallelFor(0, 4, [](std::size_t) { FAIL() << "called without chunks"; });
}

TEST(ParallelFor, RethrowsTheExceptionOfABody) {
  for (const int threads : {1, 4}) {
    try {
      parallelFor(100, threads, [](std::size_t chunk) {
        if (chunk == 37) throw std::runtime_error("chunk 37");
      });
      FAIL() << "no exception with " << threads << " threads";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "chunk 37");
    }
  }
}

// Chunk 1 fails while chunk 0 still runs: the message that users see is that of chunk 0.
TEST(ParallelFor, RethrowsTheExceptionOfTheFirstChunk) {
  std::atomic<bool> failed{false};
  try {
    parallelFor(2, 2, [&](std::size_t chunk) {
      if (chunk == 1) failed = true;
      for (int i = 0; chunk == 0 && !failed && i < 1000; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (chunk == 0) std::this_thread::sleep_for(std::chrono::milliseconds(20));
      throw std::runtime_error("chunk " + std::to_string(chunk));
    });
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "chunk 0");
  }
}

TEST(ParallelFor, StopsSoonAfterAnException) {
  std::atomic<int> runs{0};
  EXPECT_THROW(parallelFor(1000000, 2,
                           [&](std::size_t) {
                             ++runs;
                             throw std::logic_error("stop");
                           }),
               std::logic_error);
  EXPECT_LE(runs, 2);  // one for each thread
}

TEST(ParallelFor, SumPerChunkIsTheSameForAnyNumberOfThreads) {
  const auto sum = [](int threads) {
    std::vector<double> part(64);
    parallelFor(part.size(), threads, [&](std::size_t chunk) {
      for (int i = 1; i <= 1000; ++i) part[chunk] += 1.0 / (static_cast<double>(chunk) * 1000 + i);
    });
    double total = 0.0;
    for (const double value : part) total += value;
    return total;
  };
  EXPECT_EQ(sum(1), sum(8));  // to the last bit: combined in chunk order
}

/// The largest number of bodies that run at once, of an inner loop in each body of an outer one.
int mostAtOnce(int outer, int inner) {
  std::atomic<int> running{0}, most{0};
  parallelFor(8, outer, [&](std::size_t) {
    parallelFor(8, inner, [&](std::size_t) {
      const int now = ++running;
      int known = most;
      while (known < now && !most.compare_exchange_weak(known, now)) {
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --running;
    });
  });
  return most;
}

TEST(ThreadLimit, HoldsForDividedWorkInDividedWork) {
  for (const int limit : {1, 2, 3}) {
    limitThreads(limit);
    EXPECT_EQ(threadCount(0), static_cast<unsigned>(limit));
    EXPECT_LE(mostAtOnce(0, 0), limit);
    EXPECT_LE(mostAtOnce(limit, 0), limit);
    EXPECT_LE(mostAtOnce(1, limit), limit);
  }
  limitThreads(0);
  EXPECT_GT(mostAtOnce(4, 1), 1);  // a request of its own may exceed the number of cores
}

TEST(ThreadLimit, ReservationsAreReturned) {
  EXPECT_EQ(reserveThreads(3, 2), 2U);
  EXPECT_EQ(reserveThreads(1, 2), 0U);
  EXPECT_EQ(reserveThreads(1, 3), 1U);
  releaseThreads(3);
  EXPECT_EQ(reserveThreads(1, 1), 1U);
  releaseThreads(1);
}

TEST(ThreadCount, TakesTheRequestOrTheMachine) {
  EXPECT_EQ(threadCount(3), 3U);
  EXPECT_GE(threadCount(0), 1U);
}

}  // namespace
}  // namespace pcl_als
