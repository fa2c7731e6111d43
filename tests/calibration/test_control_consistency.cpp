// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "control_consistency.h"

namespace pcl_als {
namespace {

/// Points with normal residuals of \a std, expected to be \a expected; ids "0", "1", …
std::vector<ControlPointFit> points(std::size_t count, double std, double expected, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, std);
  std::vector<ControlPointFit> fits(count);
  for (std::size_t i = 0; i < count; ++i) {
    fits[i].id = std::to_string(i);
    fits[i].strips = 2;
    fits[i].expected_std = expected;
    fits[i].after = noise(random);
  }
  return fits;
}

CalibrationResult resultWithControl(const std::vector<ControlPointFit>& fits) {
  CalibrationResult result;
  result[SystemParameter::range_bias].status = ParameterStatus::estimated;
  result[SystemParameter::range_bias].std = 0.01;
  result[SystemParameter::boresight_roll].status = ParameterStatus::estimated;
  result[SystemParameter::boresight_roll].std = 1e-5;
  result.control_points = fits;
  const ControlConsistency control(fits);
  SystemVector spread = SystemVector::Zero();
  spread[indexOf(SystemParameter::range_bias)] =
      control.groups ? 0.5 * control.groups->separation : 0.0;
  spread[indexOf(SystemParameter::boresight_roll)] = 1e-7;
  judgeControl(control, spread, result);
  return result;
}

TEST(ControlConsistency, ControlAsGoodAsStatedIsNotRemarked) {
  // Six points exceed the limit of the scatter once in a thousand samples; 300 samples.
  int alarms = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    for (const std::size_t count : {6U, 12U, 40U}) {
      const CalibrationResult result = resultWithControl(points(count, 0.02, 0.02, seed));
      alarms += result.warnings.empty() && result.verdict.usable() ? 0 : 1;
    }
  }
  EXPECT_LE(alarms, 1);
}

TEST(ControlConsistency, HalfOfThePointsTooHighIsSaidAndAllowedFor) {
  // 2026-11: range_bias was 4.7 standard deviations off, without a warning.
  std::vector<ControlPointFit> fits = points(12, 0.01, 0.02, 1);
  for (std::size_t i = 0; i < 6; ++i) fits[i].after -= 0.2;
  const CalibrationResult result = resultWithControl(fits);
  EXPECT_EQ(result.verdict.status, CalibrationStatus::parameters_affected);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].text.find("higher above 6 of them"), std::string::npos)
      << result.warnings[0].text;
  const ControlConsistency control(fits);
  ASSERT_TRUE(control.groups);
  EXPECT_NEAR(control.groups->separation, 0.2, 0.02);
  for (const std::string& id : control.groups->lower) EXPECT_LT(std::stoi(id), 6);
  EXPECT_NEAR(result[SystemParameter::range_bias].std, 0.1, 0.02);
  EXPECT_NE(result.warnings[0].text.find("standard deviations of range_bias allow"),
            std::string::npos)
      << result.warnings[0].text;
  EXPECT_EQ(result[SystemParameter::boresight_roll].std, 1e-5) << "does not depend on it";
}

TEST(ControlConsistency, AScatterFarBeyondTheStatedSigmaIsSaid) {
  const CalibrationResult result = resultWithControl(points(30, 0.1, 0.02, 3));
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].text.find("check the control points"), std::string::npos);
  EXPECT_TRUE(result.verdict.usable());
}

TEST(ControlConsistency, RejectedPointsAreNamedWithTheirResiduals) {
  std::vector<ControlPointFit> fits = points(10, 0.02, 0.02, 4);
  fits[7].after = 1.25;
  fits[7].used = false;
  const CalibrationResult result = resultWithControl(fits);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].text.find("7 (+1.250 m)"), std::string::npos)
      << result.warnings[0].text;
  EXPECT_TRUE(result.verdict.usable());
}

/// A calibration was usable, with "control fits with an RMS of 0.000 m".
TEST(ControlConsistency, MostPointsRejectedIsAnObjection) {
  std::vector<ControlPointFit> fits = points(10, 0.02, 0.02, 4);
  for (std::size_t i = 0; i < 8; ++i) fits[i].after -= 1.5, fits[i].used = false;
  for (std::size_t i = 8; i < 10; ++i) fits[i].after -= 1.5;
  const CalibrationResult result = resultWithControl(fits);
  EXPECT_EQ(result.verdict.status, CalibrationStatus::parameters_affected);
  EXPECT_NE(result.verdict.reason.find("below 8 of 10 control points"), std::string::npos)
      << result.verdict.reason;
  for (ControlPointFit& fit : fits) fit.used = false;
  for (const Warning& warning : resultWithControl(fits).warnings)
    EXPECT_EQ(warning.text.find("RMS of 0.000 m"), std::string::npos) << warning.text;
}

}  // namespace
}  // namespace pcl_als
