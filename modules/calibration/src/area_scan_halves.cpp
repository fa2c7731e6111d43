// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The points of a strip that form surfaces in AreaMatcher: those of an even density, and those of
// each half.
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <Eigen/Geometry>

#include "area_matcher.h"

namespace pcl_als {
namespace {

constexpr double kMixedShare = 0.05;  // of the triangles: a strip with fewer is not divided
/// The share in a half over that of the whole from which the division does not separate the times.
constexpr double kStillMixed = 0.6;

using Cell = std::pair<std::int64_t, std::int64_t>;

Cell cellOf(const Eigen::Vector3d& point, double size) {
  return {static_cast<std::int64_t>(std::floor(point.x() / size)),
          static_cast<std::int64_t>(std::floor(point.y() / size))};
}

/// Side of the square that has one point on average, where there are points.
double meanSpacing(const std::vector<Eigen::Vector3d>& points) {
  constexpr double kPerCell = 16.0;  // points of the cells that show where there are points
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector3d& point : points) box.extend(point.head<2>());
  const double count = static_cast<double>(points.size());
  const double size = std::sqrt(kPerCell * std::max(1e-6, box.volume()) / count);
  std::set<Cell> occupied;
  for (const Eigen::Vector3d& point : points) occupied.insert(cellOf(point, size));
  return size * std::sqrt(static_cast<double>(occupied.size()) / count);
}

}  // namespace

void AreaMatcher::StripPart::add(const StripPart& other, std::size_t i) {
  biased.push_back(other.biased[i]);
  times.push_back(other.times[i]);
  single.push_back(other.single[i]);
  intensity.push_back(other.intensity[i]);
  scan_direction.push_back(other.scan_direction[i]);
  channel.push_back(other.channel[i]);
  user_data.push_back(other.user_data[i]);
  range_std.push_back(other.range_std[i]);
}

void AreaMatcher::evenOut() {
  constexpr double kCell = 0.7;  // of the mean spacing: wider cells round off roofs
  for (StripPart& part : surfaces_) {
    if (part.held() || part.biased.size() < kTooFew) continue;
    const double size = kCell * meanSpacing(part.biased);
    std::set<Cell> taken;
    StripPart even;
    for (std::size_t i = 0; i < part.biased.size(); ++i)
      if (taken.insert(cellOf(part.biased[i], size)).second) even.add(part, i);
    even.strip = part.strip;
    even.rounding = part.rounding;
    part = std::move(even);
  }
}

bool AreaMatcher::isMixed(const std::vector<double>& times,
                          const std::array<std::int32_t, 3>& triangle) {
  // Successive lines of a scanner are at most a few tenths of a second apart; trajectory errors
  // change within seconds.
  constexpr double kMixedTimes = 0.5;
  const auto [first, last] = std::minmax({times[static_cast<std::size_t>(triangle[0])],
                                          times[static_cast<std::size_t>(triangle[1])],
                                          times[static_cast<std::size_t>(triangle[2])]});
  return last - first > kMixedTimes;
}

double AreaMatcher::mixedShare(const StripPart& part) {
  constexpr std::size_t kSampledTriangles = 5000;  // triangles: 0.3 % for a share of 5 %
  const auto& triangles = part.surface.tin().triangles();
  const std::size_t every = std::max<std::size_t>(1, triangles.size() / kSampledTriangles);
  std::size_t examined = 0, mixed = 0;
  for (std::size_t i = 0; i < triangles.size(); i += every, ++examined)
    if (isMixed(part.times, triangles[i].vertex)) ++mixed;
  return static_cast<double>(mixed) / static_cast<double>(std::max<std::size_t>(1, examined));
}

bool AreaMatcher::divideByScanHalf(std::size_t strip, double resolution,
                                   const Trajectory& trajectory) {
  const StripPart& whole = surfaces_[strip];
  if (!whole.flown) return false;
  const double mixed = mixedShare(whole);
  if (!(mixed > kMixedShare)) return false;
  StripPart halves[2];
  std::size_t cursor = 0;
  SensorPose pose;
  for (std::size_t i = 0; i < whole.biased.size(); ++i) {
    const bool ahead = !trajectory.poseAt(whole.times[i], pose, cursor) ||
                       (pose.rotation.transpose() * (whole.biased[i] - pose.position)).y() > 0.0;
    halves[ahead ? 0 : 1].add(whole, i);
  }
  for (StripPart& half : halves) {
    if (half.biased.size() < kTooFew) return false;
    half.strip = whole.strip;
    half.held_std = whole.held_std;
    half.rounding = whole.rounding;
    buildSurface(half, resolution);
    if (mixedShare(half) > kStillMixed * mixed) return false;
  }
  halves[0].half = ScanHalf::fore;
  halves[1].half = ScanHalf::aft;
  surfaces_[strip] = std::move(halves[0]);
  surfaces_.push_back(std::move(halves[1]));
  return true;
}

}  // namespace pcl_als
