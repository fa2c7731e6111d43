// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "entropy_coder.h"

namespace pcl_als::laz {

void EntropyDecoder::start() {
  length_ = kWholeInterval;
  value_ = 0;
  for (int i = 0; i < 4; ++i) value_ = value_ << 8 | source_.next();
  if (value_ == kWholeInterval) throw Damage("the compressed data do not begin as they must");
}

bool EntropyDecoder::ended() const {
  // The counterpart of EntropyEncoder::finish().
  if (length_ > 2 * kShortestInterval) return value_ >= 1 && value_ <= kShortestInterval;
  constexpr std::uint32_t half = kShortestInterval >> 1;
  return value_ <= half && value_ > half - (1U << 16);
}

std::uint32_t EntropyDecoder::rawStep(unsigned bits) {
  const std::uint32_t unit = length_ >> bits;
  const std::uint32_t found = value_ / unit;
  if (found >> bits != 0) throw Damage("the compressed data hold an impossible value");
  narrow(found * unit, unit);
  return found;
}

void EntropyEncoder::start() {
  base_ = 0;
  length_ = kWholeInterval;
  size_ = 0;
}

void EntropyEncoder::finish() {
  // The shortest number of bytes that names a value of the interval whatever follows.
  const bool one_byte = length_ > 2 * kShortestInterval;
  if (one_byte)
    narrow(kShortestInterval, kShortestInterval >> 1);
  else
    narrow(kShortestInterval >> 1, kShortestInterval >> 9);
  // A decoder is four bytes ahead of the interval.
  bytes_.resize(size_);
  bytes_.resize(size_ + (one_byte ? 3 : 2));
  size_ = bytes_.size();
}

void EntropyEncoder::carry() {
  std::size_t i = size_;
  while (bytes_[--i] == 0xFFU) bytes_[i] = 0;
  ++bytes_[i];
}

}  // namespace pcl_als::laz
