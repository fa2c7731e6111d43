// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <unordered_set>

namespace pcl_als {

/** \brief The step to which the GPS times of a strip are rounded, from its points in any order.
 *
 * Every pulse has a time of its own, so that many points per distinct time indicate rounded times
 * (whole seconds, or seconds of the week in 32 bits: 1/32 s). The first ten thousand distinct times
 * are stored (at most 0.5 MB); later points are not counted. In a block sorted by place,
 * neighbouring points come from few seconds; a step is therefore determined from a thousand points
 * and more only.
 */
class TimeResolution {
 public:
  void add(double time);

  /// Mean distance of the distinct times, seconds; zero where times are not rounded or where there
  /// are too few points.
  double step() const;
  std::size_t distinct() const { return times_.size(); }
  std::size_t points() const { return points_; }

 private:
  std::unordered_set<double> times_;
  std::size_t points_ = 0;
};

}  // namespace pcl_als
