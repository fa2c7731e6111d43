// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>

#include <pcl_als/common/left_out.h>
#include <pcl_als/common/number_text.h>

namespace pcl_als {
namespace {

const char* sentence(LeftOutReason reason) {
  switch (reason) {
    case LeftOutReason::excluded:
      return "the strip was not chosen";
    case LeftOutReason::zero_time:
      return "their GPS time is 0";
    case LeftOutReason::before_trajectory:
      return "measured before the trajectory begins";
    case LeftOutReason::after_trajectory:
      return "measured after the trajectory ends";
    case LeftOutReason::in_trajectory_gap:
      return "measured in a gap of the trajectory";
    case LeftOutReason::strip_uncovered:
      return "the trajectory covers hardly anything of the strip";
    case LeftOutReason::in_turn:
      return "measured in a turn between strips";
    case LeftOutReason::hovering:
      return "measured while the sensor hovered between strips";
    case LeftOutReason::rounded_times:
      return "their GPS times are rounded";
    case LeftOutReason::too_few_points:
      return "the strip has too few points";
  }
  return "";
}

}  // namespace

std::string_view toString(LeftOutReason reason) {
  switch (reason) {
    case LeftOutReason::excluded:
      return "excluded";
    case LeftOutReason::zero_time:
      return "zero_time";
    case LeftOutReason::before_trajectory:
      return "before_trajectory";
    case LeftOutReason::after_trajectory:
      return "after_trajectory";
    case LeftOutReason::in_trajectory_gap:
      return "in_trajectory_gap";
    case LeftOutReason::strip_uncovered:
      return "strip_uncovered";
    case LeftOutReason::in_turn:
      return "in_turn";
    case LeftOutReason::hovering:
      return "hovering";
    case LeftOutReason::rounded_times:
      return "rounded_times";
    case LeftOutReason::too_few_points:
      return "too_few_points";
  }
  return "";
}

std::string describe(const LeftOutPoints& part) {
  const double percent =
      100.0 * static_cast<double>(part.points) / static_cast<double>(part.of > 0 ? part.of : 1);
  char share[40];
  std::snprintf(share, sizeof share, " (%.3g %%)", percent);
  return "strip " + part.strip + ": " + std::to_string(part.points) + " of " +
         counted(part.of, "point") + share + " left out: " + sentence(part.reason);
}

std::vector<std::string> describe(const std::vector<LeftOutPoints>& parts) {
  std::vector<std::string> lines;
  lines.reserve(parts.size());
  for (const LeftOutPoints& part : parts) lines.push_back(describe(part));
  return lines;
}

}  // namespace pcl_als
