// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "encoding_queue.h"

#include <algorithm>
#include <system_error>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/thread_limit.h>

namespace pcl_als::laz {
namespace {

constexpr std::size_t kRunsPerThread = 2;

}  // namespace

EncodingQueue::EncodingQueue(const LazSchema& schema, int threads, Output output)
    : schema_(schema), threads_(threadCount(threads)), output_(std::move(output)) {}

EncodingQueue::~EncodingQueue() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (auto& run : runs_)  // after a failure: nothing more is begun
      if (run->stage == EncodingRun::Stage::waiting) run->stage = EncodingRun::Stage::done;
  }
  joinHelpers(true);
}

std::unique_ptr<EncodingRun> EncodingQueue::emptyRun() {
  if (spare_.empty()) return std::make_unique<EncodingRun>();
  std::unique_ptr<EncodingRun> run = std::move(spare_.back());
  spare_.pop_back();
  run->records.clear(), run->ends.clear(), run->bytes.clear(), run->chunk_bytes.clear();
  run->stage = EncodingRun::Stage::waiting;
  return run;
}

void EncodingQueue::submit(std::unique_ptr<EncodingRun> run) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    runs_.push_back(std::move(run));
  }
  startHelper();
  passOn(threads_ > 1 ? kRunsPerThread * threads_ : 0);
}

void EncodingQueue::finish() {
  passOn(0);
  joinHelpers(true);
}

/// Starts another thread where fewer than all encode and one may be reserved.
void EncodingQueue::startHelper() {
  joinHelpers(false);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (helping_ + 1 >= threads_) return;
    const unsigned most = std::max(threads_, threadCount(0)) - 1;
    if (reserveThreads(1, most) == 0) return;
    ++helping_;
  }
  Helper& helper = helpers_.emplace_back();
  try {
    helper.thread = std::thread([this, &helper] {
      while (encodeNext()) {
      }
      releaseThreads(1);
      const std::lock_guard<std::mutex> lock(mutex_);
      --helping_;
      helper.ended = true;
    });
  } catch (const std::system_error&) {
    // No memory or permission for another thread: those that there are do the work.
    helpers_.pop_back();
    releaseThreads(1);
    const std::lock_guard<std::mutex> lock(mutex_);
    --helping_;
  }
}

/// Joins the helpers that have ended, or all.
void EncodingQueue::joinHelpers(bool all) {
  for (auto helper = helpers_.begin(); helper != helpers_.end();) {
    bool ended = all;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ended = ended || helper->ended;
    }
    if (ended) helper->thread.join();
    helper = ended ? helpers_.erase(helper) : std::next(helper);
  }
}

/// Encodes the first run that waits; false where none does.
bool EncodingQueue::encodeNext() {
  EncodingRun* run = nullptr;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto waiting = std::find_if(runs_.begin(), runs_.end(), [](const auto& r) {
      return r->stage == EncodingRun::Stage::waiting;
    });
    if (waiting == runs_.end()) return false;
    run = waiting->get();
    run->stage = EncodingRun::Stage::running;
  }
  try {
    encode(*run);
  } catch (...) {
    run->failure = std::current_exception();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  run->stage = EncodingRun::Stage::done;
  encoded_.notify_one();
  return true;
}

void EncodingQueue::encode(EncodingRun& run) {
  std::unique_ptr<ChunkEncoder> encoder;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!encoders_.empty()) {
      encoder = std::move(encoders_.back());
      encoders_.pop_back();
    }
  }
  if (!encoder) encoder = makeChunkEncoder(schema_);
  std::size_t first = 0;
  for (const std::size_t end : run.ends) {
    const std::size_t before = run.bytes.size();
    encoder->encode(end - first, run.records.data() + first * schema_.recordLength());
    encoder->finish(run.bytes);
    run.chunk_bytes.push_back(static_cast<std::uint32_t>(run.bytes.size() - before));
    first = end;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  encoders_.push_back(std::move(encoder));
}

/// Passes on the runs that are done, in order, until at most so many are left.
void EncodingQueue::passOn(std::size_t most) {
  for (;;) {
    std::unique_ptr<EncodingRun> first;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      if (runs_.empty()) return;
      if (runs_.front()->stage == EncodingRun::Stage::done) {
        first = std::move(runs_.front());
        runs_.pop_front();
      } else if (runs_.size() <= most) {
        return;
      }
    }
    if (first) {
      if (first->failure) std::rethrow_exception(first->failure);
      output_(*first);
      spare_.push_back(std::move(first));
    } else if (!encodeNext()) {
      std::unique_lock<std::mutex> lock(mutex_);
      encoded_.wait(lock, [this] { return runs_.front()->stage == EncodingRun::Stage::done; });
    }
  }
}

}  // namespace pcl_als::laz
