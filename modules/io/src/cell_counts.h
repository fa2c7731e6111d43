// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace pcl_als::detail {

/// A pointer into the object that holds it: a copy of the object begins without.
template <typename T>
class CachedPlace {
 public:
  CachedPlace() = default;
  CachedPlace(const CachedPlace&) {}
  CachedPlace& operator=(const CachedPlace& other) {
    if (this != &other) place_ = nullptr;
    return *this;
  }
  CachedPlace& operator=(T* place) { return place_ = place, *this; }
  explicit operator bool() const { return place_ != nullptr; }
  T* operator->() const { return place_; }
  T& operator*() const { return *place_; }

 private:
  T* place_ = nullptr;
};

/// Square blocks of cells, named by their integer position.
struct BlockKey {
  std::int64_t x = 0, y = 0;
  bool operator==(const BlockKey& other) const { return x == other.x && y == other.y; }
};
struct BlockHash {
  std::size_t operator()(const BlockKey& key) const {
    const auto mixed = static_cast<std::uint64_t>(key.x) * 0x9E3779B97F4A7C15ULL ^
                       static_cast<std::uint64_t>(key.y) * 0xC2B2AE3D27D4EB4FULL;
    return static_cast<std::size_t>(mixed ^ (mixed >> 29U));
  }
};

/// Points per cell of a square grid, stored where there are any.
class CellCounts {
 public:
  static constexpr std::int64_t kSide = 16;
  using Block = std::array<std::uint32_t, kSide * kSide>;
  using Blocks = std::unordered_map<BlockKey, Block, BlockHash>;

  void add(std::int64_t x, std::int64_t y, std::uint32_t count = 1);
  void add(const CellCounts& other);
  std::uint32_t at(std::int64_t x, std::int64_t y) const;
  const Blocks& blocks() const { return blocks_; }
  std::size_t blockCount() const { return blocks_.size(); }
  /// Joins squares of 2^doublings cells into one.
  void coarsen(unsigned doublings);
  /// How many blocks there would be then.
  std::size_t blockCountAfter(unsigned doublings) const;

  std::uint64_t occupied() const;
  /// Median count of the occupied cells whose eight neighbours are occupied, or of all occupied
  /// cells where there is none; 0 when empty.
  double typicalCount() const;

 private:
  bool surrounded(std::int64_t x, std::int64_t y) const;

  Blocks blocks_;
  BlockKey last_key_;
  CachedPlace<Block> last_;  ///< neighbouring points fall into the same block
};

/// Calls visit(x, y, count) for every occupied cell, in no fixed order.
template <typename Visit>
void forEachCell(const CellCounts& cells, Visit visit) {
  for (const auto& [key, block] : cells.blocks())
    for (std::size_t i = 0; i < block.size(); ++i)
      if (block[i] != 0)
        visit(key.x * CellCounts::kSide + static_cast<std::int64_t>(i) % CellCounts::kSide,
              key.y * CellCounts::kSide + static_cast<std::int64_t>(i) / CellCounts::kSide,
              block[i]);
}

}  // namespace pcl_als::detail
