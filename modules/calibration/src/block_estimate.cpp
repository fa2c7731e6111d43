// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "area_matcher.h"
#include "chosen_parameters.h"
#include "error_diagnosis.h"
#include "pair_selection.h"

namespace pcl_als {
namespace {

// metres: standard deviation of the range bias of a mounted system, where an offset of the block
// may take its place
constexpr double kRangeBias = 0.25;

std::vector<ErrorSource> concernedSources(const ErrorSourceScale& scale) {
  std::vector<ErrorSource> sources;
  for (const ErrorSourceInfo& info : errorSources())
    if (scale.concerns(info.source)) sources.push_back(info.source);
  return sources;
}

/// Forms the pairs of all candidates.
void formAllPairs(AreaSample& sample, BlockEstimate& estimate) {
  PairRules rules = estimate.pairs.rules;
  rules.sampling = 1;
  rules.selected = false;
  estimate.pairs = formPairs(sample, estimate.corrections(), rules);
  estimate.solution.weighed = false;
}

/// Forms the pairs again, by the rules that they have.
void formAgain(AreaSample& sample, BlockEstimate& estimate) {
  estimate.pairs = formPairs(sample, estimate.corrections(), estimate.pairs.rules);
  estimate.solution.weighed = false;
}

/// Selects a reduced set of the pairs that gives nearly the estimates of all.
void selectPairs(AreaSample& sample, BlockEstimate& estimate) {
  PairSelectionSettings settings;
  settings.budget = sample.block().settings().pair_budget;
  const BlockSolution& solution = estimate.solution;
  const PairSelection selection(estimate.pairs.observations, solution.weights.weights(),
                                solution.adjustment, solution.solution(), settings);
  sample.forAreas([&](std::size_t i) {
    if (!sample.block().isControl(i))
      sample.area(i).keep(estimate.pairs.observations[i], selection.chosen()[i]);
  });
  estimate.pairs.rules.selected = true;
  estimate.pairs.moved = HUGE_VAL;
}

/// The error sources that a solution with all of them supports, as considered from now on.
void considerSources(const std::vector<ErrorSource>& sources, BlockSolution& solution) {
  SharedErrors errors = solution.adjustment.errors();
  errors.considerSources(sources);
  solution.adjustment.setErrors(errors);
  solution.adjustment.setVarianceFactors(solution.adjustment.levels());
}

/** \brief Finds the error sources that the data support, by an adjustment with all of them, and
 * estimates these. Returns whether they differ from those estimated before.
 */
bool selectSources(AreaSample& sample, const ChoiceRules& rules, BlockEstimate& estimate) {
  const CalibrationSettings& settings = sample.block().settings();
  BlockSolution& solution = estimate.solution;
  ErrorSourceVector& held = estimate.pairs.rules.held_sources;
  if (!settings.diagnose || !solution.solution().solved || estimate.pairs.count() == 0 ||
      !held.isZero(0.0))
    return false;
  if (!estimate.pairs.rules.isComplete()) formAllPairs(sample, estimate);
  const std::vector<ErrorSource> before = solution.adjustment.errors().consideredSources();
  const std::vector<ErrorSource> concerned = concernedSources(estimate.scale);
  if (!solution.weighed) weigh(estimate.pairs, true, settings.threads, solution);
  SharedErrors errors = solution.adjustment.errors();
  errors.considerSources(concerned);
  Adjustment all(errors, settings.threads);
  all.setVarianceFactors(solution.adjustment.levels());
  all.accumulate(estimate.pairs.observations, solution.weights.weights());
  estimate.diagnosed =
      solveForAllParameters(all, solution.choice.estimate, estimate.scale.to_control);
  std::vector<ErrorSource> supported{ErrorSource::slope_ranging};
  for (const ErrorSource source : concerned)
    if (isCorrected(source, estimate.diagnosed, settings.shared_errors))
      supported.push_back(source);
  if (settings.pair_budget > 0) {
    for (const ErrorSource source : supported)
      if (source != ErrorSource::slope_ranging)
        held[indexOf(source)] = estimate.diagnosed.shared[errors.sourceUnknown(source)];
    supported = before;
  }
  solution.adjustment = std::move(all);
  considerSources(supported, solution);
  choose(rules, solution);
  const bool changed = supported != before || !held.isZero(0.0);
  if (changed) estimate.pairs.moved = HUGE_VAL;  // they are removed from the points
  return changed;
}

/// Adds to the covariance of the parameters the effect of error sources for which there is
/// positive evidence, and that are not corrected because they are not supported: their mean square
/// if present times the probability that they are.
void allowForUndecidedSources(const SharedErrorModel& model, BlockEstimate& estimate) {
  const AdjustmentSolution& diagnosed = estimate.diagnosed;
  BlockSolution& solution = estimate.solution;
  if (!diagnosed.solved || !solution.solution().solved) return;
  for (const ErrorSource source : concernedSources(estimate.scale)) {
    const int i = indexOf(source);
    if (solution.adjustment.errors().isConsidered(source) ||
        estimate.pairs.rules.held_sources[i] != 0.0 || !isPossible(source, diagnosed, model))
      continue;
    const double square = diagnosed.source_value[i] * diagnosed.source_value[i] +
                          diagnosed.source_std[i] * diagnosed.source_std[i];
    const SystemVector derivative =
        solution.adjustment.derivativeBySource(source, solution.choice.estimate);
    const SystemMatrix effect =
        diagnosed.source_probability[i] * square * derivative * derivative.transpose();
    solution.choice.solution.covariance += effect;
    solution.choice.solution.of_flight += effect;
  }
}

/// Estimates the variance components of the shared errors, and solves with them.
void estimateComponents(const ChoiceRules& rules, BlockEstimate& estimate) {
  BlockSolution& solution = estimate.solution;
  const VarianceFactors before = solution.adjustment.levels();
  estimate.control.recordComponents(
      before,
      estimateLevels(solution.adjustment, solution.choice.estimate,
                     estimate.control.componentsStart(), estimate.control.componentsTolerance()));
  choose(rules, solution);
}

/// One iteration: an adjustment of the pairs, which are formed anew where the points moved.
void iterate(AreaSample& sample, ChoiceRules& rules, BlockEstimate& estimate) {
  const CalibrationSettings& settings = sample.block().settings();
  PairSet& pairs = estimate.pairs;
  BlockSolution& solution = estimate.solution;
  IterationControl& control = estimate.control;
  const Corrections before = estimate.corrections();
  const bool first = control.isFirst();
  const IterationControl::Step step = control.next(!pairs.rules.selected);
  rules.coarse = control.isCoarse();
  if (step.ends_coarse && settings.diagnose) {
    estimate.scale = sourceScale(sample, rules.control_covered);
    sample.considerSources(estimate.scale);
  }
  if (step.ends_coarse || (step.all_pairs && !pairs.rules.isComplete()))
    formAllPairs(sample, estimate);
  adjust(pairs, rules, first, solution);
  if (step.components && !solution.choice.estimate.empty()) estimateComponents(rules, estimate);
  weigh(pairs, true, settings.threads, solution);
  if (settings.pair_budget > 0 && !pairs.rules.selected) selectPairs(sample, estimate);
  const IterationMovement movement = movementOf(pairs, before, estimate.corrections());
  pairs.moved += movement.largest;
  control.record(before.biases, movement, pairs, solution);
  pairs.rules.threshold = smallerThreshold(pairs, solution, pairs.rules.threshold);
  if (!control.isConverged() && pairs.isOutdated()) formAgain(sample, estimate);
}

}  // namespace

AdjustmentSolution solveForAllParameters(const Adjustment& adjustment,
                                         const std::vector<SystemParameter>& estimated,
                                         bool to_control) {
  SystemVector std = widePriorStd();
  for (const SystemParameter p : estimated) std[indexOf(p)] = HUGE_VAL;
  if (to_control) std[indexOf(SystemParameter::range_bias)] = kRangeBias;
  std::vector<SystemParameter> parameters;
  for (const SystemParameterInfo& info : systemParameters()) {
    const bool is_offset = info.parameter == SystemParameter::lever_arm_z && to_control;
    if (!is_offset || std::isinf(std[indexOf(info.parameter)]))
      parameters.push_back(info.parameter);
  }
  return adjustment.solve(parameters, SystemVector::Zero(), std.cwiseAbs2().cwiseInverse());
}

BlockEstimate startOf(AreaSample& sample) {
  constexpr std::size_t kEnoughForMisfit = 100'000;  // pairs of the points as delivered
  const SurveyBlock& block = sample.block();
  const CalibrationSettings& settings = block.settings();
  const std::vector<std::vector<TimeSpan>> observed = measuredTimes(sample);
  const SharedErrors errors(block.flownTimes(), withKnotsFor(settings.shared_errors, observed),
                            observed, block.systems);
  BlockEstimate estimate{
      {}, BlockSolution(errors, settings.threads), {}, {}, IterationControl(settings)};
  estimate.scale.about_axis = block.scanner.about_axis;
  PairRules& rules = estimate.pairs.rules;
  rules.threshold = settings.max_normal_distance;
  rules.sampling = std::max<std::size_t>(1, sample.candidates().pairs / kEnoughForMisfit);
  formAgain(sample, estimate);
  const double offset = settings.diagnose ? startingOffset(sample, estimate.pairs) : 0.0;
  if (offset == 0.0) return estimate;
  considerSources({ErrorSource::slope_ranging, ErrorSource::height_offset}, estimate.solution);
  estimate.solution.choice.solution.shared[errors.sourceUnknown(ErrorSource::height_offset)] =
      offset;
  formAgain(sample, estimate);
  return estimate;
}

namespace {

void iterateWithPrior(AreaSample& sample, ChoiceRules& rules, const IterationCallback& progress,
                      BlockEstimate& estimate) {
  constexpr int kMostSelections = 3;
  constexpr std::size_t kPairsForFirstEstimate =
      20'000;  // pairs; determine the biases to some millimetres
  const CalibrationSettings& settings = sample.block().settings();
  PairRules& pair_rules = estimate.pairs.rules;
  // A selection of pairs represents all of them.
  const std::size_t pairs =
      settings.pair_budget > 0 ? std::numeric_limits<std::size_t>::max() : kPairsForFirstEstimate;
  const std::size_t sampling =
      std::max<std::size_t>(1, pair_rules.sampling * estimate.pairs.count() / pairs);
  if (sampling != pair_rules.sampling) {
    pair_rules.sampling = sampling;
    formAgain(sample, estimate);
  }
  IterationControl& control = estimate.control;
  for (int selections = 0;; ++selections) {
    while (control.continues(estimate.pairs.count(), rules, estimate.solution)) {
      iterate(sample, rules, estimate);
      if (progress) progress(control.iterations().back());
    }
    if (!control.isConverged() || !selectSources(sample, rules, estimate) ||
        selections == kMostSelections)
      break;
    control.continueWithSources();
  }
  allowForUndecidedSources(settings.shared_errors, estimate);
}

/// Does not use what the prior says of a parameter any more.
void releasePrior(SystemParameter parameter, const ChoiceRules& rules, BlockEstimate& estimate) {
  BlockSolution& solution = estimate.solution;
  SharedErrors errors = solution.adjustment.errors();
  errors.setPrior(errors.model().biases.without(parameter));
  solution.adjustment.setErrors(errors);
  solution.adjustment.setVarianceFactors(solution.adjustment.levels());
  choose(rules, solution);
  estimate.pairs.moved = HUGE_VAL;
  estimate.control.continueWithSources();
}

}  // namespace

void iterateToConvergence(AreaSample& sample, ChoiceRules& rules, const IterationCallback& progress,
                          BlockEstimate& estimate) {
  const BlockSolution& solution = estimate.solution;
  for (;;) {
    iterateWithPrior(sample, rules, progress, estimate);
    const BiasPrior& prior = solution.adjustment.errors().model().biases;
    if (!prior.of_other_missions) return;
    std::vector<PriorDifference> found = priorDifferences(prior, solution.choice);
    if (found.empty() || !found.front().significant) return;
    found.front().released = true;
    estimate.released.push_back(found.front());
    releasePrior(found.front().parameter, rules, estimate);
  }
}

}  // namespace pcl_als
