// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "coordinate_cause.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include <pcl_als/common/zone_difference.h>

namespace pcl_als::detail {
namespace {

using Eigen::Vector3d;

constexpr double kFoot = 0.3048;                   // metres
constexpr double kLowest = 10.0, kHighest = 20e3;  // metres above the points
constexpr double kBeside = 2.0;                    // heights
constexpr double kFirstLeapSeconds = 13.0,
                 kLastLeapSeconds = 19.0;  // UTC since 2006 and for some years

bool fits(const Vector3d& sensor, const Vector3d& points) {
  const Vector3d d = sensor - points;
  return d.z() > kLowest && d.z() < kHighest && d.head<2>().norm() < kBeside * d.z();
}

}  // namespace

std::string coordinateCause(const Vector3d& sensor, const Vector3d& points) {
  const Vector3d &s = sensor, &p = points;
  const double million = 1e6 * std::round((p.x() - s.x()) / 1e6);
  const std::vector<std::pair<Vector3d, const char*>> tried = {
      {{s.y(), s.x(), s.z()}, "it would lie above them with x and y exchanged"},
      {{s.z(), s.y(), s.x()}, "it would lie above them with x and z exchanged"},
      {{s.x(), s.z(), s.y()}, "it would lie above them with y and z exchanged"},
      {s * kFoot, "it would lie above them with its coordinates in feet"},
      {s / kFoot, "it would lie above them with theirs in feet"},
      {{s.x(), s.y(), s.z() / kFoot}, "it would lie above them with their heights in feet"},
      {{s.x() + million, s.y(), s.z()},
       "it would lie above them with another number of the zone before its eastings"},
  };
  std::string cause;
  for (const auto& [position, text] : tried) {
    if (!fits(position, points)) continue;
    if (!cause.empty()) return {};
    cause = text;
  }
  if (!cause.empty()) return cause;
  return zoneDifference(sensor.head<2>(), points.head<2>());
}

Warning timeCause(double seconds_ahead) {
  const double seconds = std::abs(seconds_ahead);
  if (seconds < kFirstLeapSeconds - 0.5 || seconds > kLastLeapSeconds + 0.5) return "";
  char text[160];
  std::snprintf(text, sizeof text,
                "%.1f s of flight, as if the times of the %s were UTC, which lags GPS time by 18 s "
                "since 2017",
                seconds, seconds_ahead > 0.0 ? "points" : "trajectory");
  return {text, seconds_ahead > 0.0 ? Hint::none : Hint::leap_seconds};
}

}  // namespace pcl_als::detail
