// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/trajectory/attitude_recovery.h>

namespace pcl_als::detail {

constexpr double kAttitudeBin = 0.1;   ///< seconds
constexpr double kFewestOfBin = 10.0;  ///< pulses of a bin that is judged

/// A bin of a pass with what was estimated for it. The plane of the pulses is y = across x + below
/// z.
struct PassBin {
  std::int64_t index = 0;  ///< bins since the flight's start
  PulseSums sums;
  double off_plane = 0.0;                           ///< radians
  Eigen::Vector2d plane = Eigen::Vector2d::Zero();  ///< across, below
  bool well_determined = false;                     ///< by its own pulses

  double pitch() const;
  double crab() const;
};

/// Estimates the planes of all bins of a pass: least squares with a random walk in between.
void smoothPlanes(std::vector<PassBin>& bins);

/// Properties of the scanner from a pass; after smoothPlanes().
AttitudeRecovery::Pass judgePass(const std::vector<PassBin>& bins);

/// How recorded scan angles of a pass grow with those from the flight line; -1 where they count to
/// the left. NaN where they do not follow them.
double recordedScale(const std::vector<PassBin>& bins);

/// The words for a pass that is not linear: "its pulses lie on a cone of 18 degrees".
std::string objectionTo(const AttitudeRecovery::Pass& pass);

}  // namespace pcl_als::detail
