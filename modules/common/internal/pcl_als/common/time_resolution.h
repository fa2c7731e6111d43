// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <unordered_set>

#include <pcl_als/common/byte_stream.h>

namespace pcl_als {

/** \brief The step to which the GPS times of a strip are rounded, from its points in any order.
 *
 * Every pulse has a time of its own, so that many points per distinct time indicate rounded times
 * (whole seconds, or seconds of the week in 32 bits: 1/32 s). All points of a strip are added, or
 * runs of consecutive points: single points from here and there rarely share a time. The first two
 * thousand distinct times are stored (at most 0.1 MB); later points are not counted. In a block
 * sorted by place, neighbouring points come from few seconds; a step is therefore determined from a
 * thousand points and more only.
 */
class TimeResolution {
 public:
  void add(double time) {
    if (times_.size() >= kMostTimes) return;
    times_.insert(time);
    ++points_;
  }
  /// Adds the points of another part of the strip.
  void add(const TimeResolution& other);

  /// Median distance of neighbouring distinct times, seconds; infinite where all points have one
  /// time; zero where times are not rounded or where there are too few points.
  double step() const;
  std::size_t distinct() const { return times_.size(); }
  std::size_t points() const { return points_; }

  /// "whole seconds (19 distinct values in 72225 points)", "steps of 0.0312 s (…)"; empty where
  /// step() is zero.
  std::string describe() const;

  void put(ByteWriter& out) const {
    out.put(points_).put(std::vector<double>(times_.begin(), times_.end()));
  }
  void get(ByteReader& in) {
    const auto times = in.get(points_).take<std::vector<double>>();
    times_ = {times.begin(), times.end()};
  }

 private:
  static constexpr std::size_t kMostTimes = 2000;

  std::unordered_set<double> times_;
  std::size_t points_ = 0;
};

}  // namespace pcl_als
