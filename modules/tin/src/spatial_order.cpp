// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "spatial_order.h"

#include <array>
#include <cstddef>
#include <utility>

namespace pcl_als::tin {
namespace {

struct Entry {
  std::uint64_t code;
  std::int32_t point;
};

constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// Spreads the low 32 bits to the even bits.
std::uint64_t spread(std::uint64_t v) {
  v = (v | (v << 16)) & 0x0000ffff0000ffffU;
  v = (v | (v << 8)) & 0x00ff00ff00ff00ffU;
  v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0fU;
  v = (v | (v << 2)) & 0x3333333333333333U;
  return (v | (v << 1)) & 0x5555555555555555U;
}

/// Gathers the even bits: the inverse of spread().
std::uint32_t gather(std::uint64_t v) {
  v &= 0x5555555555555555U;
  v = (v | (v >> 1)) & 0x3333333333333333U;
  v = (v | (v >> 2)) & 0x0f0f0f0f0f0f0f0fU;
  v = (v | (v >> 4)) & 0x00ff00ff00ff00ffU;
  v = (v | (v >> 8)) & 0x0000ffff0000ffffU;
  return static_cast<std::uint32_t>(v | (v >> 16));
}

/// Stable radix sort by code; only as many digits as the largest code has.
void sortByCode(std::vector<Entry>& entries, std::uint64_t largest) {
  std::vector<Entry> sorted(entries.size());
  for (int shift = 0; shift < 64 && (largest >> shift) != 0; shift += kDigitBits) {
    std::array<std::size_t, kDigits> start{};
    for (const Entry& e : entries) ++start[(e.code >> shift) & (kDigits - 1)];
    std::size_t sum = 0;
    for (std::size_t& s : start) sum += std::exchange(s, sum);
    for (const Entry& e : entries) sorted[start[(e.code >> shift) & (kDigits - 1)]++] = e;
    entries.swap(sorted);
  }
}

}  // namespace

PlanPoint planPointOf(std::uint64_t code) {
  return {static_cast<std::int32_t>(gather(code)), static_cast<std::int32_t>(gather(code >> 1))};
}

SpatialOrder spatialOrder(const std::vector<PlanPoint>& points) {
  std::vector<Entry> entries(points.size());
  std::uint64_t all_bits = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto x = static_cast<std::uint32_t>(points[i].x);
    const auto y = static_cast<std::uint32_t>(points[i].y);
    entries[i] = {spread(x) | (spread(y) << 1), static_cast<std::int32_t>(i)};
    all_bits |= entries[i].code;
  }
  sortByCode(entries, all_bits);
  SpatialOrder order;
  order.code.reserve(entries.size());
  order.point.reserve(entries.size());
  for (const Entry& e : entries) {
    if (!order.code.empty() && order.code.back() == e.code) continue;
    order.code.push_back(e.code);
    order.point.push_back(e.point);
  }
  return order;
}

}  // namespace pcl_als::tin
