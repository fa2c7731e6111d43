// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/thread_limit.h>

namespace pcl_als::laz {

/// Bytes of records that one item of work decodes or encodes.
inline constexpr std::size_t kRunBytes = std::size_t{1} << 18;

/** \brief Items of work that several threads do ahead, and that one thread takes in order.
 *
 * Helpers are threads beside the one that submits and takes; they are reserved (reserveThreads())
 * while items wait. take() works itself until the first item is done. An exception of the work is
 * rethrown where the item is taken.
 */
template <typename Item>
class OrderedWork {
 public:
  using Work = std::function<void(Item&)>;

  /// \param threads 0: all cores
  OrderedWork(int threads, Work work) : threads_(threadCount(threads)), work_(std::move(work)) {}
  ~OrderedWork() { clear(); }
  OrderedWork(const OrderedWork&) = delete;
  OrderedWork& operator=(const OrderedWork&) = delete;

  unsigned threads() const { return threads_; }
  std::size_t size() const { return entries_.size(); }
  bool firstIsDone() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !entries_.empty() && entries_.front()->stage == Stage::done;
  }

  void submit(Item item) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      entries_.push_back(std::make_unique<Entry>(std::move(item)));
    }
    startHelper();
  }

  /// The first item, done.
  Item take() {
    for (;;) {
      if (firstIsDone()) {
        std::unique_ptr<Entry> first;
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          first = std::move(entries_.front());
          entries_.pop_front();
        }
        if (first->failure) std::rethrow_exception(first->failure);
        return std::move(first->item);
      }
      if (workNext()) continue;
      std::unique_lock<std::mutex> lock(mutex_);
      done_.wait(lock, [this] { return entries_.front()->stage == Stage::done; });
    }
  }

  /// Drops the items that are not begun, waits for the others and drops them, too.
  void clear() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (auto& entry : entries_)
        if (entry->stage == Stage::waiting) entry->stage = Stage::done;
    }
    joinHelpers(true);
    entries_.clear();
  }

 private:
  enum class Stage { waiting, running, done };
  struct Entry {
    explicit Entry(Item i) : item(std::move(i)) {}
    Item item;
    Stage stage = Stage::waiting;
    std::exception_ptr failure;
  };
  /// A thread that works until no item waits.
  struct Helper {
    std::thread thread;
    bool ended = false;
  };

  /// Starts another thread where fewer than all work and one may be reserved.
  void startHelper() {
    joinHelpers(false);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (helping_ + 1 >= threads_) return;
      if (reserveThreads(1, std::max(threads_, threadCount(0)) - 1) == 0) return;
      ++helping_;
    }
    Helper& helper = helpers_.emplace_back();
    try {
      helper.thread = std::thread([this, &helper] {
        while (workNext()) {
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
  void joinHelpers(bool all) {
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

  /// Does the first item that waits; false where none does.
  bool workNext() {
    Entry* entry = nullptr;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const auto waiting = std::find_if(entries_.begin(), entries_.end(),
                                        [](const auto& e) { return e->stage == Stage::waiting; });
      if (waiting == entries_.end()) return false;
      entry = waiting->get();
      entry->stage = Stage::running;
    }
    std::exception_ptr failure;
    try {
      work_(entry->item);
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    entry->failure = failure;
    entry->stage = Stage::done;
    done_.notify_one();
    return true;
  }

  const unsigned threads_;
  const Work work_;
  std::mutex mutex_;
  std::condition_variable done_;
  std::deque<std::unique_ptr<Entry>> entries_;  ///< in order of submission
  std::list<Helper> helpers_;
  unsigned helping_ = 0;
};

}  // namespace pcl_als::laz
