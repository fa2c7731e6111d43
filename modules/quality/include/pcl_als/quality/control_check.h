// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/quality/area_offsets.h>
#include <pcl_als/quality/offset_sample.h>

namespace pcl_als {

/// One strip at one control point.
struct ControlDifference {
  std::string point, strip;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the point, metres, ground frame
  double above = 0.0;                                  ///< strip - control, metres
  double slope = 0.0;                                  ///< of the surface, radians
  double roughness = 0.0;                              ///< metres
  std::string unfit;  ///< reason for which it is left out of the statistics; empty: it is used
};

/// Comparison of the strips with control.
struct ControlAssessment {
  struct OfStrip {
    std::string strip;
    OffsetSummary offsets;
  };

  std::vector<ControlDifference> differences;  ///< by point, then by strip
  std::vector<OfStrip> strips;                 ///< those with a point, in order
  OffsetSummary all;                           ///< all strips at all points that they cover
  std::size_t points = 0;                      ///< points that are used, of at least one strip
  std::vector<std::string> unseen;             ///< points that no strip covers
  VerticalAccuracy accuracy;                   ///< of all
  bool survey_known = false;         ///< the file gives the standard deviations of the heights
  std::optional<int> quality_level;  ///< by the fit alone; empty: none
};

/// The strips at a point, from an area that contains it (after AreaOffsets::build()).
std::vector<ControlDifference> controlDifferences(const AreaOffsets& area,
                                                  const ControlPoint& point,
                                                  const std::vector<std::string>& strips);

/// \param default_sigma metres: of the heights of points whose file gives none
ControlAssessment assessControl(std::vector<ControlDifference> differences,
                                const std::vector<ControlPoint>& control,
                                const std::vector<std::string>& strips, double default_sigma);

}  // namespace pcl_als
