// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <limits>
#include <string>

namespace pcl_als {

inline constexpr double kSecondsPerWeek = 604800.0;

/// Earliest and latest of some times, seconds.
struct TimeRange {
  double first = std::numeric_limits<double>::infinity();
  double last = -std::numeric_limits<double>::infinity();

  bool empty() const { return !(first <= last); }
  void add(double time) {
    if (time < first) first = time;
    if (time > last) last = time;
  }
};

/** \brief How to turn the times of a point file into the trajectory's.
 *
 * time' = time + offset; week seconds that then lie more than half a week outside the trajectory
 * belong to the neighbouring week (a mission across the end of a GPS week).
 */
struct TimeAlignment {
  double offset = 0.0;  ///< seconds
  double wrap_below = -std::numeric_limits<double>::infinity();
  double wrap_above = std::numeric_limits<double>::infinity();
  std::string remark;  ///< what was assumed, for a user; empty when the times agree as they are

  double operator()(double time) const {
    const double shifted = time + offset;
    if (shifted < wrap_below) return shifted + kSecondsPerWeek;
    return shifted > wrap_above ? shifted - kSecondsPerWeek : shifted;
  }
  /// True when no time changes.
  bool identity() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return offset == 0.0 && wrap_below == -infinity && wrap_above == infinity;
  }
};

}  // namespace pcl_als
