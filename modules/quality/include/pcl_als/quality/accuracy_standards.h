// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace pcl_als {

/** \brief Requirements of the USGS 3DEP Lidar Base Specification for a quality level.
 *
 * Table 2 (relative vertical accuracy of swath data) and Table 4 (absolute vertical accuracy). The
 * figures have been the same from version 1.2 (2014) to 2025 rev. A. The limit of the largest
 * difference is that of versions 1.2 and 1.3 (twice the RMSDz); in later editions it is the break
 * between yellow and red in swath separation images.
 */
struct QualityLevelLimits {
  int level;                     ///< quality level, 0 (best) to 3
  double swath_overlap_rmsdz;    ///< metres, RMS of height differences between swaths
  double swath_overlap_maximum;  ///< metres, largest difference
  double smooth_surface_repeat;  ///< metres, RMS within one swath
  double absolute_rmsez;         ///< metres, non-vegetated ground against check points
  double separation_image_cell;  ///< metres: twice the elevation model's cell (Table 6)
};

inline constexpr int kQualityLevels = 4;
/// The limits of all levels, best level first.
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

/// The best quality level whose limit of differences between swaths an RMSDz (metres) satisfies, if
/// any.
std::optional<int> swathQualityLevel(double rmsdz);

/// The best quality level whose absolute limit an RMSEz (metres) satisfies, if any.
std::optional<int> absoluteQualityLevel(double rmsez);

/// Accuracy figures of the ASPRS standards from a test against check points, metres.
struct VerticalAccuracy {
  double rmse_v = 0.0;  ///< Edition 2: sqrt(fit^2 + survey^2)
  /// RMSE of the heights against the check points, and RMSE of the heights of the check points.
  double fit = 0.0, survey = 0.0;
  double class_cm = 0.0;       ///< accuracy class of rmse_v: the next whole centimetre
  double nva_95 = 0.0;         ///< Edition 1: 1.96 fit, 95 % if errors are normally distributed
  bool enough_points = false;  ///< Edition 2 requires kFewestCheckPoints
};
inline constexpr std::size_t kFewestCheckPoints = 30;
/// The figures for a number of check points; \a fit and \a survey in metres.
VerticalAccuracy verticalAccuracy(double fit, double survey, std::size_t points);

}  // namespace pcl_als
