// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Coordinates that were rounded to large steps (AreaMatcher, AreaSample).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <pcl_als/common/coordinate_steps.h>
#include <pcl_als/common/statistics.h>

#include "area_matcher.h"
#include "block_calibration.h"

namespace pcl_als {
namespace {

/// Random numbers in [-0.5, 0.5) that depend on a point alone (SplitMix64, Steele et al. 2014).
class PointRandom {
 public:
  PointRandom(double time, const Eigen::Vector3d& place) {
    for (const double value : {time, place.x(), place.y(), place.z()}) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, sizeof bits);
      state_ = mixed(state_ + bits);
    }
  }
  double operator()() {
    constexpr double kUnit = 1.0 / 9007199254740992.0;  // 2^-53
    state_ += 0x9E3779B97F4A7C15U;
    return kUnit * static_cast<double>(mixed(state_) >> 11U) - 0.5;
  }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }

  std::uint64_t state_ = 0;
};

}  // namespace

std::vector<Eigen::Vector3d> AreaMatcher::steps() const {
  constexpr std::size_t kSampledPoints = 5000;  // points of an area
  std::vector<Eigen::Vector3d> steps(corrected_for_.size(), Eigen::Vector3d::Zero());
  for (std::size_t strip = 0; strip < steps.size(); ++strip) {
    const StripPart& part = surfaces_[strip];
    const auto count = static_cast<std::ptrdiff_t>(std::min(kSampledPoints, part.biased.size()));
    if (!part.held())
      steps[strip] = coordinateSteps({part.biased.begin(), part.biased.begin() + count});
  }
  return steps;
}

void AreaMatcher::distribute(int strip, const Eigen::Vector3d& steps) {
  constexpr double kVariance = 1.0 / 6.0;  // of two numbers that are uniform within a step
  StripPart& part = surfaces_[static_cast<std::size_t>(strip)];
  for (std::size_t i = 0; i < part.biased.size(); ++i) {
    PointRandom random(part.times[i], part.biased[i]);
    for (int axis = 0; axis < 3; ++axis) part.biased[i][axis] += steps[axis] * random();
  }
  part.rounding = kVariance * steps.cwiseAbs2();
}

Warnings AreaSample::distributeRounded() {
  constexpr double kNoticeable = 0.25;  // rounding error over the noise of ranges
  const auto found = collect<Eigen::Vector3d>(
      [&](std::size_t i, std::vector<Eigen::Vector3d>& of) { of = matchers_[i].steps(); });
  const double limit = kNoticeable * block_.settings().noise.range * std::sqrt(12.0);
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
  std::size_t rounded = 0;
  for (std::size_t strip = 0; strip < block_.strips.size(); ++strip) {
    Eigen::Vector3d steps = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> values;  // of the areas that show them
      for (const std::vector<Eigen::Vector3d>& area : found)
        if (area[strip][axis] > 0.0) values.push_back(area[strip][axis]);
      const double step = values.empty() ? 0.0 : medianInPlace(values);
      if (step > limit) steps[axis] = step;
    }
    if (steps.isZero(0.0)) continue;
    forAreas([&](std::size_t i) { matchers_[i].distribute(static_cast<int>(strip), steps); });
    largest = largest.cwiseMax(steps);
    ++rounded;
  }
  Warnings warnings;
  if (rounded > 0)
    warnings.push_back("the coordinates of " + std::to_string(rounded) + " of " +
                       std::to_string(block_.strips.size()) + " strips have steps of " +
                       describeSteps(largest, Eigen::Vector3d::Zero()) +
                       ": they passed single precision or a coarse scale; their rounding errors "
                       "are part of the noise, give the points as delivered by the system for a "
                       "better result");
  return warnings;
}

}  // namespace pcl_als
