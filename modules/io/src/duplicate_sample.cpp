// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "duplicate_sample.h"

#include <algorithm>
#include <cstring>

namespace pcl_als::detail {
namespace {

std::uint64_t bitsOf(double value) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// Stirs a value into a hash so that every bit depends on every other (multiply and fold).
std::uint64_t stir(std::uint64_t hash, std::uint64_t value) {
  hash = (hash ^ value) * 0x9E3779B97F4A7C15ULL;
  return hash ^ (hash >> 32U);
}

std::uint64_t hashOf(const PointChunk& p, std::size_t i) {
  std::uint64_t hash = stir(0, bitsOf(p.x[i]));
  hash = stir(hash, bitsOf(p.y[i]));
  hash = stir(hash, bitsOf(p.z[i]));
  hash = stir(hash, bitsOf(p.gps_time[i]));
  return stir(hash, p.return_number[i] | std::uint64_t{p.point_source_id[i]} << 8U);
}

}  // namespace

void DuplicateSample::add(const PointChunk& chunk) {
  if (slots_.empty()) slots_.resize(kFewestSlots);
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    const std::uint64_t hash = hashOf(chunk, i);
    if ((hash & mask_) != 0) continue;
    insert(hash, 0);
    if (keys_ > slots_.size() / 2) makeRoom();
  }
}

DuplicateSample::Slot& DuplicateSample::slotOf(std::uint64_t key) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = (key >> 32U) & mask;  // the lower bits are those that the mask looks at
  while (slots_[at].key != 0 && slots_[at].key != key) at = (at + 1) & mask;
  return slots_[at];
}

void DuplicateSample::insert(std::uint64_t key, std::uint64_t repeats) {
  key = key == 0 ? ~std::uint64_t{0} & ~mask_ : key;
  Slot& slot = slotOf(key);
  if (slot.key == 0) {
    slot = {key, repeats};
    ++keys_;
    found_ += repeats;
  } else {
    slot.repeats += 1;
    found_ += 1;
  }
}

void DuplicateSample::makeRoom() {
  std::vector<Slot> old(std::min(4 * slots_.size(), kMostSlots));
  if (old.size() == slots_.size()) mask_ = (std::uint64_t{1} << ++level_) - 1;
  old.swap(slots_);
  keys_ = 0;
  found_ = 0;
  for (const Slot& slot : old)
    if (slot.key != 0 && (slot.key & mask_) == 0) insert(slot.key, slot.repeats);
}

}  // namespace pcl_als::detail
