// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "simulated_survey.h"
#include "warning_texts.h"

namespace pcl_als {
namespace {

class RoundedTimes : public ::testing::Test {
 protected:
  RoundedTimes() : survey(options()) {}
  static simulation::SimulationOptions options() {
    auto options = simulation::SimulationOptions::preset("small", 1.0, 0.3);
    options.noise = simulation::NoiseOptions::named("range");
    return options;
  }
  void round(std::size_t strip) {
    for (LidarReturn& point : survey.strips[strip]) point.time = std::floor(point.time);
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
  const std::string all = test::joinedTexts(result.warnings);
  EXPECT_NE(all.find("strip 4"), std::string::npos) << all;
  EXPECT_NE(all.find("whole seconds"), std::string::npos) << all;
  EXPECT_NE(all.find("excluded"), std::string::npos) << all;
  ASSERT_EQ(result.excluded.size(), 1U);
  EXPECT_EQ(result.excluded[0].strip, "4");
  EXPECT_EQ(result.excluded[0].reason, ExclusionReason::rounded_times);
  EXPECT_EQ(result.excluded[0].points, survey.strips[3].size());
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
