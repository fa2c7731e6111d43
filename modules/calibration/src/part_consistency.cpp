// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "part_consistency.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl_als {
namespace {

constexpr double kSignificant = 3.3;  // standard deviations of a difference
// Of two independent halves of equal information each has 1.4 times the standard deviation of all.
constexpr double kMuchWorse = 4.0;
constexpr std::size_t kFewest = 4;  // areas of a half

/// The areas with pairs, in the order of a coordinate, halved by number of pairs: true for the
/// second half. Empty where a half would have too few areas.
std::vector<bool> secondHalf(const AreaAdjustment& adjustment, int axis) {
  std::vector<std::size_t> order;
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < adjustment.pairs.size(); ++i) {
    if (adjustment.pairs[i] == 0) continue;
    order.push_back(i);
    pairs += adjustment.pairs[i];
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return adjustment.places[a][axis] < adjustment.places[b][axis];
  });
  std::vector<bool> second(adjustment.pairs.size(), false);
  std::size_t before = 0, areas = 0;
  for (const std::size_t i : order) {
    second[i] = 2 * before >= pairs;
    before += adjustment.pairs[i];
    areas += second[i] ? 1 : 0;
  }
  if (areas < kFewest || order.size() < areas + kFewest) second.clear();
  return second;
}

AdjustmentSolution halfOf(const AreaAdjustment& adjustment, std::vector<bool> second, bool which) {
  if (!which) second.flip();
  const Adjustment half(adjustment.whole, second);
  return half.solve(adjustment.estimate, SystemVector::Zero());
}

}  // namespace

std::vector<PartDifference> partDifferences(const AreaAdjustment& adjustment) {
  std::vector<PartDifference> found;
  const AdjustmentSolution all = adjustment.whole.solve(adjustment.estimate, SystemVector::Zero());
  const char* const names[] = {"the western and the eastern half",
                               "the southern and the northern half"};
  for (int axis = 0; all.solved && axis < 2; ++axis) {
    const std::vector<bool> second = secondHalf(adjustment, axis);
    if (second.empty()) continue;
    const AdjustmentSolution low = halfOf(adjustment, second, false);
    const AdjustmentSolution high = halfOf(adjustment, second, true);
    if (!low.solved || !high.solved) continue;
    for (const SystemParameter parameter : adjustment.estimate) {
      const int i = indexOf(parameter);
      const double largest = std::max(low.covariance(i, i), high.covariance(i, i));
      if (!(largest < kMuchWorse * kMuchWorse * all.covariance(i, i))) continue;
      const PartDifference here{parameter, names[axis], high.biases[i] - low.biases[i],
                                std::sqrt(low.covariance(i, i) + high.covariance(i, i))};
      if (!(std::abs(here.difference) > kSignificant * here.std)) continue;
      const auto other = std::find_if(found.begin(), found.end(), [&](const PartDifference& d) {
        return d.parameter == parameter;
      });
      if (other == found.end()) {
        found.push_back(here);
      } else if (std::abs(here.difference) > std::abs(other->difference)) {
        *other = here;
      }
    }
  }
  return found;
}

void judgeParts(const std::vector<PartDifference>& differences, CalibrationResult& result) {
  for (const PartDifference& d : differences) {
    ParameterEstimate& p = result[d.parameter];
    if (p.status != ParameterStatus::estimated) continue;
    // The mean of two halves that differ by d has the variance d^2 / 4; that of the difference,
    // divided by 4, is already in the standard deviation.
    const double excess = 0.25 * (d.difference * d.difference - d.std * d.std);
    p.std = std::sqrt(p.std * p.std + std::max(0.0, excess));
    char ratio[48];
    std::snprintf(ratio, sizeof ratio, "%.1f combined standard deviations",
                  std::abs(d.difference) / d.std);
    p.reason += (p.reason.empty() ? "" : "; ") + std::string("differs between ") + d.halves +
                " of the block by " + ratio + ", which its standard deviation includes";
    result.warnings.push_back(
        {std::string(infoOf(d.parameter).name) + " differs between " + d.halves +
             " of the block by " + ratio +
             ": deformations of the strips or errors of the scanner that the model does not "
             "contain; its standard deviation includes the difference",
         Hint::strips});
  }
}

}  // namespace pcl_als
