// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "adaptive_model.h"

namespace pcl_als::laz {
namespace {

constexpr std::uint32_t kUnity = 1U << 31;
constexpr std::uint32_t kLargestAlphabetWithoutIndex = 4;

std::uint32_t nextCycle(std::uint32_t cycle, std::uint32_t longest) {
  return std::min(cycle + cycle / 4, longest);
}

}  // namespace

void BitModel::update() {
  constexpr std::uint32_t most = 1U << kBitShareBits, longest = 64;
  total_ += cycle_;
  if (total_ > most) {
    total_ = (total_ + 1) / 2;
    zeros_ = (zeros_ + 1) / 2;
    if (zeros_ == total_) ++total_;
  }
  share_ = (kUnity / total_ * zeros_) >> (31 - kBitShareBits);
  cycle_ = nextCycle(cycle_, longest);
  until_update_ = cycle_;
}

template <bool kSearch>
void SymbolModel<kSearch>::allocate(std::uint32_t symbols) {
  symbols_ = symbols;
  std::size_t buckets = 0;
  if (kSearch && symbols > kLargestAlphabetWithoutIndex) {
    // About one symbol per bucket: updates get dearer by less than searches get cheaper.
    bucket_bits_ = digits(symbols - 1);
    buckets = (std::size_t{1} << bucket_bits_) + 1;
  }
  storage_ = std::make_unique<std::uint16_t[]>(2 * std::size_t{symbols} + buckets);
  cumulative_ = storage_.get();
  counts_ = cumulative_ + symbols;
  firsts_ = counts_ + symbols;
}

template <bool kSearch>
void SymbolModel<kSearch>::reset(std::uint32_t symbols) {
  if (symbols_ != symbols) allocate(symbols);
  std::fill(counts_, counts_ + symbols_, std::uint16_t{1});
  total_ = symbols_;
  spread();
  cycle_ = (symbols_ + 6) / 2;
  until_update_ = cycle_;
}

template <bool kSearch>
void SymbolModel<kSearch>::update() {
  total_ += cycle_;
  if (total_ > kShareOne) {
    total_ = 0;
    for (std::uint32_t s = 0; s < symbols_; ++s) {
      counts_[s] = static_cast<std::uint16_t>((counts_[s] + 1U) / 2);
      total_ += counts_[s];
    }
  }
  spread();
  cycle_ = nextCycle(cycle_, (symbols_ + 6) * 8);
  until_update_ = cycle_;
}

/// Cumulative shares of the counts.
template <bool kSearch>
void SymbolModel<kSearch>::spread() {
  const std::uint32_t scale = kUnity / total_;
  std::uint32_t below = 0;
  for (std::uint32_t s = 0; s < symbols_; ++s) {
    cumulative_[s] = static_cast<std::uint16_t>((scale * below) >> (31 - kShareBits));
    below += counts_[s];
  }
  if (bucket_bits_ > 0) index();
}

template <bool kSearch>
void SymbolModel<kSearch>::index() {
  const std::uint32_t buckets = 1U << bucket_bits_, width = kShareOne >> bucket_bits_;
  std::uint32_t symbol = 0;
  for (std::uint32_t bucket = 0; bucket <= buckets; ++bucket) {
    while (symbol + 1 < symbols_ && cumulative_[symbol + 1] <= bucket * width) ++symbol;
    firsts_[bucket] = static_cast<std::uint16_t>(symbol);
  }
}

template class SymbolModel<false>;
template class SymbolModel<true>;

}  // namespace pcl_als::laz
