// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include <pcl_als/quality/checked_points.h>

namespace pcl_als {
namespace {

constexpr int kWater = 9;            // ASPRS class
constexpr double kCell = 5.0;        // metres: canopies have openings of this size
constexpr double kVegetation = 1.0;  // metres: much more than noise, much less than a canopy

std::int64_t cellOf(const LidarReturn& point) {
  const auto cell = [](double v) { return static_cast<std::int64_t>(std::floor(v / kCell)); };
  return cell(point.position.y()) * (std::int64_t{1} << 32) + cell(point.position.x());
}

}  // namespace

bool isCheckable(const LidarReturn& point) {
  return !point.isNoise() && !point.isWithheld() && point.position.allFinite() &&
         std::isfinite(point.time);
}

bool isSolid(const LidarReturn& point) {
  return isCheckable(point) && point.isLast() && point.classification != kWater;
}

void dropHighVegetation(std::vector<LidarReturn>& points) {
  const auto vegetation = [](const LidarReturn& point) { return point.isVegetation(); };
  if (std::none_of(points.begin(), points.end(), vegetation)) return;
  std::unordered_map<std::int64_t, double> lowest;
  for (const LidarReturn& point : points) {
    const auto [place, added] = lowest.try_emplace(cellOf(point), point.position.z());
    if (!added) place->second = std::min(place->second, point.position.z());
  }
  const auto high = [&](const LidarReturn& point) {
    return point.isVegetation() && point.position.z() > lowest.at(cellOf(point)) + kVegetation;
  };
  points.erase(std::remove_if(points.begin(), points.end(), high), points.end());
}

}  // namespace pcl_als
