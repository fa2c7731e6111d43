// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
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

/// Units of a recorded time in a second. Software for robots records Unix time in milli-, micro- or
/// nanoseconds; the ranges are those of the years 2001 to 2286, and no time in seconds is that
/// large.
inline double timeUnitsPerSecond(double recorded) {
  for (const double units : {1e3, 1e6, 1e9})
    if (recorded >= 1e9 * units && recorded < 1e10 * units) return units;
  return 1.0;
}

/// Seconds of a time as a file records it.
inline double secondsOfTime(double recorded) {
  return std::abs(recorded) < 1e12 ? recorded : recorded / timeUnitsPerSecond(recorded);
}

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

  /// \param recorded as the point file has it, in any unit of secondsOfTime().
  double operator()(double recorded) const {
    const double shifted = secondsOfTime(recorded) + offset;
    if (shifted < wrap_below) return shifted + kSecondsPerWeek;
    return shifted > wrap_above ? shifted - kSecondsPerWeek : shifted;
  }
  /// True if no time in seconds changes.
  bool identity() const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return offset == 0.0 && wrap_below == -infinity && wrap_above == infinity;
  }
};

}  // namespace pcl_als
