// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/quality/accuracy_standards.h>

namespace pcl_als {
namespace {

template <typename Limit>
std::optional<int> bestLevel(double value, Limit limit) {
  for (const QualityLevelLimits& level : qualityLevels()) {
    if (value <= limit(level)) return level.level;
  }
  return std::nullopt;
}

}  // namespace

const std::array<QualityLevelLimits, kQualityLevels>& qualityLevels() {
  static const std::array<QualityLevelLimits, kQualityLevels> levels{{
      {0, 0.04, 0.08, 0.03, 0.05, 1.0},
      {1, 0.08, 0.16, 0.06, 0.10, 1.0},
      {2, 0.08, 0.16, 0.06, 0.10, 2.0},
      {3, 0.16, 0.32, 0.12, 0.20, 4.0},
  }};
  return levels;
}

std::optional<int> swathQualityLevel(double rmsdz) {
  return bestLevel(rmsdz, [](const QualityLevelLimits& l) { return l.swath_overlap_rmsdz; });
}

std::optional<int> absoluteQualityLevel(double rmsez) {
  return bestLevel(rmsez, [](const QualityLevelLimits& l) { return l.absolute_rmsez; });
}

VerticalAccuracy verticalAccuracy(double fit, double survey, std::size_t points) {
  VerticalAccuracy accuracy;
  accuracy.fit = fit;
  accuracy.survey = survey;
  accuracy.rmse_v = std::hypot(fit, survey);
  accuracy.class_cm = std::ceil(100.0 * accuracy.rmse_v - 1e-9);
  accuracy.nva_95 = 1.96 * fit;
  accuracy.enough_points = points >= kFewestCheckPoints;
  return accuracy;
}

}  // namespace pcl_als
