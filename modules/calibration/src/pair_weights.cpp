// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pair_weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <pcl_als/adjustment/robust_weight.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {

namespace {

constexpr std::size_t kEnoughForScale = 30;
// The chords of a TIN deviate from the surface by some millimetres: smaller scatters are
// accidental.
constexpr double kLeastScale = 0.25;

bool isOfPlan(const PairWeights::Group& group) {
  constexpr int kPlan = static_cast<int>(PairObservation::ControlError::plan);
  return group.first == PairObservation::kControl && group.second == group.first - kPlan;
}

using Values = std::vector<const PairResidual*>;

Values thinned(const Values& values, std::size_t every) {
  Values kept;
  for (std::size_t i = 0; i < values.size(); i += every) kept.push_back(values[i]);
  return kept;
}

/// Robust standard deviation of residuals with an expected mean of zero, over that of the noise
/// model; a mean different from zero counts as scatter.
double scatterOf(const Values& values, const VarianceParts& factors) {
  if (values.size() < kEnoughForScale) return 1.0;
  std::vector<double> standardised;
  standardised.reserve(values.size());
  for (const PairResidual* pair : values)
    standardised.push_back(pair->residual / std::sqrt(factors.variance(*pair)));
  return std::max(robustSigmaAboutZero(std::move(standardised)), kLeastScale);
}

/// -ln of the likelihood of a group's residuals under Huber's least favourable distribution.
double unlikeliness(const Values& values, const VarianceParts& factors) {
  const double scale = scatterOf(values, factors);
  double sum = 0.0;
  for (const PairResidual* pair : values) {
    const double variance = scale * scale * factors.variance(*pair);
    sum += 0.5 * std::log(variance) + huberLoss(pair->residual / std::sqrt(variance));
  }
  return sum;
}

/// The factors that are compared; those of echoes only where any pair has such a part.
std::vector<VarianceParts> candidateFactors(bool with_echoes) {
  std::vector<VarianceParts> factors;
  for (const double echo : {1.0, 0.25, 4.0, 16.0, 64.0}) {
    for (const double pointing : {1.0, 0.5, 0.25, 0.1, 0.02, 2.0, 4.0})
      factors.push_back({pointing, echo});
    if (!with_echoes) break;
  }
  return factors;
}

}  // namespace

PairResidual::Group PairResidual::groupOf(const PairObservation& o) {
  if (o.a == PairObservation::kControl) return {o.a, o.a - static_cast<int>(o.control_error)};
  return {std::min(o.a, o.b), std::max(o.a, o.b)};
}

VarianceParts PairWeights::mostLikelyFactors(const std::map<Group, Values>& groups, int threads) {
  constexpr std::size_t kSampledResiduals =
      3000;  // residuals of a group, to choose between the factors
  std::vector<std::pair<Values, double>> samples;  // with the residuals that one represents
  bool with_echoes = false;
  for (const auto& [group, values] : groups) {
    const std::size_t every = std::max<std::size_t>(1, values.size() / kSampledResiduals);
    samples.emplace_back(thinned(values, every), static_cast<double>(every));
    for (const PairResidual* pair : values) with_echoes = with_echoes || pair->echo > 0.0;
  }
  const std::vector<VarianceParts> factors = candidateFactors(with_echoes);
  std::vector<double> costs(factors.size(), 0.0);
  parallelFor(factors.size(), threads, [&](std::size_t i) {
    for (const auto& [values, represented] : samples)
      costs[i] += represented * unlikeliness(values, factors[i]);
  });
  return factors[static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) -
                                          costs.begin())];
}

void PairWeights::findScales(const Residuals& residuals, int threads) {
  std::map<Group, Values> groups;
  for (const std::vector<PairResidual>& area : residuals) {
    auto current = groups.end();  // pairs of a group follow each other
    for (const PairResidual& pair : area) {
      if (current == groups.end() || current->first != pair.group)
        current = groups.try_emplace(pair.group).first;
      current->second.push_back(&pair);
    }
  }
  factors_ = mostLikelyFactors(groups, threads);
  std::vector<std::pair<const Values*, double*>> scales;
  scales.reserve(groups.size());
  for (const auto& [group, values] : groups) scales.emplace_back(&values, &scales_[group]);
  parallelFor(scales.size(), threads,
              [&](std::size_t i) { *scales[i].second = scatterOf(*scales[i].first, factors_); });
  // Places of targets are few, and unknowns of the strips fit them: their residuals are no evidence
  // of a smaller variance.
  for (const auto& [group, values] : groups)
    if (isOfPlan(group)) scales_[group] = std::max(scales_[group], 1.0);
}

PairWeights::Kept PairWeights::weigh(const std::vector<PairResidual>& residuals, bool reject,
                                     std::vector<double>& weights) const {
  const RobustWeight weight{kHuberLimit, reject ? kRejectionLimit : kNoRejection};
  Kept kept;
  weights.reserve(residuals.size());
  auto found = scales_.end();
  for (const PairResidual& pair : residuals) {
    if (found == scales_.end() || found->first != pair.group) found = scales_.find(pair.group);
    const double scale = found == scales_.end() ? 1.0 : found->second;
    const double variance = scale * scale * factors_.variance(pair);
    const double robust = weight(pair.residual / std::sqrt(variance));
    weights.push_back(robust * pair.variance / (variance * pair.variance_inflation));
    if (robust == 0.0) continue;
    kept.squares += pair.residual * pair.residual / pair.variance;
    ++kept.pairs;
  }
  return kept;
}

void PairWeights::update(const Residuals& residuals, bool reject, int threads) {
  weights_.assign(residuals.size(), {});
  std::vector<Kept> kept(residuals.size());
  parallelFor(residuals.size(), threads, [&](std::size_t area) {
    kept[area] = weigh(residuals[area], reject, weights_[area]);
  });
  Kept sum;
  for (const Kept& of_area : kept) {
    sum.squares += of_area.squares;
    sum.pairs += of_area.pairs;
  }
  kept_ = sum.pairs;
  sigma0_ = kept_ > 0 ? std::sqrt(sum.squares / static_cast<double>(kept_)) : 0.0;
}

double PairWeights::meanScale() const {
  double squares = 0.0, count = 0.0;
  for (const auto& [group, scale] : scales_) {
    if (group.first == PairObservation::kControl) continue;
    squares += scale * scale;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(squares / count) : 1.0;
}

}  // namespace pcl_als
