// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/number_text.h>

namespace pcl_als {
namespace {

const char* sentence(ExclusionReason reason) {
  switch (reason) {
    case ExclusionReason::excluded:
      return "the strip was not chosen";
    case ExclusionReason::zero_time:
      return "their GPS time is 0";
    case ExclusionReason::before_trajectory:
      return "measured before the trajectory begins";
    case ExclusionReason::after_trajectory:
      return "measured after the trajectory ends";
    case ExclusionReason::in_trajectory_gap:
      return "measured in a gap of the trajectory";
    case ExclusionReason::strip_uncovered:
      return "the trajectory covers hardly anything of the strip";
    case ExclusionReason::in_turn:
      return "measured in a turn between strips";
    case ExclusionReason::hovering:
      return "measured while the sensor hovered between strips";
    case ExclusionReason::rounded_times:
      return "their GPS times are rounded";
    case ExclusionReason::too_few_points:
      return "the strip has too few points";
    case ExclusionReason::copy:
      return "another strip holds the same points";
  }
  return "";
}

}  // namespace

std::string_view toString(ExclusionReason reason) {
  switch (reason) {
    case ExclusionReason::excluded:
      return "excluded";
    case ExclusionReason::zero_time:
      return "zero_time";
    case ExclusionReason::before_trajectory:
      return "before_trajectory";
    case ExclusionReason::after_trajectory:
      return "after_trajectory";
    case ExclusionReason::in_trajectory_gap:
      return "in_trajectory_gap";
    case ExclusionReason::strip_uncovered:
      return "strip_uncovered";
    case ExclusionReason::in_turn:
      return "in_turn";
    case ExclusionReason::hovering:
      return "hovering";
    case ExclusionReason::rounded_times:
      return "rounded_times";
    case ExclusionReason::too_few_points:
      return "too_few_points";
    case ExclusionReason::copy:
      return "copy";
  }
  return "";
}

std::string describe(const ExcludedPoints& part) {
  const double percent =
      100.0 * static_cast<double>(part.points) / static_cast<double>(part.of > 0 ? part.of : 1);
  char share[40];
  std::snprintf(share, sizeof share, " (%.3g %%)", percent);
  return "strip " + part.strip + ": " + std::to_string(part.points) + " of " +
         counted(part.of, "point") + share + " excluded: " + sentence(part.reason);
}

std::vector<std::string> describe(const std::vector<ExcludedPoints>& parts) {
  std::vector<std::string> lines;
  lines.reserve(parts.size());
  for (const ExcludedPoints& part : parts) lines.push_back(describe(part));
  return lines;
}

}  // namespace pcl_als
