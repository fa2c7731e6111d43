// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// The attitude of a trajectory against its course and the points.
#include <cstdio>

#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "attitude_comparison.h"

namespace pcl_als {
namespace {

constexpr std::size_t kFewestHeadings = 50;

}  // namespace

void TrajectoryPlausibility::checkHeading(std::vector<Finding>& findings) const {
  HeadingCheck all;
  for (const Strip& strip : strips_) {
    if (strip.used) all.merge(strip.heading);
  }
  if (all.count() < kFewestHeadings || all.followsCourse()) return;
  const HeadingReading best = all.best();
  char text[480];
  if (all.deviation(best) <= HeadingCheck::kLargestCrab && !all.constant()) {
    std::snprintf(text, sizeof text,
                  "the heading of the trajectory does not follow its course (%.0f degrees away), "
                  "but would as %s: give roll, pitch and heading in degrees, heading clockwise "
                  "from grid north",
                  all.deviation(HeadingReading::heading), std::string(describe(best)).c_str());
  } else {
    std::snprintf(text, sizeof text,
                  "the heading of the trajectory does not follow its course (%.0f degrees away)%s: "
                  "give the attitude of this flight in degrees, heading clockwise from grid north",
                  all.deviation(HeadingReading::heading),
                  all.constant() ? "; it is the same at all times, a column without values" : "");
  }
  findings.push_back(ofAttitude(true, text));
}

TrajectoryPlausibility::Finding TrajectoryPlausibility::ofAttitude(bool wrong,
                                                                   const std::string& text) const {
  if (attitude_ == Attitude::used) return {wrong, {text, Hint::positions_only}};
  if (attitude_ == Attitude::needed) return {wrong, text};
  return {false, text + "; only positions are used here: check that they are those of this flight"};
}

void TrajectoryPlausibility::checkRollAndPitch(std::vector<Finding>& findings) const {
  if (!path_) return;
  detail::AttitudeComparison comparison(*flight_, *path_);
  for (const Strip& strip : strips_) {
    if (strip.used) comparison.add(strip.recovery->assess());
  }
  const detail::AttitudeComparison::Result found = comparison.result();
  if (!found.text.empty()) findings.push_back(ofAttitude(found.wrong, found.text));
}

}  // namespace pcl_als
