// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include <pcl_als/las/laz_schema.h>

#include "chunk_coder.h"

namespace pcl_als::laz {

/// Consecutive chunks that one thread encodes.
struct EncodingRun {
  std::vector<std::uint8_t> records;
  std::vector<std::size_t> ends;  ///< of the complete chunks, in points of this run

  std::vector<std::uint8_t> bytes;         ///< encoded
  std::vector<std::uint32_t> chunk_bytes;  ///< of each chunk
  enum class Stage { waiting, running, done } stage = Stage::waiting;
  std::exception_ptr failure;

  std::size_t points(std::size_t record_length) const { return records.size() / record_length; }
  std::size_t ended() const { return ends.empty() ? 0 : ends.back(); }
};

/** \brief Encodes chunks on several threads while the caller prepares the next ones.
 *
 * Runs are passed on in the order in which they were submitted, by the thread that submits. That
 * thread encodes, too, where twice as many runs as threads wait; helpers beside it are reserved
 * (reserveThreads()) while there is work for them.
 */
class EncodingQueue {
 public:
  using Output = std::function<void(const EncodingRun&)>;

  /// \param threads 0: all cores
  EncodingQueue(const LazSchema& schema, int threads, Output output);
  ~EncodingQueue();

  /// A run to be filled, with the memory of one that was passed on.
  std::unique_ptr<EncodingRun> emptyRun();
  void submit(std::unique_ptr<EncodingRun> run);
  /// Encodes and passes on all runs.
  void finish();

 private:
  /// A thread that encodes until no run waits.
  struct Helper {
    std::thread thread;
    bool ended = false;
  };
  void startHelper();
  void joinHelpers(bool all);
  bool encodeNext();
  void encode(EncodingRun& run);
  void passOn(std::size_t most);

  const LazSchema& schema_;
  const unsigned threads_;
  const Output output_;
  std::mutex mutex_;
  std::condition_variable encoded_;
  std::deque<std::unique_ptr<EncodingRun>> runs_;  ///< in order of submission
  std::vector<std::unique_ptr<EncodingRun>> spare_;
  std::vector<std::unique_ptr<ChunkEncoder>> encoders_;
  std::list<Helper> helpers_;
  unsigned helping_ = 0;
};

}  // namespace pcl_als::laz
