// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Diagnosis of a block after its estimation.
#include "block_diagnosis.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <pcl_als/common/listed_names.h>

#include "angle_curve.h"
#include "area_matcher.h"
#include "control_consistency.h"
#include "error_diagnosis.h"
#include "group_differences.h"
#include "jump_search.h"
#include "part_consistency.h"
#include "strip_consistency.h"

namespace pcl_als {

std::vector<JumpSearch::Strip> correctedPasses(const SurveyBlock& block) {
  const std::vector<bool> corrected = block.strips.corrected();
  std::vector<JumpSearch::Strip> passes;
  std::set<int> known;
  for (std::size_t i = 0; i < corrected.size(); ++i)
    if (corrected[i] && known.insert(block.systems.pass[i]).second)
      passes.push_back({static_cast<int>(i), block.strips.ids[i]});
  return passes;
}

namespace {

std::optional<JumpSearch::Place> addJump(const std::vector<JumpSearch::Strip>& strips,
                                         const BlockEstimate& estimate, CalibrationResult& result) {
  const BlockSolution& solution = estimate.solution;
  const JumpSearch jumps(solution.adjustment,
                         solveForAllParameters(solution.adjustment, solution.choice.estimate,
                                               estimate.scale.to_control),
                         strips);
  const ErrorFinding& jump = jumps.finding();
  result.diagnosis.push_back(jump);
  if (jump.determined && jump.probability > kSupported)
    result.warnings.push_back(jump.title + ": " + jump.evidence + "; " + jump.hint);
  return jumps.place();
}

/// An error of the scan angle as a function of it.
void diagnoseAngles(const SurveyBlock& block, const BlockEstimate& estimate,
                    const ScanGeometry& edge, CalibrationResult& result) {
  const CalibrationSettings& settings = block.settings();
  // Other beams have no single angle, and parts of such blocks have parameters of their own.
  if (!result.converged || !block.scanner.isLinear() || !block.trajectory().scanPlanes().empty() ||
      !block.strips.held.empty() || !settings.systems.empty() ||
      !(estimate.scale.largest_angle > 0.0))
    return;
  const BlockSolution& solution = estimate.solution;
  const AdjustedBlock adjusted{block.flownTimes(), errorModelOf(block, solution),
                               solution.adjustment.levels(), solution.choice.estimate,
                               settings.threads};
  judgeAngleCurve(angleCurve(adjusted, {estimate.pairs.observations, solution.weights.weights()},
                             solution.adjustment.errors().consideredSources(),
                             estimate.scale.largest_angle, edge),
                  settings.shared_errors.position, result);
}

/// Differences of sessions, channels and scanners. Where one is supported, the pairs are weighed
/// with it.
void diagnoseGroups(const SurveyBlock& block, std::size_t strips, const ScanGeometry& edge,
                    const BlockEstimate& estimate, CalibrationResult& result) {
  if (block.compared.empty()) return;
  const std::size_t before = result.diagnosis.size();
  const ParameterChoice& choice = estimate.solution.choice;
  Adjustment adjustment = estimate.solution.adjustment;
  addGroupDifferences(block.compared, strips, edge, choice, adjustment, result.diagnosis);
  const bool any = std::any_of(result.diagnosis.begin() + static_cast<std::ptrdiff_t>(before),
                               result.diagnosis.end(), [](const ErrorFinding& finding) {
                                 return finding.determined && finding.probability > kSupported;
                               });
  if (!any || !weighWithDifferences(block.compared, choice, estimate.pairs.observations,
                                    block.settings().threads, adjustment))
    return;
  result.diagnosis.resize(before);
  addGroupDifferences(block.compared, strips, edge, choice, adjustment, result.diagnosis);
}

}  // namespace

SharedErrorModel errorModelOf(const SurveyBlock& block, const BlockSolution& solution) {
  SharedErrorModel model = block.settings().shared_errors;
  model.biases = solution.adjustment.errors().model().biases;
  return model;
}

std::optional<JumpSearch::Place> diagnoseParts(const AreaSample& sample,
                                               const BlockEstimate& estimate,
                                               CalibrationResult& result) {
  if (result.diagnosis.empty()) return std::nullopt;  // not asked for, or not solved
  const SurveyBlock& block = sample.block();
  const ScanGeometry edge = swathEdge(estimate.pairs.observations);
  const std::vector<JumpSearch::Strip> strips = correctedPasses(block);
  std::optional<JumpSearch::Place> jump = addJump(strips, estimate, result);
  const std::size_t before = result.diagnosis.size();
  diagnoseGroups(block, strips.size(), edge, estimate, result);
  judgeDifferences(before, block.settings().shared_errors.position, Hint::none, result);
  diagnoseFields(sample, estimate, edge, result);
  diagnoseAngles(block, estimate, edge, result);
  return jump;
}

void warnOfTargets(const AreaSample& sample, CalibrationResult& result) {
  const SurveyBlock& block = sample.block();
  const CalibrationSettings& settings = block.settings();
  const auto found =
      sample.collect<TargetInStrip>([&](std::size_t area, std::vector<TargetInStrip>& targets) {
        if (!block.isControl(area) || block.controlOf(area).kind != ControlPoint::Kind::target)
          return;
        targets = sample.area(area).targetsIn(block.controlOf(area), settings.max_normal_distance,
                                              block.trajectory(), settings.noise);
      });
  std::map<TargetStatus, std::vector<std::string>> missing;
  for (std::size_t area = block.pairAreas(); area < found.size(); ++area) {
    std::map<TargetStatus, std::string> strips;
    for (const TargetInStrip& target : found[area]) {
      std::string& list = strips[target.status];
      list += (list.empty() ? "" : "+") + block.strips.ids[static_cast<std::size_t>(target.strip)];
    }
    for (const auto& [status, list] : strips)
      missing[status].push_back(block.controlOf(area).id + " in strip " + list);
  }
  missing.erase(TargetStatus::located);
  for (const auto& [status, list] : missing)
    result.warnings.push_back("targets that were not located (" + std::string(reasonOf(status)) +
                              "): " + listedNames(list));
}

void assessControl(const SurveyBlock& block, const BlockEstimate& estimate,
                   CalibrationResult& result) {
  const ControlConsistency control(result.control_points);
  SystemVector spread = SystemVector::Zero();
  if (control.groups) {
    BlockSolution solution = estimate.solution;
    weigh(estimate.pairs, true, block.settings().threads, solution);  // of pairs added for the fits
    ControlledAdjustment adjustment{solution.adjustment.errors(),
                                    solution.adjustment.levels(),
                                    estimate.pairs.observations,
                                    solution.weights.weights(),
                                    block.pairAreas(),
                                    {},
                                    solution.choice.estimate,
                                    block.settings().threads};
    for (const ControlPoint& point : block.request.control) adjustment.control.push_back(point.id);
    spread = controlSpread(control, adjustment);
  }
  warnOfBlockOffset(result);
  judgeControl(control, spread, result);
}

void assessParts(const SurveyBlock& block, const BlockEstimate& estimate,
                 CalibrationResult& result) {
  const BlockSolution& solution = estimate.solution;
  if (solution.choice.estimate.empty()) return;
  AreaAdjustment adjustment{solution.adjustment, {}, {}, solution.choice.estimate};
  for (const AreaObservations& area : estimate.pairs.observations)
    adjustment.pairs.push_back(area.size());
  for (const SurveyArea& area : block.areas)
    adjustment.places.emplace_back(area.minimum + Eigen::Vector2d::Constant(0.5 * area.size));
  judgeParts(partDifferences(adjustment), result);
}

void diagnoseStrips(const SurveyBlock& block, CalibrationResult& result) {
  const std::vector<bool> corrected = block.strips.corrected();
  std::vector<StripFacts> strips;
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    const SurveyedStrip& strip = block.surveyed[i];
    if (corrected[i])
      strips.push_back({block.strips.ids[i], strip.span.first, strip.span.second, strip.height});
  }
  const SharedErrorModel& errors = block.settings().shared_errors;
  const StripConsistency consistency(strips, result.pairs,
                                     {errors.position, errors.correlation_time});
  result.strip_offsets = consistency.offsets();
  const auto& found = consistency.warnings();
  result.warnings.insert(result.warnings.end(), found.begin(), found.end());
}

}  // namespace pcl_als
