// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory_screening.h>

#include "sample_screening.h"

namespace pcl_als {
namespace {

constexpr std::size_t kNamed = 3;          // runs named in a message
constexpr std::size_t kMostOutliers = 10;  // of a short flight
constexpr double kMostShare = 0.01;        // of a long one
constexpr std::size_t kMostJumps = 6;      // pieces of a short path
constexpr double kMostJumpShare = 0.02;
constexpr double kFarJump = 200e3;  // metres: farther than the pieces of a path are apart

const char* const kRemedy = "; remove these samples, or export the trajectory again";

std::string withValue(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string distanceText(double metres) {
  return metres < 10.0   ? withValue("%.2f m", metres)
         : metres < 10e3 ? withValue("%.0f m", metres)
                         : withValue("%.0f km", 1e-3 * metres);
}

/// "line 12 (401500.125 s): 1203 m beside the path"
std::string describeRun(const OutlierRun& run, const TrajectoryScreening::SampleName& name) {
  std::string text = name(run.samples.front());
  if (run.samples.size() > 1) text += " to " + name(run.samples.back());
  text += withValue(" (%.3f", run.from);
  if (run.samples.size() > 1) text += withValue(" to %.3f", run.to);
  text += " s): ";
  if (run.inPosition()) return text + distanceText(run.distance) + " beside the path";
  return text + withValue("attitude differs by %.1f degrees", run.turn / kRadiansPerDegree);
}

std::string describeRuns(const std::vector<OutlierRun>& runs,
                         const TrajectoryScreening::SampleName& name) {
  std::string text;
  for (std::size_t i = 0; i < std::min(runs.size(), kNamed); ++i)
    text += (i == 0 ? "" : ", ") + describeRun(runs[i], name);
  return runs.size() > kNamed ? text + ", …" : text;
}

}  // namespace

std::string TrajectoryScreening::sampleNumber(std::size_t index) {
  return "sample " + std::to_string(index + 1);
}

std::size_t TrajectoryScreening::outlierCount() const {
  std::size_t count = 0;
  for (const OutlierRun& run : outliers) count += run.samples.size();
  return count;
}

std::vector<std::size_t> TrajectoryScreening::indices() const {
  std::vector<std::size_t> all;
  for (const OutlierRun& run : outliers)
    all.insert(all.end(), run.samples.begin(), run.samples.end());
  std::sort(all.begin(), all.end());
  return all;
}

std::string TrajectoryScreening::objection(const SampleName& name) const {
  const auto count = static_cast<double>(samples);
  const std::string of = " of " + grouped(samples) + " samples";
  if (!long_runs.empty()) {
    std::size_t wrong = 0;
    for (const OutlierRun& run : long_runs) wrong += run.samples.size();
    return std::to_string(wrong) + of +
           " contradict those before and behind them, in runs that are too long to be bridged: " +
           describeRuns(long_runs, name) + kRemedy;
  }
  if (static_cast<double>(outlierCount()) >
      std::max(static_cast<double>(kMostOutliers), kMostShare * count)) {
    return std::to_string(outlierCount()) + of +
           " contradict their neighbours: " + describeRuns(outliers, name) + kRemedy;
  }
  if (farthest_jump > kFarJump ||
      static_cast<double>(jumps.size()) >
          std::max(static_cast<double>(kMostJumps), kMostJumpShare * count)) {
    return "the position jumps by up to " + distanceText(farthest_jump) + " at " +
           std::to_string(jumps.size()) + of + ", the first is " + name(jumps.front()) + kRemedy;
  }
  return {};
}

std::string TrajectoryScreening::describe(const SampleName& name) const {
  if (outliers.empty()) return {};
  const std::size_t count = outlierCount();
  return std::to_string(count) + " of " + grouped(samples) + " samples " +
         (count == 1 ? "contradicts its neighbours and is"
                     : "contradict their neighbours and are") +
         " excluded: " + describeRuns(outliers, name);
}

TrajectoryScreening screenTrajectory(const std::vector<TrajectorySample>& samples) {
  return detail::SampleScreening(samples).result();
}

}  // namespace pcl_als
