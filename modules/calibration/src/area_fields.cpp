// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The points of a strip in AreaMatcher by the value of a field.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/common/statistics.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "area_matcher.h"

namespace pcl_als {

namespace {

/// By point, the sense in which the scan angle changes from the pulse before to the one after: 1 to
/// the left, -1 to the right, 0 where no pulse of the same scan line is near.
std::vector<int> scanDirections(const std::vector<double>& times,
                                const std::vector<Eigen::Vector3d>& points,
                                const Trajectory& trajectory) {
  constexpr double kSameLine = 4.0;  // times the median interval between pulses
  std::vector<std::size_t> order(times.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
  std::vector<double> intervals, angles;
  std::size_t cursor = 0;
  SensorPose pose;
  for (const std::size_t i : order) {
    const bool known = trajectory.poseAt(times[i], pose, cursor);
    angles.push_back(known ? scanGeometry(pose, points[i]).beta : std::nan(""));
  }
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double interval = times[order[k]] - times[order[k - 1]];
    if (interval > 0.0) intervals.push_back(interval);
  }
  std::vector<int> directions(times.size(), 0);
  if (intervals.empty()) return directions;
  const double longest = kSameLine * medianInPlace(intervals);
  const auto step = [&](std::size_t k) {  // to the next point
    const double interval = times[order[k + 1]] - times[order[k]];
    const double change = angles[k + 1] - angles[k];
    return interval > 0.0 && interval <= longest && std::isfinite(change) ? change : 0.0;
  };
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double change = (k > 0 ? step(k - 1) : 0.0) + (k + 1 < order.size() ? step(k) : 0.0);
    directions[order[k]] = change > 0.0 ? 1 : change < 0.0 ? -1 : 0;
  }
  return directions;
}

}  // namespace

std::vector<int> AreaMatcher::StripPart::values(PointField field) const {
  switch (field) {
    case PointField::scanner_channel:
      return {channel.begin(), channel.end()};
    case PointField::user_data:
      return {user_data.begin(), user_data.end()};
    default:
      return {turning.begin(), turning.end()};
  }
}

std::map<int, std::size_t> AreaMatcher::valuesOf(int strip, PointField field) const {
  std::map<int, std::size_t> counts;
  for (const StripPart& part : surfaces_) {
    if (part.strip != strip || part.held()) continue;
    for (const int value : part.values(field)) ++counts[value];
  }
  return counts;
}

AreaMatcher AreaMatcher::divided(int strip, PointField field, const std::vector<int>& values,
                                 std::size_t candidates, double resolution,
                                 const Trajectory& trajectory) const {
  AreaMatcher matcher(area_, values.size());
  matcher.criterion_ = criterion_;
  matcher.source_scale_ = source_scale_;
  for (const StripPart& part : surfaces_) {
    if (part.strip != strip || part.held()) continue;
    std::vector<int> of_points = part.values(field);
    const bool recorded =
        std::any_of(of_points.begin(), of_points.end(), [](int v) { return v != 0; });
    if (field == PointField::scan_direction && !recorded)
      of_points = scanDirections(part.times, part.biased, trajectory);
    for (std::size_t i = 0; i < part.biased.size(); ++i) {
      const auto found = std::find(values.begin(), values.end(), of_points[i]);
      if (found == values.end()) continue;
      StripPart& to = matcher.surfaces_[static_cast<std::size_t>(found - values.begin())];
      to.add(part, i);
    }
  }
  matcher.buildSurfaces(candidates, resolution, trajectory);
  return matcher;
}

}  // namespace pcl_als
