// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/communicator.h>
#include <pcl_als/common/progress.h>

namespace pcl_als {

/// Work on items that is divided among processes. A null Communicator is a single process.
class SharedItems {
 public:
  SharedItems() = default;  ///< no items
  /// Gives each item to the process that has least to do so far, the most expensive ones first:
  /// the same division in every process. \a costs: by item, in any unit.
  SharedItems(const Communicator* processes, const std::vector<double>& costs);

  /// Items with given owners.
  SharedItems(const Communicator* processes, std::vector<int> owners);

  std::size_t count() const { return owner_.size(); }
  int owner(std::size_t item) const { return owner_[item]; }
  bool mine(std::size_t item) const { return owner_[item] == rank_; }
  const std::vector<std::size_t>& ownItems() const { return own_; }

 private:
  void listOwn();

  std::vector<int> owner_;
  std::vector<std::size_t> own_;
  int rank_ = 0;
};

/// What an exception says, as bytes, so that every process can throw it.
std::string encodeFailure(const std::exception_ptr& failure);
[[noreturn]] void throwFailure(const std::string& bytes);

/** \brief Collective: does this process's share of a job. Where any process fails, all end their
 * shares at their next report of progress and throw the exception of the first one by rank.
 */
void doTogether(Communicator* processes, const std::function<void()>& share);

/// Collective: after it, every process has the bytes of all items from their owners.
void shareBytes(Communicator* processes, const SharedItems& items, std::vector<std::string>& bytes);

/// Collective: the same for values. \a put writes an item to a ByteWriter, \a get reads it from a
/// ByteReader.
template <typename T, typename Put, typename Get>
void shareValues(Communicator* processes, const SharedItems& items, std::vector<T>& values,
                 const Put& put, const Get& get) {
  if (processes == nullptr || processes->size() == 1) return;
  std::vector<std::string> bytes(items.count());
  for (const std::size_t item : items.ownItems()) {
    ByteWriter out;
    put(out, values[item]);
    bytes[item] = out.take();
  }
  shareBytes(processes, items, bytes);
  for (std::size_t item = 0; item < items.count(); ++item) {
    if (items.mine(item)) continue;
    ByteReader in(bytes[item]);
    get(in, values[item]);
    bytes[item] = {};
  }
}

/// Whether there is more than one process.
inline bool areShared(const Communicator* processes) {
  return processes != nullptr && processes->size() > 1;
}
/// Whether this process prints and writes the results of the whole job.
inline bool isRoot(const Communicator* processes) {
  return processes == nullptr || processes->isRoot();
}

/// A callback of a job that is distributed: the root reports the progress of all processes, the
/// others none; the job ends in every process where one fails.
ProgressCallback sharedProgress(Communicator* processes, ProgressCallback callback);

}  // namespace pcl_als
