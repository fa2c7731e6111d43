// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/common/zone_difference.h>

namespace pcl_als {

std::string zoneDifference(const Eigen::Vector2d& given, const Eigen::Vector2d& block) {
  constexpr double kMetresPerDegree = 111320.0 * 0.9996;  // of a meridian, and on the equator
  constexpr double kTolerance = 0.04;                     // of the width of a zone
  constexpr double kNorthing = 6e4;                       // metres
  const double latitude = std::abs(block.y()) / kMetresPerDegree * kRadiansPerDegree;
  if (!(latitude < 85.0 * kRadiansPerDegree) || block.y() < kNorthing) return {};
  const Eigen::Vector2d d = given - block;
  for (const int degrees : {6, 3}) {
    const double width = degrees * kMetresPerDegree * std::cos(latitude);
    if (std::abs(std::abs(d.x()) - width) < kTolerance * width && std::abs(d.y()) < kNorthing)
      return "its eastings differ by those of a zone " + std::to_string(degrees) + " degrees away";
  }
  return {};
}

}  // namespace pcl_als
