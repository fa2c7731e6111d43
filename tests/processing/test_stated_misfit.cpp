// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// What the verdict of a calibration states of the corrected strips, measured on points that were
// corrected by the result as it is written and read again.
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/io/survey_io.h>
#include <pcl_als/trajectory/system_correction.h>

#include "simulated_survey.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using simulation::SimulationOptions;
using test::SimulatedSurvey;

/// Enough for what is compared here.
CalibrationSettings quickSettings() {
  CalibrationSettings settings;
  settings.candidates = 20'000;
  return settings;
}

CalibrationResult calibrated(const SimulatedSurvey& survey, const CalibrationSettings& settings) {
  return survey.calibrate(settings, true, true);
}

/// Corrects the points by what a file of the result contains.
void correct(const CalibrationResult& result, SimulatedSurvey& survey) {
  const auto path = test::scratch("stated_misfit") / "calibration.json";
  writeCalibration(path, result);
  const CalibrationResult written = readCalibration(path);
  const SystemCorrection correction(written, survey.trajectory);
  for (std::size_t strip = 0; strip < survey.strips.size(); ++strip) {
    std::vector<LidarReturn>& points = survey.strips[strip];
    const std::size_t count = points.size();
    std::vector<double> time, axes[3], change[3];
    std::vector<float> intensity;
    std::vector<std::int8_t> scan_direction;
    const std::vector<std::uint16_t> source(count, static_cast<std::uint16_t>(strip + 1));
    for (const LidarReturn& point : points) {
      time.push_back(point.time);
      intensity.push_back(point.intensity);
      scan_direction.push_back((point.flags & kScanDirection) != 0 ? -1 : 1);
      for (int axis = 0; axis < 3; ++axis) axes[axis].push_back(point.position[axis]);
    }
    for (std::vector<double>& values : change) values.resize(count);
    CoverageCount coverage;
    correction.change({time.data(), axes[0].data(), axes[1].data(), axes[2].data(),
                       intensity.data(), scan_direction.data(), source.data()},
                      count, {change[0].data(), change[1].data(), change[2].data()}, coverage);
    for (std::size_t i = 0; i < count; ++i)
      points[i].position += Eigen::Vector3d(change[0][i], change[1][i], change[2][i]);
  }
}

/// The misfit that a result states for the calibrated strips is that of the corrected points, as
/// delivered to another calibration: to 3 % and 0.5 mm, because it pairs other points.
void expectStatedMisfit(const CalibrationResult& result, SimulatedSurvey survey,
                        const CalibrationSettings& settings) {
  ASSERT_GT(result.misfit.points, 0U);
  correct(result, survey);
  const CalibrationResult again = calibrated(survey, settings);
  EXPECT_NEAR(again.misfit.rms_before, result.misfit.rms_after,
              5e-4 + 0.03 * result.misfit.rms_after);
  for (const PairFit& pair : result.pairs) {
    const auto same = [&](const PairFit& fit) { return fit.a == pair.a && fit.b == pair.b; };
    const auto found = std::find_if(again.pairs.begin(), again.pairs.end(), same);
    ASSERT_NE(found, again.pairs.end()) << pair.a << ':' << pair.b;
    EXPECT_NEAR(found->mean_before, pair.mean_after, 0.005) << pair.a << ':' << pair.b;
  }
}

/// Two flights of a flat site, of which the second one is 0.25 m too high: east and north are not
/// determined there, up is.
TEST(StatedMisfit, IsThatOfPointsWithoutTheOffsetOfASystem) {
  constexpr double kUp = 0.25;
  SimulationOptions options = SimulationOptions::preset("uav", 0.5, 0.2);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.scene.relief = 0.1;
  options.scene.buildings = options.scene.trees = 0.0;
  options.seed = 5;
  SimulatedSurvey survey(options);
  ASSERT_GE(survey.strips.size(), 4U);
  CalibrationSettings settings = quickSettings();
  settings.own.parameters.clear();
  settings.own.offset = true;
  settings.systems.resize(2);
  settings.systems[0].name = "A", settings.systems[1].name = "B";
  for (std::size_t i = 0; i < survey.strips.size(); ++i) {
    const bool second = i >= survey.strips.size() / 2;  // lines in both directions
    settings.systems[second ? 1 : 0].strips.push_back(std::to_string(i + 1));
    if (!second) continue;
    for (LidarReturn& point : survey.strips[i]) point.position.z() += kUp;
  }
  const CalibrationResult result = calibrated(survey, settings);
  ASSERT_TRUE(result.verdict.usable()) << result.verdict.text();
  const SystemEstimate& second = result.systems[1];
  EXPECT_EQ(second.offset_std.head<2>(), Eigen::Vector2d::Zero());
  EXPECT_EQ(second.offset.head<2>(), Eigen::Vector2d::Zero());
  EXPECT_GT(second.offset_std.z(), 0.0);
  EXPECT_NEAR(second.offset.z(), kUp, 4.0 * second.offset_std.z());
  EXPECT_LT(result.misfit.rms_after, 0.5 * result.misfit.rms_before);
  expectStatedMisfit(result, survey, settings);
}

TEST(StatedMisfit, IsThatOfPointsWithoutTheBiasesOfTwoSystems) {
  SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.4);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = 4;
  for (const char* strip : {"strip2", "strip4"})
    options.errors.add(std::string(strip) + ":boresight_roll=60");
  const SimulatedSurvey survey(options);
  CalibrationSettings settings = quickSettings();
  settings.systems = {{"morning", {"1", "3", "5"}}, {"noon", {"2", "4"}}};
  expectStatedMisfit(calibrated(survey, settings), survey, settings);
}

TEST(StatedMisfit, IsThatOfPointsWithoutErrorSources) {
  SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.4);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = 6;
  options.errors.add("mirror_torsion=60");
  const SimulatedSurvey survey(options);
  const CalibrationResult result = calibrated(survey, quickSettings());
  EXPECT_FALSE(result.sources.isZero(0.0));
  expectStatedMisfit(result, survey, quickSettings());
}

/// A strip that is held fixed is not corrected, although its common error is part of the model.
TEST(StatedMisfit, IsThatOfPointsBesideFixedStrips) {
  SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.4);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = 7;
  const SimulatedSurvey survey(options);
  CalibrationSettings settings = quickSettings();
  settings.fixed = {"3"};
  settings.fixed_sigma = 0.5;
  expectStatedMisfit(calibrated(survey, settings), survey, settings);
}

}  // namespace
}  // namespace pcl_als
