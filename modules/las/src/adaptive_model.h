// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_als::laz {

inline constexpr unsigned kShareBits = 15;     ///< shares of symbols are multiples of 2^-15
inline constexpr unsigned kBitShareBits = 13;  ///< shares of the two values of a bit
inline constexpr std::uint32_t kShareOne = 1U << kShareBits;

/// Number of binary digits of a value; 0 of 0.
inline unsigned digits(std::uint32_t value) {
  return value == 0 ? 0U : 32U - static_cast<unsigned>(__builtin_clz(value));
}

/// Adaptive share of zeros of a binary decision; brought up to date at growing intervals.
class BitModel {
 public:
  std::uint32_t zeroShare() const { return share_; }
  void count(std::uint32_t bit) {
    zeros_ += bit == 0U ? 1U : 0U;
    if (--until_update_ == 0) update();
  }
  void reset() { *this = BitModel(); }

 private:
  void update();

  std::uint32_t zeros_ = 1, total_ = 2, share_ = 1U << (kBitShareBits - 1), cycle_ = 4,
                until_update_ = 4;
};

/** \brief Adaptive shares of the symbols 0 … n-1 (A. Said, 2004: Introduction to arithmetic
 * coding).
 *
 * Counts start at one each. The cumulative shares are computed again after a number of symbols that
 * grows by a quarter each time up to 8 (n + 6); counts are halved where their sum passes 2^15. Both
 * sides of a file follow this schedule exactly, so it is a part of the format.
 *
 * \tparam kSearch the model finds symbols by their share (decoding).
 */
template <bool kSearch>
class SymbolModel {
 public:
  void reset(std::uint32_t symbols);

  std::uint32_t last() const { return symbols_ - 1; }
  /// Sum of the shares of all symbols below \a symbol.
  std::uint32_t cumulative(std::uint32_t symbol) const { return cumulative_[symbol]; }
  void count(std::uint32_t symbol) {
    ++counts_[symbol];
    if (--until_update_ == 0) update();
  }

  /// The symbol whose range of shares holds \a target < 2^15.
  std::uint32_t find(std::uint32_t target) const {
    std::uint32_t low = 0, high = symbols_;
    if (bucket_bits_ > 0) {
      const std::uint32_t bucket = target >> (kShareBits - bucket_bits_);
      low = firsts_[bucket];
      high = firsts_[bucket + 1] + 1U;
    }
    while (high - low > 1) {
      const std::uint32_t middle = (low + high) / 2;
      (cumulative_[middle] > target ? high : low) = middle;
    }
    return low;
  }

 private:
  void allocate(std::uint32_t symbols);
  void update();
  void spread();
  void index();

  std::uint32_t symbols_ = 0, total_ = 0, cycle_ = 0, until_update_ = 0;
  unsigned bucket_bits_ = 0;
  std::uint16_t* cumulative_ = nullptr;
  std::uint16_t* counts_ = nullptr;
  std::uint16_t* firsts_ = nullptr;  ///< per bucket of shares: the symbol at its lower end
  std::unique_ptr<std::uint16_t[]> storage_;
};

extern template class SymbolModel<false>;
extern template class SymbolModel<true>;

/// Models of one alphabet, each made when it is first used after a reset.
template <class Model>
class ModelSet {
 public:
  ModelSet(std::size_t models, std::uint32_t symbols) : symbols_(symbols), slots_(models) {}

  void reset() { ++epoch_; }
  Model& operator[](std::size_t i) {
    Slot& slot = slots_[i];
    if (slot.epoch != epoch_) begin(slot);
    return slot.model;
  }

 private:
  struct Slot {
    Model model;
    std::uint64_t epoch = 0;
  };
  void begin(Slot& slot) {
    slot.model.reset(symbols_);
    slot.epoch = epoch_;
  }

  std::uint32_t symbols_;
  std::uint64_t epoch_ = 1;
  std::vector<Slot> slots_;
};

}  // namespace pcl_als::laz
