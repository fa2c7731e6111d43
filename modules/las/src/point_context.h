// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace pcl_als::laz {

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
              "LAS is little-endian and read as it lies in memory");

template <typename T>
T load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <typename T>
void store(std::uint8_t* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

/// Sum modulo 2^32.
inline std::int32_t wrappedSum(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
inline std::int32_t wrappedDifference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
inline std::int32_t wrappedProduct(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}

/** \brief Running median of coordinate differences.
 *
 * Of five sorted values a new one replaces the largest or the smallest. Which end is replaced next
 * changes when the new value falls on the other side of the median.
 */
class RunningMedian {
 public:
  std::int32_t value() const { return sorted_[2]; }

  void add(std::int32_t v) {
    auto& s = sorted_;
    const bool replaced_largest = replace_largest_;
    replace_largest_ = replaced_largest ? v < s[2] : v <= s[2];
    if (replaced_largest)
      s = {std::min(s[0], v), between(s[0], v, s[1]), between(s[1], v, s[2]),
           between(s[2], v, s[3]), std::max(s[3], v)};
    else
      s = {std::min(s[1], v), between(s[1], v, s[2]), between(s[2], v, s[3]),
           between(s[3], v, s[4]), std::max(s[4], v)};
  }

 private:
  static std::int32_t between(std::int32_t low, std::int32_t v, std::int32_t high) {
    return std::max(low, std::min(v, high));
  }

  std::array<std::int32_t, 5> sorted_{};
  bool replace_largest_ = true;
};

/// How many returns lie between this one and the last of its pulse.
inline unsigned returnsBelow(unsigned returns, unsigned number) {
  return static_cast<unsigned>(std::abs(static_cast<int>(returns) - static_cast<int>(number)));
}

/// Context of a prediction from how well the one before succeeded: pairs of classes share one.
inline unsigned pairedClass(unsigned correction_class, unsigned most) {
  return correction_class < most ? correction_class & ~1U : most;
}

}  // namespace pcl_als::laz
