// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/processing/intensity_run.h>

namespace pcl_als {

void IntensityCounts::merge(const IntensityCounts& other) {
  for (std::size_t i = 0; i < status.size(); ++i) status[i] += other.status[i];
  points += other.points;
  excluded += other.excluded;
  zeros += other.zeros;
  saturated += other.saturated;
  clipped += other.clipped;
  rounded_to_zero += other.rounded_to_zero;
  labels.resize(std::max(labels.size(), other.labels.size()));
  for (std::size_t i = 0; i < other.labels.size(); ++i) labels[i] += other.labels[i];
  for (const auto& [key, count] : other.uncovered) uncovered[key] += count;
}

void IntensityCounts::put(ByteWriter& out) const {
  out.put(status).put(points).put(zeros).put(saturated).put(excluded).put(clipped);
  out.put(rounded_to_zero).put(labels).put(uncovered.size());
  for (const auto& [key, count] : uncovered) out.put(key.first).put(key.second).put(count);
}

void IntensityCounts::get(ByteReader& in) {
  in.get(status).get(points).get(zeros).get(saturated).get(excluded).get(clipped);
  in.get(rounded_to_zero).get(labels);
  uncovered.clear();
  for (auto left = in.take<std::size_t>(); left > 0; --left) {
    const auto label = in.take<std::size_t>();
    const auto reason = in.take<ExclusionReason>();
    in.get(uncovered[{label, reason}]);
  }
}

ExclusionReason IntensityRun::whyUncovered(std::size_t file, double time) const {
  if (time == 0.0) return ExclusionReason::zero_time;
  switch (trajectory_->coverage(times_[file](time))) {
    case Trajectory::Coverage::before_start:
      return ExclusionReason::before_trajectory;
    case Trajectory::Coverage::after_end:
      return ExclusionReason::after_trajectory;
    default:
      return ExclusionReason::in_trajectory_gap;
  }
}

std::vector<ExcludedPoints> IntensityRun::excludedPoints(const IntensityCounts& counts) const {
  std::vector<std::uint64_t> labels = counts.labels;
  labels.resize(arrangement().labels().size());
  std::vector<ExcludedPoints> parts = arrangement().excludedPoints(labels);
  for (const auto& [key, points] : counts.uncovered) {
    const std::string& strip = arrangement().labels()[key.first].strip;
    std::uint64_t all = 0;
    for (std::size_t i = 0; i < labels.size(); ++i)
      all += arrangement().labels()[i].strip == strip ? labels[i] : 0;
    parts.push_back({strip, key.second, points, all});
  }
  return parts;
}

}  // namespace pcl_als
