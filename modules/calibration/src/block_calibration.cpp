// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_calibration.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/statistics.h>

#include "block_diagnosis.h"
#include "block_estimate.h"
#include "calibration_judgement.h"
#include "calibration_report.h"
#include "error_diagnosis.h"
#include "large_corrections.h"
#include "misfit_comparison.h"
#include "pair_coverage.h"
#include "prior_comparison.h"
#include "rejected_pairs.h"
#include "strip_error_check.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

/// Sets the height and the swath of the strips from the patches of their pairs.
void measureStrips(const std::vector<AreaObservations>& observations,
                   std::vector<StripTrajectory>& strips) {
  std::vector<std::vector<double>> heights(strips.size());
  for (const AreaObservations& area : observations) {
    for (const PairObservation& o : area) {
      const auto strip = static_cast<std::size_t>(o.b);
      heights[strip].push_back(o.height);
      strips[strip].half_angle =
          std::max<double>(strips[strip].half_angle, std::atan2(o.lateral, o.height));
    }
  }
  for (std::size_t i = 0; i < strips.size(); ++i)
    if (!heights[i].empty()) strips[i].height = medianInPlace(heights[i]);
}

/// Surfaces that are held fixed become control in the pairs, which then are to be formed anew.
AdjustedSurvey adjustedSurvey(const SurveyBlock& block, const BlockSolution& solution,
                              PairSet& pairs) {
  AdjustedSurvey adjusted;
  const std::vector<TimeSpan> spans = block.flownTimes();
  for (std::size_t i = 0; i < block.strips.size(); ++i) {
    const bool held = block.strips.isFixed(static_cast<int>(i));
    adjusted.strips.push_back(
        {block.strips.ids[i], held ? TimeSpan(0.0, 0.0) : spans[i], block.surveyed[i].points});
  }
  if (!block.strips.held.empty()) {
    replaceHeld(block.strips, pairs.observations);
    pairs.moved = HUGE_VAL;
  }
  measureStrips(pairs.observations, adjusted.strips);
  adjusted.sample = thinned(pairs.observations, solution.weights.weights(), kRepresentative);
  adjusted.levels = solution.adjustment.levels();
  return adjusted;
}

/// Of the strips, metres per second.
double meanSpeed(const SurveyBlock& block) {
  double length = 0.0, duration = 0.0;
  for (const auto& [from, to] : block.flownTimes()) {
    SensorPose start, end;
    std::size_t cursor = 0;
    if (!block.trajectory().poseAt(from, start, cursor) ||
        !block.trajectory().poseAt(to, end, cursor))
      continue;
    length += (end.position - start.position).norm();
    duration += to - from;
  }
  return duration > 0.0 ? length / duration : 0.0;
}

/// The noise of points and the sizes of the trajectory errors, as estimated.
ErrorLevels errorLevels(const NoiseModel& noise, const BlockSolution& solution) {
  const double scale = solution.weights.meanScale();
  const double pointing = scale * std::sqrt(solution.weights.factors().pointing);
  const auto trajectory = solution.adjustment.errors().variances(solution.adjustment.levels());
  ErrorLevels levels;
  levels.range = scale * noise.range;
  // The scatter on slopes shows the sum of both: all of it is assigned to the direction, and the
  // share of the footprint also to the range.
  levels.angle = pointing * std::hypot(noise.angle, noise.footprint());
  levels.footprint = pointing * noise.footprint();
  levels.position = scale * noise.position;
  levels.trajectory_position = std::sqrt(trajectory[0]);
  levels.trajectory_roll_pitch = std::sqrt(trajectory[3]);
  levels.trajectory_heading = std::sqrt(trajectory[5]);
  return levels;
}

/// The pairs of strips that were to be compared, with their height offsets.
std::vector<OverlappingPair> overlappingPairs(const SurveyBlock& block) {
  std::vector<OverlappingPair> found;
  for (std::size_t i = 0; i < block.pairs.size(); ++i) {
    const auto [a, b] = block.pairs[i];
    if (!block.strips.isReference(a) && !block.strips.isReference(b))  // checked before
      found.push_back({block.strips.ids[static_cast<std::size_t>(a)],
                       block.strips.ids[static_cast<std::size_t>(b)], block.pair_heights[i]});
  }
  return found;
}

/// What the block and its adjustment say of the system.
void describeSolution(const SurveyBlock& block, const BlockEstimate& estimate,
                      const CalibrationReport& report, CalibrationResult& result) {
  const CalibrationSettings& settings = block.settings();
  const BlockSolution& solution = estimate.solution;
  const Adjustment& adjustment = solution.adjustment;
  result.converged = estimate.control.isConverged();
  result.iterations = estimate.control.iterations();
  result.sigma0 = solution.weights.sigma0();
  result.redundancy = solution.redundancy();
  result.excluded = block.excluded;
  result.attitude = block.flight.attitude;
  result.recovered_attitude = block.flight.recovered;
  result.scan_planes = block.trajectory().scanPlanes();
  result.line_fit_half_width = block.trajectory().lineFitHalfWidth();
  report.addParameters(solution.choice, settings.estimate, result);
  reportPrior(adjustment.errors().model().biases, solution.choice, estimate.released, result);
  addSystems(adjustment, adjustment.errors(), solution.choice, settings.systems, block.strips.ids,
             result);
  report.addStrips(adjustment.errors(), block.strips.corrected(), adjustment, solution.choice,
                   result);
  result.error_levels = errorLevels(settings.noise, solution);
  addErrorSources(adjustment.errors(), solution.choice, estimate.diagnosed,
                  swathEdge(estimate.pairs.observations), estimate.scale, meanSpeed(block), result);
  addHeldSources(estimate.pairs.rules.held_sources, result);
  judgeBlockOffset(estimate, result);
  stateReferenceIntensity(result);
}

/// Lets the distances of the pairs be those of points corrected by what the result states, which is
/// not all that the solution contains.
void setStatedEffects(const BlockSolution& solution, const ErrorSourceVector& held_sources,
                      const CalibrationResult& result,
                      std::vector<AreaObservations>& observations) {
  const StripSystems& systems = solution.adjustment.errors().systems();
  const std::vector<SystemUnknowns> stated =
      statedDifferences(result, systems, solution.differences);
  const ErrorSourceVector sources = result.sources - held_sources;
  for (AreaObservations& area : observations) {
    for (PairObservation& o : area)
      o.other_effects = static_cast<float>(effectOfSystems(systems, stated, o));
    addSourceEffects(sources, area);
  }
}

/// Adds the fits of all pairs, which become those of the estimate.
void addFits(AreaSample& sample, const CalibrationReport& report, BlockEstimate& estimate,
             CalibrationResult& result) {
  const SurveyBlock& block = sample.block();
  const BlockSolution& solution = estimate.solution;
  PairSet& pairs = estimate.pairs;
  const std::vector<AreaUse> used = pairs.used(solution.weights.weights());
  addFarPairs(sample, estimate.corrections(), pairs);
  setStatedEffects(solution, pairs.rules.held_sources, result, pairs.observations);
  report.addControlPoints(
      block.request.control, pairs.observations, used,
      std::sqrt(solution.adjustment.errors().variances(solution.adjustment.levels())[0]), result);
  report.addStripFit(pairs.observations, solution.adjustment, solution.solution(), result);
  report.addFit(pairs.observations, result.biases(), true, result);
  addHeldFit(block, pairs, result.biases(), true, result);
  warnOfTargets(sample, result);
}

/// Adds warnings and the verdict.
void judge(const SurveyBlock& block, const BlockEstimate& estimate,
           const std::vector<PriorEffect>& effects, CalibrationResult& result) {
  const CalibrationSettings& settings = block.settings();
  const HeightError& height = block.flight.height_error;
  diagnoseStrips(block, result);
  assessControl(block, estimate, result);
  assessHeight(height, settings, result);  // a cause of the errors that follow
  assessStripErrors(settings, effects, height, result);
  judgeCalibration(settings.estimate, estimate.control.reasonNotConverged(estimate.solution),
                   result);
  assessParts(block, estimate, result);  // larger standard deviations must not make a result usable
  judgePairCoverage(overlappingPairs(block), settings.max_normal_distance, result);
  nameUndetermined(swathEdge(estimate.pairs.observations), settings.limits.on_points, result);
}

}  // namespace

BlockCalibration calibrate(AreaSample& sample,
                           const std::function<void(const CalibrationIteration&)>& progress) {
  const SurveyBlock& block = sample.block();
  const CalibrationSettings& settings = block.settings();
  BlockCalibration made;
  CalibrationResult& result = made.result;
  result.warnings = block.warnings;
  const auto warn = [&result](const Warnings& warnings) {
    result.warnings.insert(result.warnings.end(), warnings.begin(), warnings.end());
  };
  warn(sample.prepare());
  BlockEstimate estimate = startOf(sample);
  const BlockSolution& solution = estimate.solution;
  ChoiceRules rules{settings, isControlCovered(estimate.pairs, block), true, {}};
  warn(warningsOfControl(estimate.pairs, block));
  const CalibrationReport report(block.strips.ids, !rules.control_covered);
  report.addFit(estimate.pairs.observations, SystemVector::Zero(), false, result);
  addHeldFit(block, estimate.pairs, SystemVector::Zero(), false, result);
  const MisfitComparison misfit(estimate.pairs.observations);
  iterateToConvergence(sample, rules, progress, estimate);
  describeSolution(block, estimate, report, result);
  const std::vector<PriorEffect> effects = priorEffects(
      largeStripErrors(result.strip_errors, settings.shared_errors, kNoticeableCorrection),
      block.strips.ids, solution.adjustment, solution.choice);
  checkHeldHeights(block, solution, result);
  LargeCorrectionHints hints{diagnoseParts(sample, estimate, result)};
  if (!result.converged)  // the last pairs are newer than their weights
    weigh(estimate.pairs, true, settings.threads, estimate.solution);
  made.information = solution.adjustment.informationShares(solution.choice.estimate);
  made.information.resize(block.areas.size(), 0.0);
  made.adjusted = adjustedSurvey(block, solution, estimate.pairs);
  hints.rejected_together = areRejectedTogether(estimate.pairs, solution.weights.weights());
  addFits(sample, report, estimate, result);
  result.large_corrections =
      largeCorrections(block, estimate, result.strip_errors, made.adjusted.strips, hints);
  result.misfit = misfit.change(estimate.pairs.observations, result.biases());
  const BiasPrior& prior = settings.shared_errors.biases;
  if (prior.any())
    result.rms_with_prior =
        misfit.change(estimate.pairs.observations, prior.replacing(result.biases())).rms_after;
  judge(block, estimate, effects, result);
  return made;
}

void shareIndex(Communicator* processes, const SharedItems& strips, BlockIndex& index) {
  if (!areShared(processes)) return;
  std::vector<std::string> bytes(index.strips().size());
  for (const std::size_t strip : strips.ownItems()) {
    ByteWriter out;
    index.putStrip(static_cast<int>(strip), out);
    bytes[strip] = out.take();
  }
  shareBytes(processes, strips, bytes);
  for (std::size_t strip = 0; strip < bytes.size(); ++strip) {
    if (strips.mine(strip)) continue;
    ByteReader in(bytes[strip]);
    index.getStrip(static_cast<int>(strip), in);
  }
}

}  // namespace pcl_als
