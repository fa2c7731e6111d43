// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "simultaneous_strips.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <unordered_map>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kFewestSeconds = 2;
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// The first two strips with points in a second: of any number of strips each has one of the two as
/// its companion, so that the work does not grow with the number of pairs.
struct Second {
  std::size_t first = kNone, other = kNone;

  void add(std::size_t strip) {
    if (first == kNone)
      first = strip;
    else if (other == kNone)
      other = strip;
  }
  std::size_t companionOf(std::size_t strip) const { return strip == first ? other : first; }
};

/// Whole seconds in which a strip has points, in order; each once.
std::vector<std::int64_t> secondsOf(const std::vector<TimeRange>& ranges) {
  std::vector<std::int64_t> seconds;
  for (const TimeRange& range : ranges) {
    if (range.last == 0.0) continue;  // points without a time
    for (const double time : {range.first, range.last})
      seconds.push_back(static_cast<std::int64_t>(std::floor(time)));
  }
  std::sort(seconds.begin(), seconds.end());
  seconds.erase(std::unique(seconds.begin(), seconds.end()), seconds.end());
  return seconds;
}

}  // namespace

std::vector<std::optional<std::size_t>> simultaneousStrips(
    const std::vector<std::vector<TimeRange>>& times) {
  std::vector<std::vector<std::int64_t>> seconds;
  std::unordered_map<std::int64_t, Second> strips_at;
  for (std::size_t strip = 0; strip < times.size(); ++strip) {
    seconds.push_back(secondsOf(times[strip]));
    for (const std::int64_t second : seconds.back()) strips_at[second].add(strip);
  }
  std::vector<std::optional<std::size_t>> companions(times.size());
  for (std::size_t strip = 0; strip < times.size(); ++strip) {
    if (seconds[strip].size() < kFewestSeconds) continue;
    std::size_t shared = 0;
    std::map<std::size_t, std::size_t> counts;
    for (const std::int64_t second : seconds[strip]) {
      const std::size_t companion = strips_at.at(second).companionOf(strip);
      if (companion == kNone) continue;
      ++shared;
      ++counts[companion];
    }
    if (2 * shared < seconds[strip].size()) continue;
    companions[strip] = std::max_element(counts.begin(), counts.end(), [](auto& a, auto& b) {
                          return a.second < b.second;
                        })->first;
  }
  return companions;
}

}  // namespace pcl_als::detail
