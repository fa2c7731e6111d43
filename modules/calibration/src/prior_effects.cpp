// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "strip_error_check.h"

namespace pcl_als {
namespace {

// Standard deviations: a change by more than the stated uncertainty of the estimate.
constexpr double kChange = 1.0;
constexpr double kHalfInformation = 1.4142135623730951;  // ratio of standard deviations

int indexOfStrip(const std::vector<std::string>& strips, const std::string& id) {
  return static_cast<int>(std::find(strips.begin(), strips.end(), id) - strips.begin());
}

}  // namespace

bool PriorEffect::affected() const {
  return !(std::abs(change) <= kChange * std) || !(std_enlarged <= kHalfInformation * std);
}

std::vector<PriorEffect> priorEffects(const std::vector<StripErrorSize>& large,
                                      const std::vector<std::string>& strips,
                                      const Adjustment& adjustment, const ParameterChoice& choice) {
  std::vector<PriorEffect> effects;
  if (large.empty() || choice.estimate.empty()) return effects;
  const VarianceFactors levels = adjustment.levels();
  SharedErrors errors = adjustment.errors();
  const SharedErrors::Variances priors = errors.variances(VarianceFactors());
  const SharedErrors::Variances adjusted = errors.variances(levels);
  for (const StripErrorSize& e : large) {
    const double factor = e.ratio() * e.ratio() * priors[e.component] / adjusted[e.component];
    errors.setVarianceFactor(indexOfStrip(strips, e.strip), e.component, std::max(1.0, factor));
  }
  Adjustment enlarged = adjustment;
  enlarged.setErrors(errors);
  enlarged.setVarianceFactors(levels);
  const AdjustmentSolution other = enlarged.solve(choice.estimate, choice.solution.biases);
  for (const SystemParameter p : choice.estimate) {
    const int i = indexOf(p);
    PriorEffect effect{p, 0.0, std::sqrt(choice.solution.covariance(i, i)),
                       std::numeric_limits<double>::infinity()};
    if (other.solved) {
      effect.change = other.biases[i] - choice.solution.biases[i];
      effect.std_enlarged = std::sqrt(other.covariance(i, i));
    }
    effects.push_back(effect);
  }
  return effects;
}

}  // namespace pcl_als
