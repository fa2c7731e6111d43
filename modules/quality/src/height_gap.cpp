// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <unordered_map>

#include <pcl_als/common/statistics.h>
#include <pcl_als/quality/height_gap.h>

namespace pcl_als {
namespace {

constexpr std::size_t kEnoughPoints = 300'000;
constexpr std::size_t kFewestCells = 20;

using Heights = std::unordered_map<std::int64_t, double>;

Heights lowestOf(const std::vector<LidarReturn>& points) {
  const auto index = [](double v) {
    return static_cast<std::int64_t>(std::floor(v / HeightGap::kCell));
  };
  Heights lowest;
  for (const LidarReturn& point : points) {
    const std::int64_t key = (index(point.position.y()) << 32) + index(point.position.x());
    const auto [place, added] = lowest.try_emplace(key, point.position.z());
    if (!added) place->second = std::min(place->second, point.position.z());
  }
  return lowest;
}

}  // namespace

std::optional<HeightGap> heightGap(const std::vector<AreaOffsets>& areas, int a, int b) {
  std::vector<double> differences;
  std::size_t seen = 0;
  for (const AreaOffsets& area : areas) {
    if (area.points(a).empty() || area.points(b).empty()) continue;
    const Heights of_a = lowestOf(area.points(a)), of_b = lowestOf(area.points(b));
    for (const auto& [cell, height] : of_a) {
      const auto other = of_b.find(cell);
      if (other != of_b.end()) differences.push_back(height - other->second);
    }
    seen += area.points(a).size() + area.points(b).size();
    if (seen > kEnoughPoints) break;
  }
  if (differences.size() < kFewestCells) return std::nullopt;
  HeightGap gap;
  gap.cells = differences.size();
  gap.median = medianInPlace(differences);
  return gap;
}

std::string describeGap(const HeightGap& gap, const std::string& a, const std::string& b,
                        double maximum_distance) {
  if (!(std::abs(gap.median) > maximum_distance)) return "";
  char text[320];
  std::snprintf(
      text, sizeof text,
      "%s lies %.2f m %s %s (median of %zu cells of %.0f m), which is beyond the %.2f m "
      "within which surfaces are compared: a height offset of one strip (height "
      "reference, units, lever arm); a larger maximum distance compares surfaces further apart",
      a.c_str(), std::abs(gap.median), gap.median > 0.0 ? "above" : "below", b.c_str(), gap.cells,
      HeightGap::kCell, maximum_distance);
  return text;
}

}  // namespace pcl_als
