// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>

#include <pcl_als/calibration/adjustment.h>

namespace pcl_als {
namespace {

constexpr int kKinds = 4;
constexpr int kLowest = -12, kHighest = 4;  // powers of two
constexpr double kBelief = 1.0;          // standard deviation of ln(level) by the model's own word
using Powers = std::array<int, kKinds>;  // local last: it costs most to change

SharedErrorLevels levelsOf(const Powers& power) {
  return {std::exp2(power[0]), std::exp2(power[1]), std::exp2(power[2]), std::exp2(power[3])};
}

double cost(const Adjustment& adjustment, const std::vector<SystemParameter>& estimate,
            const Powers& power) {
  double belief = 0.0;
  for (const int p : power) belief += std::pow(p * std::log(2.0) / kBelief, 2);
  return adjustment.deviance(levelsOf(power), estimate) + belief;
}

}  // namespace

SharedErrorLevels mostLikelyLevels(Adjustment& adjustment,
                                   const std::vector<SystemParameter>& estimate) {
  Powers best{};
  const SharedErrorLevels now = adjustment.levels();
  best = {std::ilogb(now.position), std::ilogb(now.roll_pitch), std::ilogb(now.heading),
          std::ilogb(now.local)};
  double lowest = cost(adjustment, estimate, best);
  for (bool changed = true; changed;) {
    changed = false;
    for (int kind = kKinds - 1; kind >= 0; --kind) {
      for (const int step : {-1, 1}) {
        for (Powers next = best;;) {
          next[kind] += step;
          if (next[kind] < kLowest || next[kind] > kHighest) break;
          const double value = cost(adjustment, estimate, next);
          if (!(value < lowest)) break;
          lowest = value;
          best = next;
          changed = true;
        }
      }
      adjustment.setLevels(levelsOf(best));
    }
  }
  return levelsOf(best);
}

}  // namespace pcl_als
