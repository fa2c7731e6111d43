// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "cell_counts.h"

#include <unordered_set>

#include <pcl_als/common/statistics.h>

namespace pcl_als::detail {
namespace {

// Shifts round towards minus infinity, as cells west and south of the origin need it.
BlockKey blockOf(std::int64_t x, std::int64_t y) {
  return {x >> 4, y >> 4};
}

std::size_t placeIn(std::int64_t x, std::int64_t y) {
  return static_cast<std::size_t>((y & 15) * CellCounts::kSide + (x & 15));
}
static_assert(CellCounts::kSide == 16);

}  // namespace

void CellCounts::add(std::int64_t x, std::int64_t y, std::uint32_t count) {
  const BlockKey key = blockOf(x, y);
  if (!last_ || !(key == last_key_)) {
    last_ = &blocks_[key];  // value-initialised: zeros
    last_key_ = key;
  }
  (*last_)[placeIn(x, y)] += count;
}

void CellCounts::add(const CellCounts& other) {
  for (const auto& [key, block] : other.blocks_) {
    Block& mine = blocks_[key];
    for (std::size_t i = 0; i < block.size(); ++i) mine[i] += block[i];
  }
}

std::uint32_t CellCounts::at(std::int64_t x, std::int64_t y) const {
  const auto block = blocks_.find(blockOf(x, y));
  return block == blocks_.end() ? 0 : block->second[placeIn(x, y)];
}

void CellCounts::coarsen(unsigned doublings) {
  CellCounts coarse;
  forEachCell(*this, [&](std::int64_t x, std::int64_t y, std::uint32_t count) {
    coarse.add(x >> doublings, y >> doublings, count);
  });
  blocks_ = std::move(coarse.blocks_);
  last_ = nullptr;
}

std::size_t CellCounts::blockCountAfter(unsigned doublings) const {
  std::unordered_set<BlockKey, BlockHash> coarse;
  for (const auto& entry : blocks_)
    coarse.insert({entry.first.x >> doublings, entry.first.y >> doublings});
  return coarse.size();
}

std::uint64_t CellCounts::occupied() const {
  std::uint64_t cells = 0;
  forEachCell(*this, [&](std::int64_t, std::int64_t, std::uint32_t) { ++cells; });
  return cells;
}

bool CellCounts::surrounded(std::int64_t x, std::int64_t y) const {
  for (std::int64_t dy = -1; dy <= 1; ++dy)
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      if (at(x + dx, y + dy) == 0) return false;
  return true;
}

double CellCounts::typicalCount() const {
  std::vector<double> inner, all;
  forEachCell(*this, [&](std::int64_t x, std::int64_t y, std::uint32_t count) {
    all.push_back(count);
    if (surrounded(x, y)) inner.push_back(count);
  });
  if (all.empty()) return 0.0;
  return medianInPlace(inner.empty() ? all : inner);
}

}  // namespace pcl_als::detail
