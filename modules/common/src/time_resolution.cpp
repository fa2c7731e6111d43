// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <vector>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/common/time_resolution.h>

namespace pcl_als {
namespace {

constexpr std::size_t kFewestPoints = 1000;
/// Twice the returns that a LAS record allows for one pulse.
constexpr std::size_t kManyPerTime = 30;

}  // namespace

void TimeResolution::add(const TimeResolution& other) {
  if (times_.size() >= kMostTimes) return;
  times_.insert(other.times_.begin(), other.times_.end());
  points_ += other.points_;
}

double TimeResolution::step() const {
  if (points_ < kFewestPoints || points_ < kManyPerTime * times_.size()) return 0.0;
  if (times_.size() < 2) return std::numeric_limits<double>::infinity();
  std::vector<double> times(times_.begin(), times_.end());
  std::sort(times.begin(), times.end());
  std::vector<double> steps;
  for (std::size_t i = 1; i < times.size(); ++i) steps.push_back(times[i] - times[i - 1]);
  return medianInPlace(steps);
}

std::string TimeResolution::describe() const {
  const double step = this->step();
  if (step == 0.0) return {};
  char text[64];
  if (std::isinf(step)) {
    std::snprintf(text, sizeof text, "one value");
  } else if (std::abs(step - 1.0) < 1e-6) {
    std::snprintf(text, sizeof text, "whole seconds");
  } else {
    std::snprintf(text, sizeof text, "steps of %.3g s", step);
  }
  return std::string(text) + " (" + counted(distinct(), "distinct value") + " in " +
         counted(points(), "point") + ")";
}

}  // namespace pcl_als
