// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "spatial_order.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace pcl_als::tin {
namespace {

/// Element of the radix sort: the leading 32 bits of the width of the largest code, and the input
/// index.
struct Entry {
  std::uint32_t leading;
  std::int32_t point;
};

constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

/// Spreads the bits of v to the even bits.
std::uint64_t spread(std::uint64_t v) {
  v = (v | (v << 16)) & 0x0000ffff0000ffffU;
  v = (v | (v << 8)) & 0x00ff00ff00ff00ffU;
  v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0fU;
  v = (v | (v << 2)) & 0x3333333333333333U;
  return (v | (v << 1)) & 0x5555555555555555U;
}

/// Gathers the even bits: the inverse of spread().
std::int32_t gather(std::uint64_t v) {
  v &= 0x5555555555555555U;
  v = (v | (v >> 1)) & 0x3333333333333333U;
  v = (v | (v >> 2)) & 0x0f0f0f0f0f0f0f0fU;
  v = (v | (v >> 4)) & 0x00ff00ff00ff00ffU;
  v = (v | (v >> 8)) & 0x0000ffff0000ffffU;
  return static_cast<std::int32_t>(v | (v >> 16));
}

/// Stable radix sort by the leading bits.
void sortByLeading(std::vector<Entry>& entries) {
  std::vector<Entry> sorted(entries.size());
  for (int shift = 0; shift < 32; shift += kDigitBits) {
    std::array<std::size_t, kDigits> start{};
    for (const Entry& e : entries) ++start[(e.leading >> shift) & (kDigits - 1)];
    std::size_t sum = 0;
    for (std::size_t& s : start) sum += std::exchange(s, sum);
    for (const Entry& e : entries) sorted[start[(e.leading >> shift) & (kDigits - 1)]++] = e;
    entries.swap(sorted);
  }
}

/// Entries by full code, and by input order where that is equal.
std::vector<Entry> sortedEntries(const std::vector<std::uint64_t>& codes) {
  std::uint64_t all_bits = 0;
  for (const std::uint64_t code : codes) all_bits |= code;
  int shift = 0;
  while ((all_bits >> shift) > 0xffffffffU) ++shift;
  std::vector<Entry> entries(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i)
    entries[i] = {static_cast<std::uint32_t>(codes[i] >> shift), static_cast<std::int32_t>(i)};
  sortByLeading(entries);
  // 2^16 x 2^16 cells: few points share one, and those are put in order here.
  const auto by_code = [&](const Entry& a, const Entry& b) {
    return codes[a.point] < codes[b.point];
  };
  for (auto run = entries.begin(); run != entries.end() && shift > 0;) {
    const std::uint32_t leading = run->leading;
    const auto end =
        std::find_if(run + 1, entries.end(), [=](const Entry& e) { return e.leading != leading; });
    if (end - run > 1) std::stable_sort(run, end, by_code);
    run = end;
  }
  return entries;
}

}  // namespace

std::uint64_t mortonCode(PlanPoint p) {
  return spread(static_cast<std::uint32_t>(p.x)) | (spread(static_cast<std::uint32_t>(p.y)) << 1);
}

PlanPoint planPointOf(std::uint64_t code) {
  return {gather(code), gather(code >> 1)};
}

SpatialOrder spatialOrder(const std::vector<std::uint64_t>& codes) {
  const std::vector<Entry> entries = sortedEntries(codes);
  SpatialOrder order;
  order.code.reserve(entries.size());
  order.point.reserve(entries.size());
  for (const Entry& e : entries) {
    const std::uint64_t code = codes[e.point];
    if (!order.code.empty() && order.code.back() == code) continue;
    order.code.push_back(code);
    order.point.push_back(e.point);
  }
  return order;
}

}  // namespace pcl_als::tin
