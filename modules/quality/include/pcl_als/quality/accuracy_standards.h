// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace pcl_als {

/** \brief Requirements of the USGS 3DEP Lidar Base Specification for a quality level.
 *
 * Table 2 (relative vertical accuracy of swath data) and Table 4 (absolute vertical accuracy); the
 * figures have been the same from version 1.2 (2014) to 2025 rev. A. The largest difference is that
 * of versions 1.2 and 1.3 (twice the RMSDz); later editions have it as the break between yellow and
 * red of the swath separation images.
 */
struct QualityLevelLimits {
  int level;                     ///< QL
  double swath_overlap_rmsdz;    ///< metres, RMS of height differences between swaths
  double swath_overlap_maximum;  ///< metres, largest difference
  double smooth_surface_repeat;  ///< metres, RMS within one swath
  double absolute_rmsez;         ///< metres, non-vegetated ground against check points
  double separation_image_cell;  ///< metres: twice the elevation model's cell (Table 6)
};

inline constexpr int kQualityLevels = 4;
const std::array<QualityLevelLimits, kQualityLevels>& qualityLevels();

inline constexpr const char* kSwathSpecification =
    "USGS 3DEP Lidar Base Specification 2025 rev. A, Table 2 (swath overlap difference, RMSDz)";
inline constexpr const char* kAbsoluteSpecification =
    "USGS 3DEP Lidar Base Specification 2025 rev. A, Table 4 (RMSEz, non-vegetated)";
inline constexpr const char* kPositionalStandard =
    "ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2 (2023/2024)";
inline constexpr const char* kOlderPositionalStandard =
    "ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 1 (2014)";
inline constexpr const char* kSwathGuidelines =
    "ASPRS Guidelines on Geometric Inter-Swath Accuracy and Quality of Lidar Data, Version 1.0 "
    "(2018)";

/// The best level whose limit of differences between swaths (RMSDz, metres) is satisfied, if any.
std::optional<int> swathQualityLevel(double rmsdz);

/// The best level whose absolute limit is satisfied by an RMSEz (metres), if any.
std::optional<int> absoluteQualityLevel(double rmsez);

/// ASPRS figures of a test against check points, metres.
struct VerticalAccuracy {
  /// Edition 2: sqrt(fit^2 + survey^2), fit: RMSE against the points, survey: RMSE of their heights
  double rmse_v = 0.0;
  double fit = 0.0, survey = 0.0;
  double class_cm = 0.0;       ///< the accuracy class of rmse_v: the next whole centimetre
  double nva_95 = 0.0;         ///< Edition 1: 1.96 fit, at 95 % if errors are normal
  bool enough_points = false;  ///< Edition 2 requires kFewestCheckPoints
};
inline constexpr std::size_t kFewestCheckPoints = 30;
VerticalAccuracy verticalAccuracy(double fit, double survey, std::size_t points);

}  // namespace pcl_als
