// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pair_weights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <pcl_als/adjustment/robust_weight.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {

struct PairWeights::Values {
  std::vector<double> residual, variance, pointing;

  void add(double of_residual, double of_variance, double of_pointing) {
    residual.push_back(of_residual);
    variance.push_back(of_variance);
    pointing.push_back(of_pointing);
  }
  Values thinned(std::size_t every) const {
    Values kept;
    for (std::size_t i = 0; i < residual.size(); i += every)
      kept.add(residual[i], variance[i], pointing[i]);
    return kept;
  }
};

namespace {

constexpr std::size_t kEnoughForScale = 30;
// The chords of a TIN deviate from the surface by some millimetres: smaller scatters are
// accidental.
constexpr double kLeastScale = 0.25;

bool isOfPlan(const PairWeights::Group& group) {
  constexpr int kPlan = static_cast<int>(PairObservation::ControlError::plan);
  return group.first == PairObservation::kControl && group.second == group.first - kPlan;
}

double varianceWith(double pointing_factor, double variance, double pointing) {
  return variance + (pointing_factor - 1.0) * pointing;
}

/// Robust standard deviation of residuals with an expected mean of zero, over that of the noise
/// model; a mean different from zero counts as scatter.
template <typename Values>
double scatterOf(const Values& values, double pointing_factor) {
  if (values.residual.size() < kEnoughForScale) return 1.0;
  std::vector<double> standardised(values.residual.size());
  for (std::size_t i = 0; i < standardised.size(); ++i) {
    standardised[i] =
        values.residual[i] /
        std::sqrt(varianceWith(pointing_factor, values.variance[i], values.pointing[i]));
  }
  return std::max(robustSigmaAboutZero(std::move(standardised)), kLeastScale);
}

/// -ln of the likelihood of a group's residuals under Huber's least favourable distribution.
template <typename Values>
double unlikeliness(const Values& values, double pointing_factor) {
  const double scale = scatterOf(values, pointing_factor);
  double sum = 0.0;
  for (std::size_t i = 0; i < values.residual.size(); ++i) {
    const double variance =
        scale * scale * varianceWith(pointing_factor, values.variance[i], values.pointing[i]);
    sum += 0.5 * std::log(variance) + huberLoss(values.residual[i] / std::sqrt(variance));
  }
  return sum;
}

}  // namespace

PairResidual::Group PairResidual::groupOf(const PairObservation& o) {
  if (o.a == PairObservation::kControl) return {o.a, o.a - static_cast<int>(o.control_error)};
  return {std::min(o.a, o.b), std::max(o.a, o.b)};
}

double PairWeights::mostLikelyPointing(const std::map<Group, Values>& groups, int threads) {
  constexpr std::array<double, 7> kFactors{1.0, 0.5, 0.25, 0.1, 0.02, 2.0, 4.0};
  constexpr std::size_t kSampledResiduals =
      3000;  // residuals of a group, to choose between the factors
  std::vector<std::pair<Values, double>> samples;  // with the residuals that one represents
  for (const auto& [group, values] : groups) {
    const std::size_t every = std::max<std::size_t>(1, values.residual.size() / kSampledResiduals);
    samples.emplace_back(values.thinned(every), static_cast<double>(every));
  }
  std::array<double, kFactors.size()> costs{};
  parallelFor(kFactors.size(), threads, [&](std::size_t i) {
    for (const auto& [values, represented] : samples)
      costs[i] += represented * unlikeliness(values, kFactors[i]);
  });
  return kFactors[static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) -
                                           costs.begin())];
}

void PairWeights::findScales(const Residuals& residuals, int threads) {
  std::map<Group, Values> groups;
  for (const std::vector<PairResidual>& area : residuals) {
    auto current = groups.end();  // pairs of a group follow each other
    for (const PairResidual& pair : area) {
      if (current == groups.end() || current->first != pair.group)
        current = groups.try_emplace(pair.group).first;
      current->second.add(pair.residual, pair.variance, pair.pointing);
    }
  }
  pointing_ = mostLikelyPointing(groups, threads);
  std::vector<std::pair<const Values*, double*>> scales;
  scales.reserve(groups.size());
  for (const auto& [group, values] : groups) scales.emplace_back(&values, &scales_[group]);
  parallelFor(scales.size(), threads,
              [&](std::size_t i) { *scales[i].second = scatterOf(*scales[i].first, pointing_); });
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
    const double variance = scale * scale * varianceWith(pointing_, pair.variance, pair.pointing);
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
