// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/io/point_reader.h>

namespace pcl_als::detail {

/** \brief Counts points that are equal to an earlier one, in constant memory.
 *
 * A point is known by a hash of its content. While there are too many, only points whose hash ends
 * in more zero bits are looked at: both of a pair are, or none, so that the count in the sample
 * times the sampling factor estimates the whole.
 */
class DuplicateSample {
 public:
  void add(const PointChunk& chunk);
  std::uint64_t count() const { return found_ << level_; }
  bool estimated() const { return level_ > 0; }

 private:
  /// Open addressing: a key and how many points with it came after the first.
  struct Slot {
    std::uint64_t key = 0;  ///< 0: empty
    std::uint64_t repeats = 0;
  };
  static constexpr std::size_t kFewestSlots = std::size_t{1} << 12U;
  static constexpr std::size_t kMostSlots = std::size_t{1} << 20U;

  Slot& slotOf(std::uint64_t key);
  void insert(std::uint64_t key, std::uint64_t repeats);
  void makeRoom();  ///< a larger table, or fewer points in it

  std::vector<Slot> slots_;
  std::size_t keys_ = 0;
  std::uint64_t found_ = 0, mask_ = 0;
  unsigned level_ = 0;
};

}  // namespace pcl_als::detail
