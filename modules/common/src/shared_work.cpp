// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <new>
#include <numeric>

#include <pcl_als/common/shared_work.h>

namespace pcl_als {
namespace {

enum class FailureKind : int { usage, input, cancelled, memory, other };

}  // namespace

SharedItems::SharedItems(const Communicator* processes, const std::vector<double>& costs)
    : owner_(costs.size(), 0) {
  if (areShared(processes)) {
    rank_ = processes->rank();
    std::vector<std::size_t> order(costs.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(),
                     [&costs](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
    std::vector<double> load(static_cast<std::size_t>(processes->size()), 0.0);
    for (const std::size_t item : order) {
      const auto least = std::min_element(load.begin(), load.end());
      owner_[item] = static_cast<int>(least - load.begin());
      *least += std::max(costs[item], 1e-9);
    }
  }
  listOwn();
}

SharedItems::SharedItems(const Communicator* processes, std::vector<int> owners)
    : owner_(std::move(owners)), rank_(processes == nullptr ? 0 : processes->rank()) {
  listOwn();
}

void SharedItems::listOwn() {
  for (std::size_t item = 0; item < owner_.size(); ++item)
    if (mine(item)) own_.push_back(item);
}

std::string encodeFailure(const std::exception_ptr& failure) {
  const auto encoded = [](FailureKind kind, const std::string& message, Hint hint) {
    return ByteWriter().put(kind).put(hint).put(message).take();
  };
  try {
    std::rethrow_exception(failure);
  } catch (const UsageError& error) {
    return encoded(FailureKind::usage, error.what(), error.hint());
  } catch (const InputError& error) {
    return encoded(FailureKind::input, error.what(), error.hint());
  } catch (const Cancelled& error) {
    return encoded(FailureKind::cancelled, error.what(), error.hint());
  } catch (const std::bad_alloc&) {
    return encoded(FailureKind::memory, "", Hint::none);
  } catch (const std::exception& error) {
    return encoded(FailureKind::other, error.what(), Hint::none);
  }
}

void throwFailure(const std::string& bytes) {
  ByteReader in(bytes);
  const auto kind = in.take<FailureKind>();
  const auto hint = in.take<Hint>();
  const auto message = in.take<std::string>();
  if (kind == FailureKind::usage) throw UsageError(message, hint);
  if (kind == FailureKind::input) throw InputError(message, hint);
  if (kind == FailureKind::cancelled) throw Cancelled(message, hint);
  if (kind == FailureKind::memory) throw std::bad_alloc();
  throw std::runtime_error(message);
}

void doTogether(Communicator* processes, const std::function<void()>& share) {
  if (!areShared(processes)) {
    share();
    return;
  }
  std::string failure;
  bool by_others = false;
  processes->beginPart();
  try {
    share();
  } catch (const Cancelled&) {
    by_others = !processes->advance(1.0);  // ended because another process failed
    if (!by_others) failure = encodeFailure(std::current_exception());
  } catch (...) {
    failure = encodeFailure(std::current_exception());
  }
  if (!failure.empty()) processes->announceFailure();
  processes->endPart();
  for (const std::string& one : processes->gatherAll(failure))
    if (!one.empty()) throwFailure(one);
}

void shareBytes(Communicator* processes, const SharedItems& items,
                std::vector<std::string>& bytes) {
  if (!areShared(processes)) return;
  ByteWriter out;
  for (const std::size_t item : items.ownItems()) {
    out.put(bytes[item]);
    bytes[item] = {};
  }
  std::vector<std::string> all = processes->gatherAll(out.take());
  std::vector<ByteReader> readers(all.begin(), all.end());
  for (std::size_t item = 0; item < items.count(); ++item)
    readers[static_cast<std::size_t>(items.owner(item))].get(bytes[item]);
}

ProgressCallback sharedProgress(Communicator* processes, ProgressCallback callback) {
  if (!areShared(processes)) return callback;
  return [processes, callback = std::move(callback)](const JobProgress& progress) {
    JobProgress now = progress;
    if (now.event == JobProgress::Event::advance) {
      if (!processes->advance(now.fraction)) return false;
      now.fraction = processes->progress();
    }
    return !processes->isRoot() || !callback || callback(now);
  };
}

}  // namespace pcl_als
