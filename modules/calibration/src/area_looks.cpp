// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The division of a strip's points by look, by AreaMatcher.
#include <algorithm>
#include <utility>

#include "area_matcher.h"

namespace pcl_als {
namespace {

constexpr double kMixedShare = 0.05;  // of the triangles: a strip with fewer is not divided
/// The share in a look over that of the whole from which the division does not separate the times.
constexpr double kStillMixed = 0.6;

}  // namespace

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
  constexpr std::size_t kEnough = 5000;  // triangles: 0.3 % for a share of 5 %
  const auto& triangles = part.surface.tin().triangles();
  const std::size_t every = std::max<std::size_t>(1, triangles.size() / kEnough);
  std::size_t examined = 0, mixed = 0;
  for (std::size_t i = 0; i < triangles.size(); i += every, ++examined)
    if (isMixed(part.times, triangles[i].vertex)) ++mixed;
  return static_cast<double>(mixed) / static_cast<double>(std::max<std::size_t>(1, examined));
}

bool AreaMatcher::divideByLook(std::size_t strip, double resolution, const Trajectory& trajectory) {
  const StripPart& whole = surfaces_[strip];
  if (!whole.flown) return false;
  const double mixed = mixedShare(whole);
  if (!(mixed > kMixedShare)) return false;
  StripPart looks[2];
  std::size_t cursor = 0;
  SensorPose pose;
  for (std::size_t i = 0; i < whole.biased.size(); ++i) {
    const bool ahead = !trajectory.poseAt(whole.times[i], pose, cursor) ||
                       (pose.rotation.transpose() * (whole.biased[i] - pose.position)).y() > 0.0;
    StripPart& look = looks[ahead ? 0 : 1];
    look.biased.push_back(whole.biased[i]);
    look.times.push_back(whole.times[i]);
    look.single.push_back(whole.single[i]);
    look.intensity.push_back(whole.intensity[i]);
    look.turning.push_back(whole.turning[i]);
  }
  for (StripPart& look : looks) {
    if (look.biased.size() < kTooFew) return false;
    look.strip = whole.strip;
    look.held_std = whole.held_std;
    buildSurface(look, resolution);
    if (mixedShare(look) > kStillMixed * mixed) return false;
  }
  looks[0].look = Look::ahead;
  looks[1].look = Look::back;
  surfaces_[strip] = std::move(looks[0]);
  surfaces_.push_back(std::move(looks[1]));
  return true;
}

}  // namespace pcl_als
