// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "control_coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/survey/offset_from_block.h>

namespace pcl_als {
namespace {

constexpr double kMaximumDistanceOfControl =
    20e3;                              // metres: control of the same project lies nearer
constexpr double kOtherHeight = 10.0;  // metres: relief within a cell of 10 m is mostly smaller

/// Height of a control point above the nearest of the strips below or above it; NaN: there is none.
double heightAbove(const ControlPoint& point, const SurveyMap& map,
                   const std::vector<int>& strips) {
  double nearest = std::numeric_limits<double>::quiet_NaN();
  for (const int strip : strips) {
    const auto lowest = map.lowestAt(strip, point.position);
    if (!lowest) continue;
    const double height = point.position.z() - *lowest;
    if (!(std::abs(nearest) < std::abs(height))) nearest = height;
  }
  return nearest;
}

ControlCoverage besideStrips(const std::vector<ControlPoint>& control, const SurveyMap& map,
                             const std::vector<int>& strips) {
  Eigen::AlignedBox2d block, box;
  for (const int strip : strips) block.extend(map.boxOf(strip));
  for (const ControlPoint& point : control) box.extend(Eigen::Vector2d(point.position.head<2>()));
  const OffsetFromBlock place(box, block);
  ControlCoverage coverage;
  if (place.distance == 0.0) {
    coverage.remark = "none of them lies within a strip";
    return coverage;
  }
  coverage.remark = "they lie " + place.text();
  if (place.distance > kMaximumDistanceOfControl || !place.cause.empty())
    coverage.objection = "control lies " + place.text() +
                         ": give it in the coordinate reference system and unit of the points";
  return coverage;
}

}  // namespace

ControlCoverage coverageOf(const std::vector<ControlPoint>& control, const SurveyMap& map,
                           const std::vector<int>& strips) {
  std::vector<double> heights;
  for (const ControlPoint& point : control) {
    const double height = heightAbove(point, map, strips);
    if (std::isfinite(height)) heights.push_back(height);
  }
  if (control.empty()) return {};
  if (heights.empty()) return besideStrips(control, map, strips);
  const bool far = std::all_of(heights.begin(), heights.end(),
                               [](double height) { return std::abs(height) > kOtherHeight; });
  if (!far) return {};
  const std::size_t count = heights.size();
  const double median = medianInPlace(heights);
  char size[64];
  std::snprintf(size, sizeof size, "%.1f m %s the strips", std::abs(median),
                median > 0.0 ? "above" : "below");
  const std::string text = std::string(size) + " (median of " + counted(count, "point") + ")";
  return {"control lies " + text +
              ": its heights are in another unit, or refer to another vertical datum (ellipsoid or "
              "geoid); give them in that of the points",
          "they lie " + text};
}

}  // namespace pcl_als
