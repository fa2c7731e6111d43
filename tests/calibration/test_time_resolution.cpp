// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/calibration/time_resolution.h>
#include <pcl_als/common/errors.h>

#include "simulated_survey.h"

namespace pcl_als {
namespace {

/// 20,000 points of 2 s, two returns per pulse, with times rounded down to a step.
TimeResolution rounded(double step) {
  TimeResolution resolution;
  for (int i = 0; i < 20'000; ++i) {
    const double time = 400'000.0 + (i / 2) * 2e-4;
    resolution.add(step > 0.0 ? step * std::floor(time / step) : time);
  }
  return resolution;
}

TEST(TimeResolution, FindsTheStepOfRoundedTimes) {
  EXPECT_EQ(rounded(0.0).step(), 0.0);
  EXPECT_DOUBLE_EQ(rounded(1.0).step(), 1.0);
  EXPECT_DOUBLE_EQ(rounded(1.0 / 32.0).step(), 1.0 / 32.0);
  EXPECT_EQ(rounded(1e-3).step(), 0.0);  // ten points per time: could be returns of one pulse
}

TEST(TimeResolution, SaysNothingOfFewPoints) {
  TimeResolution resolution;
  for (int i = 0; i < 999; ++i) resolution.add(5.0);
  EXPECT_EQ(resolution.step(), 0.0);
  resolution.add(5.0);
  EXPECT_TRUE(std::isinf(resolution.step()));  // a single time for all points
}

class RoundedTimes : public ::testing::Test {
 protected:
  RoundedTimes() : survey(options()) {}
  static simulation::SimulationOptions options() {
    auto options = simulation::SimulationOptions::preset("small", 1.0, 0.3);
    options.noise = simulation::NoiseOptions::named("range");
    return options;
  }
  void round(std::size_t strip) {
    for (CalibrationPoint& point : survey.strips[strip]) point.time = std::floor(point.time);
  }
  CalibrationResult calibrate() const {
    CalibrationSettings settings;
    settings.selection.point_budget = 200'000;
    settings.candidates = 10'000;
    return survey.calibrate(settings, true, true);
  }
  test::SimulatedSurvey survey;
};

TEST_F(RoundedTimes, LeaveTheirStripOut) {
  round(3);
  const CalibrationResult result = calibrate();
  std::string all;
  for (const std::string& warning : result.warnings) all += warning + "\n";
  EXPECT_NE(all.find("strip 4"), std::string::npos) << all;
  EXPECT_NE(all.find("1 s"), std::string::npos) << all;
  EXPECT_NE(all.find("left out"), std::string::npos) << all;
  for (const PairFit& pair : result.pairs) EXPECT_TRUE(pair.a != "4" && pair.b != "4");
  ASSERT_EQ(result[SystemParameter::lever_arm_y].status, ParameterStatus::estimated);
  const ParameterEstimate& arm = result[SystemParameter::lever_arm_y];
  const double error = arm.bias - survey.bias[indexOf(SystemParameter::lever_arm_y)];
  EXPECT_LT(std::abs(error), 3.5 * arm.std);
}

TEST_F(RoundedTimes, OfAllStripsAreRefused) {
  for (std::size_t strip = 0; strip < survey.strips.size(); ++strip) round(strip);
  try {
    calibrate();
    FAIL() << "calibrated with times in whole seconds";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("rounded"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pcl_als
