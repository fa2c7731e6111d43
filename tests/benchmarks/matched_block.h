// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include "area_matcher.h"
#include "simulated_survey.h"

namespace pcl_als::bench {

/** \brief The areas of a calibration with TINs and candidates of their own, to look at its pairs
 * from outside: prepared as AreaSample prepares them.
 */
class MatchedBlock {
 public:
  /// \a block: that of the survey, see test::SimulatedSurvey::block().
  MatchedBlock(const test::SimulatedSurvey& survey, const SurveyBlock& block);

  /// Reconstructs the points of all areas with Eq. (13).
  void correct(const SystemVector& biases);
  /// The pairs of every area within \a threshold (metres), strips and control, of this noise.
  std::vector<AreaObservations> match(double threshold, const NoiseModel& noise) const;

  /// Areas in which strips meet; those around control points come after them.
  std::size_t areaCount() const { return pair_areas_; }
  const AreaMatcher& area(std::size_t index) const { return matchers_[index]; }
  /// The control point of an area after areaCount().
  const ControlPoint& controlOf(std::size_t index) const { return control_[index - pair_areas_]; }
  /// Firing times of the points of a strip in an area, in the order of their TIN.
  const std::vector<double>& times(std::size_t index, int strip) const {
    return times_[index][static_cast<std::size_t>(strip)];
  }
  const Trajectory& flight() const { return *flight_; }
  const SurfaceCriterion& limits() const { return limits_; }

 private:
  void load(const test::SimulatedSurvey& survey, const std::vector<SurveyArea>& areas);
  void prepare(const CalibrationSettings& settings);
  void limitRoughness();

  std::shared_ptr<const Trajectory> flight_;
  std::vector<StripPair> pairs_;
  std::vector<ControlPoint> control_;
  std::size_t pair_areas_ = 0;
  SurfaceCriterion limits_;
  std::vector<AreaMatcher> matchers_;
  std::vector<std::vector<std::vector<double>>> times_;  ///< by area and strip
};

}  // namespace pcl_als::bench
