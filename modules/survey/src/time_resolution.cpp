// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <limits>

#include <pcl_als/survey/time_resolution.h>

namespace pcl_als {
namespace {

constexpr std::size_t kMostTimes = 10'000, kFewestPoints = 1000;
/// Twice the returns that a LAS record allows for one pulse.
constexpr std::size_t kManyPerTime = 30;

}  // namespace

void TimeResolution::add(double time) {
  if (times_.size() >= kMostTimes) return;
  times_.insert(time);
  ++points_;
}

double TimeResolution::step() const {
  if (points_ < kFewestPoints || points_ < kManyPerTime * times_.size()) return 0.0;
  if (times_.size() < 2) return std::numeric_limits<double>::infinity();
  const auto [first, last] = std::minmax_element(times_.begin(), times_.end());
  return (*last - *first) / static_cast<double>(times_.size() - 1);
}

}  // namespace pcl_als
