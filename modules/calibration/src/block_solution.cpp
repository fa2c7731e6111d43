// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_solution.h"

#include <algorithm>
#include <map>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

#include "chosen_parameters.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

/// The parameters that are to be estimated where the data determine them.
std::vector<SystemParameter> wantedParameters(const ChoiceRules& rules,
                                              const SharedErrorModel& model) {
  std::vector<SystemParameter> wanted = rules.settings.estimate.empty()
                                            ? automaticParameters(rules.control_covered, model)
                                            : rules.settings.estimate;
  const auto excluded = [&](SystemParameter p) { return rules.excluded.count(p) > 0; };
  wanted.erase(std::remove_if(wanted.begin(), wanted.end(), excluded), wanted.end());
  return wanted;
}

/// The parameters that are neither estimated nor known.
std::vector<SystemParameter> unknownParameters(const ChoiceRules& rules,
                                               const SharedErrorModel& model) {
  std::vector<SystemParameter> unknown;
  if (rules.settings.estimate.empty() && !rules.control_covered &&
      !model.biases.of(SystemParameter::range_bias) &&
      rules.excluded.count(SystemParameter::range_bias) == 0)
    unknown.push_back(SystemParameter::range_bias);
  for (const auto& [p, reason] : rules.excluded) unknown.push_back(p);
  return unknown;
}

/// Chooses the parameters that all systems share, or those of the first one.
void chooseParametersOf(const ChoiceRules& rules, BlockSolution& solution) {
  const CalibrationSettings& settings = rules.settings;
  const SharedErrorModel& model = solution.adjustment.errors().model();
  const std::vector<SystemParameter> wanted = wantedParameters(rules, model);
  if (rules.coarse) {
    solution.choice.estimate = wanted;
    solution.choice.solution = solution.adjustment.solveNearZero(wanted, widePriorStd());
    return;
  }
  // Parameters requested by name are excluded at three times their limit only.
  const double factor = settings.estimate.empty() ? 1.0 : 3.0;
  solution.choice = chooseParameters(solution.adjustment, wanted, SystemVector::Zero(),
                                     settings.limits, factor, unknownParameters(rules, model));
  for (const auto& [p, reason] : rules.excluded) {
    solution.choice.status[indexOf(p)] = ParameterStatus::not_estimable;
    solution.choice.reason[indexOf(p)] = reason;
  }
}

}  // namespace

BlockSolution::BlockSolution(const SharedErrors& errors, int threads)
    : adjustment(errors, threads) {
  choice.solution = adjustment.unsolved(SystemVector::Zero());
  differences = systemDifferences(errors, choice.solution.shared);
}

Corrections BlockSolution::corrections(const ErrorSourceVector& held_sources) const {
  Corrections corrections{solution().biases, differences, held_sources};
  const SharedErrors& errors = adjustment.errors();
  for (const ErrorSource source : errors.consideredSources()) {
    if (source != ErrorSource::slope_ranging)
      corrections.sources[indexOf(source)] += solution().shared[errors.sourceUnknown(source)];
  }
  return corrections;
}

PairWeights::Residuals pairResiduals(const std::vector<AreaObservations>& observations,
                                     const Adjustment& adjustment,
                                     const AdjustmentSolution& solution, int threads) {
  PairWeights::Residuals residuals(observations.size());
  parallelFor(residuals.size(), threads, [&](std::size_t area) {
    residuals[area].reserve(observations[area].size());
    for (const PairObservation& o : observations[area])
      residuals[area].emplace_back(o, adjustment.residual(o, solution) - o.offset);
  });
  return residuals;
}

void weigh(const PairSet& pairs, bool reject, int threads, BlockSolution& solution) {
  const PairWeights::Residuals residuals =
      pairResiduals(pairs.observations, solution.adjustment, solution.solution(), threads);
  // A selection is not representative: it consists mostly of slopes far from the flight line.
  if (!pairs.rules.selected) solution.weights.findScales(residuals, threads);
  solution.weights.update(residuals, reject, threads);
  solution.weighed = true;
}

void choose(const ChoiceRules& rules, BlockSolution& solution) {
  Adjustment& adjustment = solution.adjustment;
  chooseParametersOf(rules, solution);
  SharedErrors errors = adjustment.errors();
  while (!rules.coarse && errors.systems().count > 1 &&
         shareUndetermined(adjustment, solution.choice, rules.settings.limits, errors)) {
    adjustment.setErrors(errors);
    adjustment.setVarianceFactors(adjustment.levels());
    chooseParametersOf(rules, solution);
  }
  solution.differences = systemDifferences(errors, solution.solution().shared);
  solution.weighed = false;
}

void adjust(const PairSet& pairs, const ChoiceRules& rules, bool first, BlockSolution& solution) {
  // Later sets of pairs begin with the weights of the previous one.
  constexpr int kFirstWeightings = 3;
  for (int i = 0; i < (first ? kFirstWeightings : 1); ++i) {
    if (!solution.weighed) weigh(pairs, !first || i > 0, rules.settings.threads, solution);
    solution.adjustment.accumulate(pairs.observations, solution.weights.weights());
    choose(rules, solution);
  }
}

double smallerThreshold(const PairSet& pairs, const BlockSolution& solution, double threshold) {
  constexpr double kSmallest = 0.25;  // metres
  constexpr double kFactor = 6.0;
  constexpr std::size_t kEnoughForScale = 30;
  if (threshold <= kSmallest) return threshold;
  std::map<PairWeights::Group, std::vector<double>> distances;
  const StripSystems& systems = solution.adjustment.errors().systems();
  for (const AreaObservations& area : pairs.observations)
    for (const PairObservation& o : area)
      distances[PairResidual::groupOf(o)].push_back(
          o.distance(solution.solution().biases) -
          effectOfSystems(systems, solution.differences, o));
  double widest = 0.0;
  for (const auto& [group, values] : distances)
    if (values.size() >= kEnoughForScale) widest = std::max(widest, robustSigma(values));
  return std::clamp(kFactor * widest, kSmallest, threshold);
}

}  // namespace pcl_als
