// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include <pcl_als/common/control_groups.h>
#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {
namespace {

using Heights = std::vector<std::pair<std::string, double>>;

constexpr std::size_t kFewestPoints = 6;
constexpr double kSeparate = 4.5;          // standard deviations of the groups
constexpr double kSeparateExpected = 5.0;  // expected standard deviations
constexpr double kSmallestGroup = 0.2;     // share of the points

struct Split {
  std::size_t lower = 0;  ///< points of the lower group
  double separation = 0.0, within = 0.0;
};

/// Sum of squared deviations from the mean.
double squaresOf(const RunningStatistics& group) {
  const double deviation = group.standardDeviation();
  return static_cast<double>(group.count() - 1) * deviation * deviation;
}

/// The split of sorted heights with the largest separation of two means.
Split bestSplit(const Heights& heights) {
  const std::size_t n = heights.size();
  const auto smallest = std::max<std::size_t>(
      2, static_cast<std::size_t>(std::ceil(kSmallestGroup * static_cast<double>(n))));
  std::vector<RunningStatistics> high(n + 1);  // high[k]: of the heights from k on
  for (std::size_t i = n; i-- > 0;) {
    high[i] = high[i + 1];
    high[i].add(heights[i].second);
  }
  RunningStatistics low;
  Split best;
  double ratio = 0.0;
  for (std::size_t k = 1; k + smallest <= n; ++k) {
    low.add(heights[k - 1].second);
    if (k < smallest) continue;
    const double separation = high[k].mean() - low.mean();
    const double within =
        std::sqrt((squaresOf(low) + squaresOf(high[k])) / (static_cast<double>(n) - 2.0));
    if (separation <= ratio * within) continue;
    ratio = within > 0.0 ? separation / within : 1e9;
    best = {k, separation, within};
  }
  return best;
}

}  // namespace

std::string ControlGroups::describe() const {
  char size[32];
  std::snprintf(size, sizeof size, "%.3f m", separation);
  return size + (" higher above " + std::to_string(higher.size())) + " of them (" +
         listedNames(higher) + ") than above the other " + std::to_string(lower.size()) + " (" +
         listedNames(lower) + ")";
}

std::optional<ControlGroups> controlGroups(Heights heights, double expected_std) {
  if (heights.size() < kFewestPoints) return std::nullopt;
  std::sort(heights.begin(), heights.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  const Split split = bestSplit(heights);
  if (!(split.separation > kSeparate * split.within &&
        split.separation > kSeparateExpected * expected_std))
    return std::nullopt;
  ControlGroups groups;
  groups.separation = split.separation;
  for (std::size_t i = 0; i < heights.size(); ++i)
    (i < split.lower ? groups.lower : groups.higher).push_back(heights[i].first);
  return groups;
}

}  // namespace pcl_als
