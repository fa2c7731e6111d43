// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Flights that determine little, with what a calibration flight of the same system tells.
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/distributions.h>
#include <pcl_als/history/calibration_history.h>
#include <pcl_als/io/prior_file.h>

#include "simulated_survey.h"
#include "warning_texts.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using simulation::NoiseOptions;
using simulation::PlannedLine;
using simulation::SimulationOptions;

constexpr int kFlights = 10;

CalibrationSettings settingsOf(const BiasPrior& prior = {}) {
  CalibrationSettings settings;
  settings.selection.point_budget = 200'000;
  settings.candidates = 10'000;
  settings.shared_errors.biases = prior;
  return settings;
}

/// The calibration flight of the system: cross lines, two heights, control.
SimulationOptions fullFlight(int seed) {
  SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.5);
  options.noise = NoiseOptions::named("realistic");
  options.seed = static_cast<std::uint64_t>(seed);
  return options;
}

/// A corridor over flat ground, flown there and back at one height.
SimulationOptions corridor(int seed) {
  SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.5);
  options.noise = NoiseOptions::named("realistic");
  options.seed = static_cast<std::uint64_t>(seed);
  options.scene.relief = 0.0;
  const PlannedLine there = options.lines[0];
  PlannedLine back = there;
  back.id = 2;
  std::swap(back.start, back.end);
  options.lines = {there, back};
  options.pairs = {{1, 2}};
  return options;
}

/// What the system has become since the calibration flight.
void change(SystemVector& bias, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> normal;
  for (int i = 0; i < kSystemParameterCount; ++i) bias[i] += normal(random) * missionChangeStd()[i];
}

BiasPrior priorFrom(const CalibrationResult& calibration) {
  PriorFile file;
  file.name = "calibration.json";
  file.earlier = calibration;
  file.change_std = missionChangeStd();
  return file.prior();
}

struct Sums {
  double with = 0.0, without = 0.0;
  int inside = 0;
};

/// The first of its calibration flights, calibrated once.
const CalibrationResult& firstCalibration() {
  static const CalibrationResult calibration =
      test::SimulatedSurvey(fullFlight(100)).calibrate(settingsOf(), true, true);
  return calibration;
}

/// Ten calibration flights of the system, combined.
BiasPrior priorOfHistory() {
  std::vector<CalibrationMission> missions;
  CalibrationResult newest;
  for (int flight = 0; flight < kFlights; ++flight) {
    newest =
        flight == 0
            ? firstCalibration()
            : test::SimulatedSurvey(fullFlight(100 + flight)).calibrate(settingsOf(), true, true);
    EXPECT_TRUE(newest.verdict.usable()) << newest.verdict.text();
    missions.push_back(missionOf(newest, "flight " + std::to_string(flight)));
  }
  return priorFrom(pooledInstrument(calibrationHistory(std::move(missions)), newest));
}

TEST(PriorOfMissions, GivesACorridorItsLeverArmAndPitch) {
  const std::vector<P> weak{P::lever_arm_x, P::lever_arm_y, P::boresight_pitch};
  std::map<P, Sums> sums;
  const BiasPrior prior = priorOfHistory();
  for (int flight = 0; flight < kFlights; ++flight) {
    SimulationOptions options = corridor(200 + flight);
    change(options.bias, flight);
    const test::SimulatedSurvey survey(options);
    const CalibrationResult without = survey.calibrate(settingsOf(), false, true);
    const CalibrationResult with = survey.calibrate(settingsOf(prior), false, true);
    for (const P p : weak) {
      const double truth = survey.bias[indexOf(p)];
      Sums& sum = sums[p];
      ASSERT_EQ(with[p].status, ParameterStatus::estimated) << infoOf(p).name;
      EXPECT_GT(with[p].prior_share, 0.3) << infoOf(p).name;
      sum.with += std::pow(with[p].bias - truth, 2);
      sum.without += std::pow(without[p].bias - truth, 2);
      if (std::abs(with[p].bias - truth) <= normalCritical(0.025) * with[p].std) ++sum.inside;
    }
    EXPECT_LT(with[P::boresight_roll].prior_share, with[P::lever_arm_x].prior_share);
  }
  for (const P p : weak) {
    const double unit = infoOf(p).internal_per_unit;
    RecordProperty(std::string(infoOf(p).name),
                   std::to_string(std::sqrt(sums[p].with / kFlights) / unit) + " / " +
                       std::to_string(std::sqrt(sums[p].without / kFlights) / unit) + ", inside " +
                       std::to_string(sums[p].inside));
    EXPECT_LT(std::sqrt(sums[p].with), std::sqrt(sums[p].without) / 3.0) << infoOf(p).name;
    EXPECT_GE(sums[p].inside, kFlights - 2) << infoOf(p).name;  // 95 %: 1.2 % probability of less
  }
}

TEST(PriorOfMissions, NamesTheParameterThatChanged) {
  SimulationOptions options = corridor(200);
  const double moved = 60.0 * kRadiansPerArcsec;
  options.bias[indexOf(P::boresight_roll)] += moved;
  const test::SimulatedSurvey survey(options);
  BiasPrior prior = priorFrom(firstCalibration());
  const CalibrationResult result = survey.calibrate(settingsOf(prior), false, true);
  ASSERT_FALSE(result.prior_differences.empty());
  const PriorDifference& found = result.prior_differences.front();
  EXPECT_EQ(found.parameter, P::boresight_roll);
  EXPECT_TRUE(found.significant && found.released);
  EXPECT_NEAR(found.change, moved, 3.0 * found.change_std);
  EXPECT_LT(found.change_std, 15.0 * kRadiansPerArcsec);
  for (std::size_t i = 1; i < result.prior_differences.size(); ++i)
    EXPECT_FALSE(result.prior_differences[i].significant) << i;
  EXPECT_FALSE(result.prior.of(P::boresight_roll));
  EXPECT_TRUE(result.prior.of(P::lever_arm_x));
  EXPECT_EQ(result[P::boresight_roll].prior_share < 0.9, true);
  // The value is that of this flight, not a mean of both.
  EXPECT_NEAR(result[P::boresight_roll].bias, options.bias[indexOf(P::boresight_roll)],
              3.0 * result[P::boresight_roll].std);
  const std::string warnings = test::joinedTexts(result.warnings);
  EXPECT_NE(warnings.find("boresight_roll: the prior of calibration.json says"), std::string::npos)
      << warnings;
  // A value that is stated is used, with a warning.
  prior.of_other_missions = false;
  const CalibrationResult stated = survey.calibrate(settingsOf(prior), false, true);
  EXPECT_TRUE(stated.prior.of(P::boresight_roll));
  ASSERT_FALSE(stated.prior_differences.empty());
  EXPECT_TRUE(stated.prior_differences.front().significant);
  EXPECT_FALSE(stated.prior_differences.front().released);
}

}  // namespace
}  // namespace pcl_als
