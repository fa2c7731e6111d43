// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/statistics.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/height_check.h>

#include "coordinate_cause.h"

namespace pcl_als {
namespace {

constexpr double kFewest = 200.0;  // points
// standard deviation of the angles from the trajectory
constexpr double kNarrow = 3.0 * kRadiansPerDegree;
constexpr double kLargestMisfit = 0.6 * kRadiansPerDegree;  // whole degrees leave 0.29
constexpr double kLargestAngle = 75.0 * kRadiansPerDegree;
// Of real trajectories that are right to a metre or two at 400 m the slopes are 0.996 to 1.006.
constexpr double kAccepted = 0.015;
constexpr double kGross = 0.25;
// Slopes of angles of the mirror, which are half of those of the pulses, or the reverse, in swaths
// of up to 40 degrees: another convention of angles.
constexpr double kHalfLeast = 0.42, kHalfMost = 0.52, kTwiceLeast = 1.95, kTwiceMost = 2.4;
// ratio of flying heights: errors of heights and of angles are separable
constexpr double kTwoHeights = 1.3;

bool isGross(double slope) {
  const bool half = slope > kHalfLeast && slope < kHalfMost;
  const bool twice = slope > kTwiceLeast && slope < kTwiceMost;
  return std::abs(slope - 1.0) > kGross && !half && !twice;
}

/// Whether an offset may be that between ellipsoidal heights and heights above a geoid.
bool isUndulation(const HeightError& error) {
  const double metres = std::abs(error.metres);
  return error.kind != HeightError::Kind::gross && metres > detail::kLeastUndulation &&
         metres < detail::kLargestUndulation;
}

}  // namespace

double HeightCheck::Line::slope() const {
  return sxx() > 0.0 ? std::abs(sxy() / sxx()) : 0.0;
}

double HeightCheck::Line::residual() const {
  if (!(sxx() > 0.0)) return 0.0;
  return std::sqrt(std::max(0.0, syy() - sxy() * sxy() / sxx()) / n);
}

double HeightCheck::Line::spread() const {
  return std::sqrt(std::max(0.0, syy()) / n);
}

void HeightCheck::add(double lateral, double along, double height, double scan_angle) {
  if (!(height > 0.0) || !(std::abs(scan_angle) < kLargestAngle)) return;
  const double recorded = std::tan(scan_angle);
  across_.add(lateral / height, recorded);
  in_plane_.add(lateral / std::hypot(height, along), recorded);
  height_sum_ += height;
}

const HeightCheck::Line& HeightCheck::better() const {
  const bool across = std::abs(across_.slope() - 1.0) <= std::abs(in_plane_.slope() - 1.0);
  return across ? across_ : in_plane_;
}

bool HeightCheck::judged() const {
  if (across_.n < kFewest) return false;
  const Line& line = better();
  return line.spread() > kNarrow && line.residual() < kLargestMisfit && line.slope() > 0.0;
}

HeightError heightError(const std::vector<HeightCheck>& strips) {
  HeightError found;
  std::vector<double> slopes, errors, heights;
  for (const HeightCheck& strip : strips) {
    if (!strip.judged()) continue;
    slopes.push_back(strip.slope()), errors.push_back(strip.error());
    heights.push_back(strip.height());
  }
  if (slopes.empty()) return found;
  const auto [least, most] = std::minmax_element(slopes.begin(), slopes.end());
  const bool high = *least > 1.0 + kAccepted, low = *most < 1.0 - kAccepted;
  if (!high && !low) return found;
  const auto spreadOf = [](const std::vector<double>& values) {
    const auto [from, to] = std::minmax_element(values.begin(), values.end());
    return (*to - *from) / std::max(std::abs(*from), std::abs(*to));
  };
  std::vector<double> scales;
  for (const double slope : slopes) scales.push_back(slope - 1.0);
  // The factor of angles would be the same at all heights, the offset of heights is in metres.
  const auto [lowest, highest] = std::minmax_element(heights.begin(), heights.end());
  const bool heights_differ = *highest > kTwoHeights * *lowest;
  const bool offset = heights_differ && spreadOf(errors) < 0.5 * spreadOf(scales);
  found.slope = medianInPlace(slopes);
  found.metres = medianInPlace(errors);
  found.kind = isGross(found.slope) ? HeightError::Kind::gross
               : offset             ? HeightError::Kind::offset
                                    : HeightError::Kind::scale;
  found.undulation = isUndulation(found);
  char text[600];
  std::snprintf(
      text, sizeof text,
      "the trajectory is %.0f m too %s by the recorded scan angles (their tangents are %.3f of "
      "those computed from it at %zu strips)%s: check the unit, the vertical datum and the "
      "reference point of its heights%s; lever_arm_x, lever_arm_y and range_bias depend on them",
      std::abs(found.metres), high ? "high" : "low", found.slope, errors.size(),
      found.kind == HeightError::Kind::scale
          ? ", unless the recorded angles are wrong by this factor"
          : "",
      found.undulation ? " (an offset as between ellipsoidal heights and heights above a geoid, "
                         "whose undulation can be given)"
                       : "");
  found.text = text;
  return found;
}

}  // namespace pcl_als
