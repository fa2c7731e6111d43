// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Diagnosis of the strips of a block after the adjustment (SystemCalibrationEngine).
#include <algorithm>
#include <cmath>
#include <map>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/shared_vectors.h>

#include "calibration_state.h"
#include "control_consistency.h"
#include "error_diagnosis.h"
#include "pair_coverage.h"
#include "part_consistency.h"
#include "strip_consistency.h"

namespace pcl_als {

std::vector<OverlappingPair> SystemCalibrationEngine::overlappingPairs() const {
  std::vector<OverlappingPair> found;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto [a, b] = pairs_[i];
    if (!isReference(a) && !isReference(b))  // their heights are checked before
      found.push_back(
          {ids_[static_cast<std::size_t>(a)], ids_[static_cast<std::size_t>(b)], pair_heights_[i]});
  }
  return found;
}

void SystemCalibrationEngine::warnOfTargets(CalibrationResult& result) const {
  std::vector<std::vector<TargetInStrip>> found(matchers_.size());
  forOwnAreas([&](std::size_t area) {
    if (area < pair_areas_) return;
    const ControlPoint& point = control_[area - pair_areas_];
    if (point.kind == ControlPoint::Kind::target)
      found[area] = matchers_[area].targetsIn(point, settings_.max_normal_distance, *trajectory_,
                                              settings_.noise);
  });
  shareVectors(processes_, area_shares_, found);
  std::map<TargetStatus, std::vector<std::string>> missing;
  for (std::size_t area = pair_areas_; area < found.size(); ++area) {
    std::map<TargetStatus, std::string> strips;
    for (const TargetInStrip& target : found[area]) {
      std::string& list = strips[target.status];
      list += (list.empty() ? "" : "+") + ids_[static_cast<std::size_t>(target.strip)];
    }
    for (const auto& [status, list] : strips)
      missing[status].push_back(control_[area - pair_areas_].id + " in strip " + list);
  }
  missing.erase(TargetStatus::located);
  for (const auto& [status, list] : missing)
    result.warnings.push_back("targets that were not located (" + std::string(reasonOf(status)) +
                              "): " + listedNames(list));
}

void SystemCalibrationEngine::assessControl(State& state, const SharedErrors& errors,
                                            CalibrationResult& result) const {
  const ControlConsistency control(result.control_points);
  SystemVector spread = SystemVector::Zero();
  if (control.two_groups) {
    weigh(state);  // the last pairs have no weights yet
    ControlledAdjustment adjustment{
        errors, state.adjustment.levels(), state.observations, state.weights.weights(), pair_areas_,
        {},     state.choice.estimate,     settings_.threads};
    for (const ControlPoint& point : control_) adjustment.control.push_back(point.id);
    spread = controlSpread(control, adjustment);
  }
  warnOfBlockOffset(result);
  judgeControl(control, spread, result);
}

void SystemCalibrationEngine::assessParts(const State& state, CalibrationResult& result) const {
  if (state.choice.estimate.empty()) return;
  AreaAdjustment adjustment{state.adjustment, {}, {}, state.choice.estimate};
  for (const AreaObservations& area : state.observations) adjustment.pairs.push_back(area.size());
  for (const SurveyArea& area : areas_) {
    adjustment.places.emplace_back(area.minimum + Eigen::Vector2d::Constant(0.5 * area.size));
  }
  judgeParts(partDifferences(adjustment), result);
}

void SystemCalibrationEngine::diagnose(CalibrationResult& result) const {
  std::vector<StripFacts> strips;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const int strip = static_cast<int>(i);
    if (!used_[i] || isHeld(strip)) continue;
    strips.push_back(
        {ids_[i], map_.startTime(strip), map_.endTime(strip), plausibility_.meanHeight(strip)});
  }
  const SharedErrorModel& errors = settings_.shared_errors;
  const StripConsistency consistency(strips, result.pairs,
                                     {errors.position, errors.correlation_time});
  result.strip_offsets = consistency.offsets();
  const auto& found = consistency.warnings();
  result.warnings.insert(result.warnings.end(), found.begin(), found.end());
}

}  // namespace pcl_als
