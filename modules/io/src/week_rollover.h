// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/time_alignment.h>

namespace pcl_als::detail {

/// Whether seconds of the week went from the last day of a GPS week to the first of the next.
inline bool isWeekRollover(double before, double after) {
  constexpr double kDay = 86400.0;
  return before >= kSecondsPerWeek - kDay && before < kSecondsPerWeek && after >= 0.0 &&
         after < kDay;
}

/// Lets week seconds run on past 604800 where a trajectory in file order crosses the end of a week
/// once. More crossings than one are not a flight: nothing is changed then.
void unwrapWeek(std::vector<TrajectorySample>& samples);

}  // namespace pcl_als::detail
