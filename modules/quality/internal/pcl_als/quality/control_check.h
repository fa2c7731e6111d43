// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/warning.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/quality/control_offsets.h>
#include <pcl_als/quality/offset_sample.h>
#include <pcl_als/quality/surface_limits.h>

namespace pcl_als {

class AreaOffsets;

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
  /// Points that strips cover, but at more than distance_limit above or below them.
  std::vector<std::string> far;
  double distance_limit = 0.0;        ///< metres: SurfaceLimits::maximum_distance
  std::vector<CommonOffset> offsets;  ///< offsets that points have in common, of any size
  std::optional<ContradictingControl> contradiction;  ///< points that contradict each other
  HorizontalShift shift;                              ///< movement of the strips onto control
  std::optional<VerticalAccuracy> accuracy;           ///< of all; empty without a point
  /// Why the figures are not those of the block, hence neither class nor level; empty: they are.
  std::string no_class;
  bool survey_known = false;         ///< the file gives the standard deviations of the heights
  std::optional<int> quality_level;  ///< by the fit alone; empty: none
};

/// The strips at a point, from an area that contains it (after AreaOffsets::build()).
std::vector<ControlDifference> controlDifferences(const AreaOffsets& area,
                                                  const ControlPoint& point,
                                                  const std::vector<std::string>& strips);

/** \brief Statistics of the differences, and what they have in common.
 *
 * A difference beyond \a distance_limit is of another surface or a blunder and is not used, unless
 * it agrees to that distance with an offset that the points have in common (commonOffsets()). More
 * than a tenth of such points, and more than one, are no blunders: there is no accuracy class then.
 *
 * \param default_sigma metres: of the heights of points whose file gives none
 */
ControlAssessment assessControl(std::vector<ControlDifference> differences,
                                const std::vector<ControlPoint>& control,
                                const std::vector<std::string>& strips, double default_sigma,
                                double distance_limit = SurfaceLimits().maximum_distance);

/// What a user should know of the comparison: offsets in common, points that contradict each other,
/// a shift in plan, points far off.
Warnings warningsOf(const ControlAssessment& control);

}  // namespace pcl_als
