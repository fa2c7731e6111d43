// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_als {

/// Why points take no part in a computation.
enum class ExclusionReason {
  excluded,           ///< the strip was not chosen by the user
  zero_time,          ///< GPS time 0 among points that have times
  before_trajectory,  ///< measured before the trajectory's first sample
  after_trajectory,   ///< measured after its last sample
  in_trajectory_gap,  ///< measured in a gap of the trajectory
  strip_uncovered,    ///< covered, but the trajectory covers hardly anything of the strip
  in_turn,            ///< measured in a turn between strips
  hovering,           ///< measured while the sensor hovered between strips
  rounded_times,      ///< GPS times of the strip have too coarse steps for its trajectory
  too_few_points,     ///< the strip has too few points
  copy,               ///< the points of the strip are also those of another strip
};

/// "excluded", "zero_time", …: the word of result files.
std::string_view toString(ExclusionReason reason);

/// Points of one strip that were excluded for one reason.
struct ExcludedPoints {
  std::string strip;
  ExclusionReason reason = ExclusionReason::excluded;
  std::uint64_t points = 0;
  std::uint64_t of = 0;  ///< points of the strip
};

/// "strip 66: 812 of 912345 points (0.09 %) excluded: measured before the trajectory begins".
std::string describe(const ExcludedPoints& part);

/// describe() of each part, in order.
std::vector<std::string> describe(const std::vector<ExcludedPoints>& parts);

}  // namespace pcl_als
