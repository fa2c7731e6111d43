// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "accuracy_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pcl_als::bench {
namespace {

constexpr double k68 = 0.9945, k95 = 1.96;  // standard deviations with that share of a normal

bool hasColumn(const SystemParameterInfo& info) {
  return info.parameter != SystemParameter::lever_arm_z;
}

}  // namespace

void AccuracyTable::printHeader() {
  std::printf(
      "| seed | dX m | dY m | pitch \" | roll \" | heading \" | dr m | dS | plan / height m | s "
      "|\n|---|---|---|---|---|---|---|---|---|---|\n");
}

void AccuracyTable::add(const ParameterEstimate& estimate, int parameter, double truth) {
  const double error = std::abs(estimate.bias - truth);
  const double standardised = error / estimate.std;
  count_[parameter] += 1.0;
  squares_[parameter] += error * error;
  largest_[parameter] = std::max(largest_[parameter], error);
  variances_[parameter] += estimate.std * estimate.std;
  standardised_[parameter] += standardised * standardised;
  if (standardised < k68) inside_68_[parameter] += 1.0;
  if (standardised < k95) inside_95_[parameter] += 1.0;
}

void AccuracyTable::printRow(const std::string& name, const CalibrationResult& result,
                             const SystemVector& truth, const std::string& rest) {
  std::printf("| %s%s |", name.c_str(), result.converged ? "" : " (not converged)");
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result[info.parameter];
    if (!hasColumn(info)) continue;
    if (estimate.status != ParameterStatus::estimated) {
      std::printf(" held |");
      continue;
    }
    const int i = indexOf(info.parameter);
    add(estimate, i, truth[i]);
    std::printf(" %.2g (%.2g) |", (estimate.bias - truth[i]) / info.internal_per_unit,
                estimate.std / info.internal_per_unit);
  }
  std::printf(" %s |\n", rest.c_str());
  std::fflush(stdout);
}

void AccuracyTable::addBound(const FisherBound& bound) {
  independent_ += bound.independent.cwiseAbs2();
  shared_ += bound.shared.cwiseAbs2();
}

void AccuracyTable::printValues(const std::string& name, const SystemVector& values,
                                bool in_units) {
  std::printf("| %s |", name.c_str());
  for (const SystemParameterInfo& info : systemParameters()) {
    if (!hasColumn(info)) continue;
    std::printf(" %.3g |",
                values[indexOf(info.parameter)] / (in_units ? info.internal_per_unit : 1.0));
  }
  std::printf(" | |\n");
}

void AccuracyTable::printTotals() const {
  const SystemVector rms = (squares_.array() / count_.array()).sqrt();
  printValues("estimated in", count_, false);
  printValues("RMS", rms, true);
  printValues("largest", largest_, true);
  printValues("std, RMS", (variances_.array() / count_.array()).sqrt(), true);
  printValues("RMS of error / std", (standardised_.array() / count_.array()).sqrt(), false);
  printValues("in 68 %", inside_68_.array() / count_.array(), false);
  printValues("in 95 %", inside_95_.array() / count_.array(), false);
  if (independent_.isZero(0.0)) return;
  const SystemVector independent = (independent_.array() / count_.array()).sqrt();
  const SystemVector shared = (shared_.array() / count_.array()).sqrt();
  printValues("bound, independent pairs", independent, true);
  printValues("RMS / that", rms.cwiseQuotient(independent), false);
  printValues("bound, points shared", shared, true);
  printValues("RMS / that", rms.cwiseQuotient(shared), false);
}

}  // namespace pcl_als::bench
