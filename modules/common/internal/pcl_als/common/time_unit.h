// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>

namespace pcl_als {

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

}  // namespace pcl_als
