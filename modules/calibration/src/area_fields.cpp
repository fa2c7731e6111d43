// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The points of a strip in AreaMatcher by the value of a field.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/common/statistics.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "area_matcher.h"
#include "field_differences.h"

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

/// A square in the middle of an area, with a share of its surface and the same margin.
SurveyArea middleOf(const SurveyArea& area, double share) {
  SurveyArea middle = area;
  middle.size *= std::sqrt(share);
  middle.minimum.array() += 0.5 * (area.size - middle.size);
  return middle;
}

}  // namespace

std::vector<int> AreaMatcher::StripPart::values(PointField field,
                                                const Trajectory& trajectory) const {
  if (field == PointField::scanner_channel) return {channel.begin(), channel.end()};
  if (field == PointField::user_data) return {user_data.begin(), user_data.end()};
  const bool recorded =
      std::any_of(scan_direction.begin(), scan_direction.end(), [](int v) { return v != 0; });
  return recorded ? std::vector<int>(times.size(), 0) : scanDirections(times, biased, trajectory);
}

AreaMatcher::StripPart AreaMatcher::StripPart::within(const SurveyArea& area) const {
  StripPart part;
  part.strip = strip;
  part.rounding = rounding;
  for (std::size_t i = 0; i < biased.size(); ++i)
    if (area.covers(biased[i])) part.add(*this, i);
  return part;
}

std::map<int, std::map<int, std::size_t>> AreaMatcher::valuesOf(
    PointField field, double share, const Trajectory& trajectory) const {
  const SurveyArea middle = middleOf(area_, share);
  std::map<int, std::map<int, std::size_t>> counts;
  for (const StripPart& part : surfaces_) {
    if (part.held()) continue;
    for (const int value : part.within(middle).values(field, trajectory))
      ++counts[part.strip][value];
  }
  return counts;
}

AreaMatcher AreaMatcher::divided(const FieldDivision& division, double share,
                                 std::size_t candidates, double resolution,
                                 const Trajectory& trajectory) const {
  const SurveyArea middle = middleOf(area_, share);
  AreaMatcher matcher(middle, corrected_for_.size() * division.parts());
  matcher.criterion_ = criterion_;
  matcher.source_scale_ = source_scale_;
  const std::vector<int>& values = division.values;
  for (const StripPart& whole : surfaces_) {
    if (whole.held()) continue;
    const StripPart part = whole.within(middle);
    const std::vector<int> of_points = part.values(division.field, trajectory);
    for (std::size_t i = 0; i < part.biased.size(); ++i) {
      const auto found = std::lower_bound(values.begin(), values.end(), of_points[i]);
      if (found == values.end() || *found != of_points[i]) continue;
      const auto k = static_cast<std::size_t>(found - values.begin());
      StripPart& to = matcher.surfaces_[static_cast<std::size_t>(division.partOf(part.strip, k))];
      to.add(part, i);
      to.rounding = part.rounding;
    }
  }
  matcher.buildSurfaces(candidates, resolution, trajectory);
  return matcher;
}

}  // namespace pcl_als
