// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>

#include <pcl_als/calibration/adjustment.h>

namespace pcl_als {
namespace {

constexpr int kKinds = 4;
constexpr int kSteps = 4;  // of the search to a factor of two
constexpr int kLowest = -12 * kSteps, kHighest = 4 * kSteps;
using Powers = std::array<int, kKinds>;  // of 2^(1/kSteps); local last: it costs most to change

// -2 ln of the prior of a variance component relative to the model: Cauchy in ln(level), with a
// scale of a factor of e. A system may be far better than its data sheet or have no such error; the
// heavy tails let the observations decide then.
double minusTwoLogPrior(double level) {
  const double factor = std::log(level);
  return 2.0 * std::log1p(factor * factor);
}

double levelOf(int power) {
  return std::exp2(static_cast<double>(power) / kSteps);
}

int powerOf(double level) {
  return static_cast<int>(std::lround(kSteps * std::log2(level)));
}

SharedErrorLevels levelsOf(const Powers& power) {
  return {levelOf(power[0]), levelOf(power[1]), levelOf(power[2]), levelOf(power[3])};
}

double cost(const Adjustment& adjustment, const std::vector<SystemParameter>& estimate,
            const Powers& power) {
  double prior_term = 0.0;
  for (const int p : power) prior_term += minusTwoLogPrior(levelOf(p));
  return adjustment.deviance(levelsOf(power), estimate) + prior_term;
}

}  // namespace

SharedErrorLevels mostLikelyLevels(Adjustment& adjustment,
                                   const std::vector<SystemParameter>& estimate) {
  const SharedErrorLevels now = adjustment.levels();
  Powers best{powerOf(now.position), powerOf(now.roll_pitch), powerOf(now.heading),
              powerOf(now.local)};
  double lowest = cost(adjustment, estimate, best);
  const auto follow = [&](int kind, int step) {
    bool changed = false;
    for (Powers next = best;; changed = true) {
      next[kind] += step;
      if (next[kind] < kLowest || next[kind] > kHighest) return changed;
      const double value = cost(adjustment, estimate, next);
      if (!(value < lowest)) return changed;
      lowest = value;
      best = next;
    }
  };
  // First where the minimum is, by factors of two; then where in it: estimates follow the levels,
  // and would jump with them.
  for (const int step : {kSteps, 1}) {
    for (bool changed = true; changed;) {
      changed = false;
      for (int kind = kKinds - 1; kind >= 0; --kind) {
        if (follow(kind, -step) || follow(kind, step)) changed = true;
        adjustment.setLevels(levelsOf(best));
      }
    }
  }
  return levelsOf(best);
}

}  // namespace pcl_als
