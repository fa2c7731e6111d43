// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/calibration/adjustment.h>

namespace pcl_als {
namespace {

constexpr int kKinds = SharedErrorLevels::kCount;
constexpr int kSteps = 4;  // steps of the search per factor of two
constexpr int kLowest = -12 * kSteps, kHighest = 4 * kSteps;
// of 2^(1/kSteps); local last, because a change of it costs most
using Powers = std::array<int, kKinds>;

// -2 ln of the prior: Cauchy in the logarithm of a component, of scale 1, so that components may
// vanish for systems that are far more accurate than their data sheet.
double priorDeviance(double level) {
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
  std::array<double, kKinds> values{};
  std::transform(power.begin(), power.end(), values.begin(), levelOf);
  return SharedErrorLevels::of(values);
}

/// Coordinate descent over the powers.
class Search {
 public:
  Search(Adjustment& adjustment, const std::vector<SystemParameter>& estimate)
      : adjustment_(adjustment), estimate_(estimate) {
    const auto now = adjustment.levels().values();
    std::transform(now.begin(), now.end(), best_.begin(), powerOf);
    direction_.fill(-1);
    lowest_ = cost(best_);
  }

  /// Until no component improves by this step.
  void descend(int step) {
    int settled = 0;
    for (int kind = kKinds - 1; settled < kKinds; kind = (kind + kKinds - 1) % kKinds) {
      const int first = direction_[kind];
      const bool changed = follow(kind, first * step) || follow(kind, -first * step);
      settled = changed ? 1 : settled + 1;
      // Further evaluations use this local component, which is expensive to change.
      if (changed && kind == kKinds - 1) adjustment_.setLevels(levelsOf(best_));
    }
  }
  SharedErrorLevels result() const { return levelsOf(best_); }

 private:
  double cost(const Powers& power) const {
    double prior = 0.0;
    for (const int p : power) prior += priorDeviance(levelOf(p));
    return adjustment_.deviance(levelsOf(power), estimate_) + prior;
  }

  bool follow(int kind, int step) {
    bool changed = false;
    for (Powers next = best_;; changed = true) {
      next[kind] += step;
      if (next[kind] < kLowest || next[kind] > kHighest) return changed;
      const double value = cost(next);
      if (!(value < lowest_)) return changed;
      lowest_ = value;
      best_ = next;
      direction_[kind] = step > 0 ? 1 : -1;
    }
  }

  Adjustment& adjustment_;
  const std::vector<SystemParameter>& estimate_;
  Powers best_{}, direction_{};
  double lowest_ = 0.0;
};

}  // namespace

SharedErrorLevels mostLikelyLevels(Adjustment& adjustment,
                                   const std::vector<SystemParameter>& estimate) {
  Search search(adjustment, estimate);
  // Large steps first: components that are absent end far from the model's variance. Small ones
  // refine an earlier estimate, because the parameters change with the variance components.
  const auto start = adjustment.levels().values();
  if (std::all_of(start.begin(), start.end(), [](double level) { return level == 1.0; })) {
    search.descend(4 * kSteps);
    search.descend(kSteps);
  } else {
    search.descend(1);
  }
  adjustment.setLevels(search.result());
  return search.result();
}

}  // namespace pcl_als
