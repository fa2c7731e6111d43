// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <pcl_als/common/parallel.h>
#include <pcl_als/processing/waveform_job.h>

namespace pcl_als::detail {

/// Decomposes the pulses of blocks on several threads; records are written in the order of the
/// pulses. \tparam Writer makes records of pulses, one for each thread
template <typename Writer>
class BlockDecomposition {
 public:
  /// \param make makes a writer \param write takes the records of consecutive pulses
  BlockDecomposition(const std::function<Writer()>& make,
                     std::function<void(const std::vector<std::byte>&)> write, int threads)
      : write_(std::move(write)), threads_(threads) {
    const unsigned workers = threadCount(threads_);
    for (unsigned i = 0; i < workers; ++i) workers_.push_back({make(), {}, {}});
  }

  /// \param append called with a writer, the index of a pulse, the records to which those of the
  /// pulse are appended, and the counts to which it is added
  template <typename Append>
  void take(std::size_t pulses, const Append& append) {
    const std::size_t together = workers_.size() * kPulsesTogether;
    for (std::size_t from = 0; from < pulses; from += together) {
      const std::size_t to = std::min(pulses, from + together);
      const std::size_t chunks = (to - from + kPulsesTogether - 1) / kPulsesTogether;
      parallelFor(chunks, threads_, [&](std::size_t chunk) {
        Worker& worker = workers_[chunk];
        worker.records.clear();
        const std::size_t begin = from + chunk * kPulsesTogether;
        for (std::size_t i = begin; i < std::min(to, begin + kPulsesTogether); ++i)
          append(worker.writer, i, worker.records, worker.counts);
      });
      for (std::size_t chunk = 0; chunk < chunks; ++chunk) finish(workers_[chunk]);
    }
  }
  const WaveformCounts& counts() const { return counts_; }

 private:
  /// Pulses that a thread decomposes at once.
  static constexpr std::size_t kPulsesTogether = 512;

  struct Worker {
    Writer writer;
    std::vector<std::byte> records;
    WaveformCounts counts;
  };

  void finish(Worker& worker) {
    if (!worker.records.empty()) write_(worker.records);
    counts_.merge(worker.counts);
    worker.counts = {};
  }

  std::function<void(const std::vector<std::byte>&)> write_;
  const int threads_;
  std::vector<Worker> workers_;
  WaveformCounts counts_;
};

}  // namespace pcl_als::detail
