// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "motion_slope.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/line_sums.h>

namespace pcl_als::detail {
namespace {

// Seconds between compared angles: aircraft roll and pitch within some of them; shorter for short
// series, which then have at least as many independent changes as they need.
constexpr double kShortest = 0.4, kLongest = 2.0, kChanges = 8.0;
constexpr double kFewest = 4.0;       // independent changes: two beyond the unknowns
constexpr double kSystematic = 0.05;  // of a slope: crab and mounting angles at the edge of a swath
// RMS change; less is noise of the attitude and bending of the mount.
constexpr double kMotion = 0.03 * kRadiansPerDegree;

LineSums changesOf(const std::vector<MotionSample>& series, double lag) {
  LineSums changes;
  for (std::size_t i = 0, before = 0; i < series.size(); ++i) {
    while (series[i].time - series[before + 1].time >= lag) ++before;
    const double step = series[i].time - series[before].time;
    if (step < lag || step > 2.0 * lag) continue;
    changes.add(series[i].x - series[before].x, series[i].y - series[before].y);
  }
  return changes;
}

}  // namespace

void MotionSlope::add(const std::vector<MotionSample>& series) {
  if (series.size() < 2) return;
  const double duration = series.back().time - series.front().time;
  const double lag = std::clamp(duration / kChanges, kShortest, kLongest);
  const LineSums c = changesOf(series, lag);
  const double observations = std::min(c.n, duration / lag);
  if (observations < kFewest || c.yy < kMotion * kMotion * c.n) return;
  const double xx = c.sxx(), xy = c.sxy();
  if (!(xx > 0.0)) return;
  const double slope = xy / xx;
  const double left = std::max(0.0, c.syy() - slope * xy) / c.n;
  const double variance = left * c.n / (xx * (observations - 2.0));
  const double weight = 1.0 / (variance + kSystematic * kSystematic);
  weight_ += weight, sum_ += weight * slope, sum_sq_ += weight * slope * slope;
  motion_ += c.xx / c.n;
  ++series_;
}

double MotionSlope::std() const {
  if (series_ == 0) return 0.0;
  const double between = std::max(0.0, sum_sq_ - sum_ * sum_ / weight_);
  const double degrees = static_cast<double>(series_) - 1.0;
  const double factor = degrees > 0.0 ? std::max(1.0, between / degrees) : 1.0;
  return std::sqrt(factor / weight_);
}

double MotionSlope::motionX() const {
  return series_ > 0 ? std::sqrt(motion_ / static_cast<double>(series_)) : 0.0;
}

}  // namespace pcl_als::detail
