// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/quality/pair_assessment.h>

namespace pcl_als {

/// One strip at one control point.
struct ControlDifference {
  std::string point, strip;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the point, metres, ground frame
  double above = 0.0;                                  ///< strip - control, metres
  double slope = 0.0;                                  ///< of the surface, radians
  double roughness = 0.0;                              ///< metres
  std::string unfit;  ///< reason for which it is excluded from the statistics; empty: it is used
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of the surface, unit, upward
  double slope_std = 0.0;  ///< radians; of the normal, by the roughness of the surface
};

/// A height offset that most control points have in common.
struct CommonOffset {
  std::string strip;               ///< the strip that has it; empty: all strips
  double offset = 0.0, std = 0.0;  ///< strips - control, metres; std: of this mean
  std::size_t points = 0;          ///< points that agree on it
  std::size_t covered = 0;         ///< points where a surface was measured

  /// "the strips lie 1.50 ± 0.01 m below all 18 control points"
  std::string describe() const;
};

/// Two groups of control points above which one strip lies at different heights.
struct ContradictingControl {
  std::string strip;
  double separation = 0.0;                 ///< metres, between the groups' means
  std::vector<std::string> lower, higher;  ///< ids, by the height of the strip above the points

  /// "strip 3 lies 0.298 m higher above 19 of them (A, B, …) than above the other 18 (C, D, …)"
  std::string describe() const;
};

/** \brief Finds out whether control points contradict each other.
 *
 * The heights of one strip are compared, so that an offset between strips cannot be the reason
 * (controlGroups() with \a survey_sigma, metres, or 1 cm where that is larger). Of several such
 * strips, the one that covers most points is returned.
 */
std::optional<ContradictingControl> contradictingControl(
    const std::vector<ControlDifference>& differences, const std::vector<std::string>& strips,
    double survey_sigma);

/** \brief Finds a height offset that is common to the control points, however large it is.
 *
 * It exists if the median of the points differs from zero by more than three times their robust
 * standard deviation, or \a survey_sigma (metres) where that is larger, and three points and more
 * than half of all agree with the median to that tolerance. Points whose differences are unfit do
 * not take part.
 *
 * \param strip the strip whose differences are examined; empty: all, with the mean of each point
 */
std::optional<CommonOffset> commonOffset(const std::vector<ControlDifference>& differences,
                                         const std::string& strip, double survey_sigma);

/// The offset of all strips; where there is none, the offsets of single strips.
std::vector<CommonOffset> commonOffsets(const std::vector<ControlDifference>& differences,
                                        const std::vector<std::string>& strips,
                                        double survey_sigma);

/** \brief The movement of the strips onto control that heights above control on slopes show.
 *
 * A movement (e, n, u) of strips onto control makes their height above a point with the surface
 * normal n equal to -(e n_e + n n_n) / n_u - u. It is determined where slopes vary by far more than
 * the normals are uncertain, and the standard deviation in plan is at most 0.5 m.
 */
HorizontalShift shiftOntoControl(const std::vector<ControlDifference>& differences);

/// Whether a shift in plan is significant: a component beyond the 99.9 % limit of Student's t
/// distribution with count - 3 degrees of freedom.
bool isSignificantInPlan(const HorizontalShift& shift);

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
