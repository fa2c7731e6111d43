// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {
namespace {

TEST(SystemParameters, AreTheEightInTheOrderOfTheDesignBlock) {
  const char* const names[] = {"lever_arm_x",     "lever_arm_y",     "lever_arm_z",
                               "boresight_pitch", "boresight_roll",  "boresight_heading",
                               "range_bias",      "scan_angle_scale"};
  for (int i = 0; i < kSystemParameterCount; ++i) {
    const SystemParameterInfo& info = systemParameters()[i];
    EXPECT_EQ(indexOf(info.parameter), i);
    EXPECT_EQ(info.name, names[i]);
    EXPECT_EQ(systemParameterNamed(names[i]), info.parameter);
  }
}

TEST(SystemParameters, UnitsOfTheInterface) {
  EXPECT_EQ(infoOf(SystemParameter::boresight_roll).unit, "arcsec");
  // 3600 arc-seconds are a degree.
  EXPECT_NEAR(3600.0 * infoOf(SystemParameter::boresight_roll).internal_per_unit, kPi / 180.0,
              1e-17);
  EXPECT_EQ(infoOf(SystemParameter::range_bias).unit, "m");
  EXPECT_EQ(infoOf(SystemParameter::range_bias).internal_per_unit, 1.0);
  EXPECT_EQ(infoOf(SystemParameter::scan_angle_scale).unit, "1");
}

TEST(SystemParameters, UnknownNamesAreNone) {
  EXPECT_FALSE(systemParameterNamed("boresight"));
  EXPECT_FALSE(systemParameterNamed(""));
  EXPECT_FALSE(systemParameterNamed("Boresight_roll"));
}

TEST(CalibrationResult, StartsWithNothingEstimated) {
  const CalibrationResult result;
  EXPECT_EQ(result.biases(), SystemVector(SystemVector::Zero()));
  for (const ParameterEstimate& parameter : result.parameters)
    EXPECT_EQ(parameter.status, ParameterStatus::fixed);
  EXPECT_FALSE(result.converged);
}

TEST(CalibrationResult, BiasesAreIndexedByParameter) {
  CalibrationResult result;
  result[SystemParameter::range_bias].bias = 0.12;
  SystemVector expected = SystemVector::Zero();
  expected[6] = 0.12;
  EXPECT_EQ(result.biases(), expected);
}

TEST(ParameterStatus, NamesAreThoseOfTheFile) {
  EXPECT_EQ(toString(ParameterStatus::estimated), "estimated");
  EXPECT_EQ(toString(ParameterStatus::fixed), "fixed");
  EXPECT_EQ(toString(ParameterStatus::not_estimable), "not_estimable");
}

/// Covariance [4 2; 2 9]: information 1/32 [9 -2; -2 4]; of one parameter alone 1/4 and 1/9.
TEST(BiasPrior, SaysLessOfSomeParametersAlone) {
  const SystemParameter x = SystemParameter::lever_arm_x, y = SystemParameter::lever_arm_y;
  SystemVector mean = SystemVector::Zero();
  mean[0] = 0.5, mean[1] = -0.25;
  Eigen::Matrix2d covariance;
  covariance << 4.0, 2.0, 2.0, 9.0;
  const BiasPrior both = biasPrior({x, y}, mean, covariance);
  EXPECT_NEAR(both.information(0, 0), 9.0 / 32.0, 1e-12);
  EXPECT_NEAR(both.information(0, 1), -2.0 / 32.0, 1e-12);
  EXPECT_NEAR(both.covariance()(1, 1), 9.0, 1e-12);
  const BiasPrior one = both.without(x);
  EXPECT_EQ(one.known(), std::vector<SystemParameter>{y});
  EXPECT_NEAR(one.information(1, 1), 1.0 / 9.0, 1e-12);
  EXPECT_EQ(one.mean[1], -0.25);
  EXPECT_EQ(one.information(0, 0), 0.0);
  SystemVector biases = SystemVector::Constant(1.0);
  biases = one.replacing(biases);
  EXPECT_EQ(biases[0], 1.0);
  EXPECT_EQ(biases[1], -0.25);
  covariance(0, 1) = covariance(1, 0) = 7.0;
  EXPECT_THROW(biasPrior({x, y}, mean, covariance), InputError);
}

TEST(BiasPrior, ReadsValuesAndStandardDeviations) {
  const BiasPrior prior = biasPrior("boresight_roll=-90:5, lever_arm_x=0.12:0.01");
  const int roll = indexOf(SystemParameter::boresight_roll);
  EXPECT_DOUBLE_EQ(prior.mean[roll], -90.0 * kRadiansPerArcsec);
  EXPECT_DOUBLE_EQ(prior.information(roll, roll), 1.0 / std::pow(5.0 * kRadiansPerArcsec, 2));
  EXPECT_TRUE(prior.of(SystemParameter::lever_arm_x));
  EXPECT_FALSE(prior.of(SystemParameter::range_bias));
  EXPECT_FALSE(BiasPrior().any());
  for (const char* wrong :
       {"roll=0:5", "boresight_roll=0", "boresight_roll:5", "boresight_roll=0:0",
        "boresight_roll=0:-1", "boresight_roll=x:1", "boresight_roll=0:nan",
        "boresight_roll=0:5,boresight_roll=1:5", "lever_arm_x=1e6:1"}) {
    EXPECT_THROW(biasPrior(wrong), UsageError) << wrong;
  }
}

}  // namespace
}  // namespace pcl_als
