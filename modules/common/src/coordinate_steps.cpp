// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstdio>

#include <pcl_als/common/coordinate_steps.h>

namespace pcl_als {
namespace {

double stepOf(std::vector<double>& values) {
  constexpr std::size_t kFewest = 3;  // distances
  constexpr double kSame = 1e-9;      // m: rounding of sums in double precision
  std::sort(values.begin(), values.end());
  std::vector<double> distances;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double distance = values[i] - values[i - 1];
    if (distance > kSame) distances.push_back(distance);
  }
  // The points of one scan line are evenly spaced as well, but none of their values repeats.
  if (distances.size() < kFewest || values.size() < 2 * distances.size()) return 0.0;
  const auto quantile = [&](double share) {
    const auto at = distances.begin() +
                    static_cast<std::ptrdiff_t>(share * static_cast<double>(distances.size()));
    std::nth_element(distances.begin(), at, distances.end());
    return *at;
  };
  constexpr double kSmall = 0.05, kMostMultiple = 3.0;
  const double step = quantile(kSmall);
  return quantile(0.5) < (kMostMultiple + 0.5) * step ? step : 0.0;
}

}  // namespace

Eigen::Vector3d coordinateSteps(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d steps;
  std::vector<double> values(points.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::transform(points.begin(), points.end(), values.begin(),
                   [&](const Eigen::Vector3d& point) { return point[axis]; });
    steps[axis] = stepOf(values);
  }
  return steps;
}

std::string describeSteps(const Eigen::Vector3d& steps, const Eigen::Vector3d& limit) {
  static constexpr const char* kAxes[] = {"east", "north", "up"};
  std::string text;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(steps[axis] > limit[axis])) continue;
    char part[48];
    std::snprintf(part, sizeof part, "%.3g m (%s)", steps[axis], kAxes[axis]);
    text += (text.empty() ? "" : ", ") + std::string(part);
  }
  return text;
}

}  // namespace pcl_als
