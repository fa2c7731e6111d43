// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "adaptive_model.h"
#include "byte_source.h"

namespace pcl_als::laz {

inline constexpr std::uint32_t kWholeInterval = 0xFFFFFFFFU;
inline constexpr std::uint32_t kShortestInterval = 1U << 24;  ///< shorter ones are scaled by 2^8
inline constexpr unsigned kMostRawBits = 19;                  ///< in one step

/* EntropyDecoder and EntropyEncoder have the same members: x = coder.symbol(model, x) passes x
 * through the coder, whichever way. So one text per item describes both directions. The value that
 * is handed to a decoder is ignored.
 */

/// Range decoder with 32 bits of state (Said, 2004).
class EntropyDecoder {
 public:
  static constexpr bool kEncodes = false;
  using Model = SymbolModel<true>;
  using Record = std::uint8_t*;

  ByteSource& source() { return source_; }
  const ByteSource& source() const { return source_; }
  void start();
  /// Whether the data can end here: an encoder ends them by one or two bytes, which depend on its
  /// interval, and by zeros. Where symbols were decoded from damaged data this is improbable.
  bool ended() const;

  std::uint32_t symbol(Model& model, std::uint32_t /*ignored*/ = 0) {
    const std::uint32_t unit = length_ >> kShareBits;
    const std::uint32_t target = std::min(value_ / unit, kShareOne - 1);
    const std::uint32_t found = model.find(target);
    const std::uint32_t low = model.cumulative(found) * unit;
    if (found != model.last()) length_ = model.cumulative(found + 1) * unit;
    narrow(low, length_ - low);
    model.count(found);
    return found;
  }

  std::uint32_t bit(BitModel& model, std::uint32_t /*ignored*/ = 0) {
    const std::uint32_t middle = model.zeroShare() * (length_ >> kBitShareBits);
    const std::uint32_t found = value_ >= middle ? 1 : 0;
    if (found != 0)
      narrow(middle, length_ - middle);
    else
      narrow(0, middle);
    model.count(found);
    return found;
  }

  /// \param bits 1 to 32, all values equally probable.
  std::uint32_t raw(unsigned bits, std::uint32_t /*ignored*/ = 0) {
    if (bits <= kMostRawBits) return rawStep(bits);
    const std::uint32_t low = rawStep(16);
    return rawStep(bits - 16) << 16 | low;
  }

 private:
  void narrow(std::uint32_t begin, std::uint32_t length) {
    value_ -= begin;
    length_ = length;
    while (length_ < kShortestInterval) {
      value_ = value_ << 8 | source_.next();
      length_ <<= 8;
    }
  }
  std::uint32_t rawStep(unsigned bits);

  std::uint32_t value_ = 0;  ///< relative to the begin of the interval; always < length_
  std::uint32_t length_ = kWholeInterval;
  ByteSource source_;
};

/// Range encoder; its output grows in memory until finish().
class EntropyEncoder {
 public:
  static constexpr bool kEncodes = true;
  using Model = SymbolModel<false>;
  using Record = const std::uint8_t*;

  void start();
  /// Ends the data so that a decoder has read exactly all bytes after the last symbol.
  void finish();
  const std::uint8_t* data() const { return bytes_.data(); }
  std::size_t size() const { return size_; }

  std::uint32_t symbol(Model& model, std::uint32_t value) {
    const std::uint32_t unit = length_ >> kShareBits;
    const std::uint32_t low = model.cumulative(value) * unit;
    if (value != model.last()) length_ = model.cumulative(value + 1) * unit;
    narrow(low, length_ - low);
    model.count(value);
    return value;
  }

  std::uint32_t bit(BitModel& model, std::uint32_t value) {
    const std::uint32_t middle = model.zeroShare() * (length_ >> kBitShareBits);
    if (value != 0)
      narrow(middle, length_ - middle);
    else
      narrow(0, middle);
    model.count(value);
    return value;
  }

  std::uint32_t raw(unsigned bits, std::uint32_t value) {
    if (bits <= kMostRawBits) {
      rawStep(bits, value);
    } else {
      rawStep(16, value & 0xFFFFU);
      rawStep(bits - 16, value >> 16);
    }
    return value;
  }

 private:
  void narrow(std::uint32_t begin, std::uint32_t length) {
    base_ += begin;
    if (base_ < begin) carry();
    length_ = length;
    if (length_ < kShortestInterval) shiftOut();
  }
  /// Puts out the upper bytes of the base that no later symbol changes (but for a carry).
  void shiftOut() {
    if (bytes_.size() - size_ < sizeof base_) bytes_.resize(2 * size_ + 4096);
    const unsigned bytes = static_cast<unsigned>(__builtin_clz(length_)) / 8;  // 1 to 3
    const std::uint32_t upper_first = __builtin_bswap32(base_);
    std::memcpy(&bytes_[size_], &upper_first, sizeof upper_first);
    size_ += bytes;
    base_ <<= 8 * bytes;
    length_ <<= 8 * bytes;
  }
  void rawStep(unsigned bits, std::uint32_t value) {
    const std::uint32_t unit = length_ >> bits;
    narrow(value * unit, unit);
  }
  void carry();

  std::uint32_t base_ = 0, length_ = kWholeInterval;
  std::vector<std::uint8_t> bytes_;
  std::size_t size_ = 0;
};

}  // namespace pcl_als::laz
