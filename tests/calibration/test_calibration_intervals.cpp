// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Whether errors are as large as they are said to be, over several blocks: one block alone shows
// little. The full experiment is tests/benchmarks/calibration_uncertainty.md.
#include <cmath>

#include <gtest/gtest.h>

#include "simulated_survey.h"

namespace pcl_als {
namespace {

using simulation::NoiseOptions;
using simulation::SimulationOptions;

constexpr int kBlocks = 8;

/// Sums over blocks of (error / standard deviation)^2.
struct Standardised {
  double squares = 0.0, count = 0.0;

  void add(double error, double std) {
    squares += error * error / (std * std);
    count += 1.0;
  }
  double rms() const { return std::sqrt(squares / count); }
};

SimulationOptions blockOf(int seed) {
  SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.5);
  options.noise = NoiseOptions::named("realistic");
  options.seed = static_cast<std::uint64_t>(seed);
  return options;
}

TEST(CalibrationIntervals, AreNeitherFarTooSmallNorFarTooLarge) {
  Standardised honest, formal;
  for (int seed = 1; seed <= kBlocks; ++seed) {
    const test::SimulatedSurvey survey(blockOf(seed));
    CalibrationSettings settings;
    settings.selection.point_budget = 200'000;
    settings.candidates = 10'000;
    const CalibrationResult result = survey.calibrate(settings, true, true);
    EXPECT_TRUE(result.converged) << "block " << seed;
    Standardised here;
    for (const SystemParameterInfo& info : systemParameters()) {
      const ParameterEstimate& estimate = result[info.parameter];
      if (estimate.status != ParameterStatus::estimated) continue;
      const double error = estimate.bias - survey.bias[indexOf(info.parameter)];
      honest.add(error, estimate.std);
      here.add(error, estimate.std);
      formal.add(error, estimate.std_formal);
    }
    RecordProperty("block_" + std::to_string(seed), std::to_string(here.rms()));
  }
  RecordProperty("rms", std::to_string(honest.rms()));
  EXPECT_GT(honest.count, 5.0 * kBlocks) << "too little is determined to say anything";
  // The parameters of a block are correlated: 50 numbers scatter like some 25, that is by 0.14.
  EXPECT_GT(honest.rms(), 0.5) << "intervals are too wide";
  EXPECT_LT(honest.rms(), 1.5) << "intervals are too narrow";
  EXPECT_GT(formal.rms(), 3.0) << "the blocks would not show what Eq. (26) omits";
}

TEST(PairSelection, ATenthOfThePairsTellsWhatAllOfThemTell) {
  const test::SimulatedSurvey survey(blockOf(1));
  CalibrationSettings settings;
  settings.selection.point_budget = 1'000'000;
  settings.candidates = 100'000'000;  // all points
  const CalibrationResult all = survey.calibrate(settings, true, true);
  const std::size_t pairs = all.iterations.back().correspondences;
  settings.pair_budget = pairs / 10 - 500;  // of strips: control comes on top
  const CalibrationResult part = survey.calibrate(settings, true, true);
  ASSERT_TRUE(all.converged && part.converged);
  EXPECT_LT(part.iterations.back().correspondences, pairs / 10);
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = part[info.parameter];
    ASSERT_EQ(estimate.status, all[info.parameter].status) << info.name;
    if (estimate.status != ParameterStatus::estimated) continue;
    EXPECT_NEAR(estimate.bias, all[info.parameter].bias, 0.3 * estimate.std) << info.name;
    EXPECT_NEAR(estimate.std, all[info.parameter].std, 0.3 * estimate.std) << info.name;
  }
}

}  // namespace
}  // namespace pcl_als
