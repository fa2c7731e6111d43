// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Calibrations and histories as priors, and what a calibration.json records of a prior.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/prior_file.h>
#include <pcl_als/io/result_json.h>

namespace pcl_als {
namespace {

using P = SystemParameter;
using OrderedJson = nlohmann::ordered_json;
constexpr double kArcsec = kRadiansPerArcsec;

/// Pitch 20" +- 3", lever_arm_y 0.05 m +- 0.004 m, correlation 0.5; the rest is held.
CalibrationResult calibration() {
  CalibrationResult result;
  result.attitude = AttitudeSource::trajectory;
  result[P::lever_arm_y] = {0.05, 0.004, 0.001, ParameterStatus::estimated, {}};
  result[P::boresight_pitch] = {
      20.0 * kArcsec, 3.0 * kArcsec, kArcsec, ParameterStatus::estimated, {}};
  result.correlation_order = {P::lever_arm_y, P::boresight_pitch};
  result.correlation = Eigen::Matrix2d{{1.0, 0.5}, {0.5, 1.0}};
  return result;
}

class PriorFileTest : public testing::Test {
 protected:
  PriorFile read(const std::string& text) {
    std::ofstream(path_) << text;
    return readPriorFile(path_);
  }
  std::string refusal(const std::string& text) {
    try {
      read(text).prior();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".json");
};

void expectCovariance(const BiasPrior& prior, double y, double pitch) {
  const SystemMatrix covariance = prior.covariance();
  EXPECT_NEAR(covariance(1, 1), y * y, 1e-7 * y * y);
  EXPECT_NEAR(covariance(3, 3), std::pow(pitch * kArcsec, 2), 1e-7 * std::pow(pitch * kArcsec, 2));
  EXPECT_NEAR(covariance(1, 3), 0.5 * 0.004 * 3.0 * kArcsec, 1e-7 * 0.004 * kArcsec);
  EXPECT_NEAR(prior.mean[1], 0.05, 1e-12);
  EXPECT_NEAR(prior.mean[3], 20.0 * kArcsec, 1e-12);
  EXPECT_EQ(prior.known(), (std::vector<P>{P::lever_arm_y, P::boresight_pitch}));
}

TEST_F(PriorFileTest, ACalibrationChangesByTheDefault) {
  const PriorFile file = read(calibrationJson(calibration()));
  EXPECT_FALSE(file.is_history);
  EXPECT_DOUBLE_EQ(file.calibration()[P::lever_arm_y].std, file.earlier[P::lever_arm_y].std);
  const BiasPrior prior = file.prior();
  // sqrt(0.004^2 + 0.005^2), sqrt(3^2 + 5^2)
  expectCovariance(prior, 0.00640312424, 5.83095189);
  EXPECT_EQ(prior.source, path_.string());
  EXPECT_EQ(prior.attitude, AttitudeSource::trajectory);
  EXPECT_TRUE(prior.of_other_missions);
}

TEST_F(PriorFileTest, AHistoryStatesTheChange) {
  OrderedJson history{{"format", "pcl_als history"}, {"version", 1}};
  history["instrument"] = OrderedJson::parse(calibrationJson(calibration()))["instrument"];
  history["change_std"] = OrderedJson{{"boresight_pitch", 4.0}, {"lever_arm_y", 0.003}};
  const PriorFile file = read(history.dump());
  EXPECT_TRUE(file.is_history);
  expectCovariance(file.prior(), 0.005, 5.0);
  EXPECT_DOUBLE_EQ(file.change_std[indexOf(P::boresight_roll)],
                   missionChangeStd()[indexOf(P::boresight_roll)]);
  // As a calibration: the same standard deviations; 0.5 * 0.004 / 0.005 * 3 / 5.
  const CalibrationResult applied = file.calibration();
  EXPECT_NEAR(applied[P::lever_arm_y].std, 0.005, 1e-9);
  EXPECT_NEAR(applied[P::boresight_pitch].std, 5.0 * kArcsec, 1e-12);
  EXPECT_NEAR(applied.correlation(0, 1), 0.24, 1e-6);
  EXPECT_NEAR(applied.correlation(1, 0), 0.24, 1e-6);
  EXPECT_DOUBLE_EQ(applied.correlation(1, 1), 1.0);
  EXPECT_DOUBLE_EQ(applied[P::lever_arm_y].bias, 0.05);
  history["change_std"]["boresight_pitch"] = -1.0;
  EXPECT_NE(refusal(history.dump()).find("change_std.boresight_pitch' must not be negative"),
            std::string::npos);
  history["version"] = 2;
  EXPECT_NE(refusal(history.dump()).find("'version' is 2"), std::string::npos);
}

TEST_F(PriorFileTest, WhatIsNoPriorIsRefused) {
  EXPECT_NE(refusal("{\"format\": \"quality\"}").find("give a calibration.json or a history.json"),
            std::string::npos);
  EXPECT_NE(refusal("[1, 2]").find("give a calibration.json or a history.json"), std::string::npos);
  EXPECT_NE(refusal(calibrationJson(CalibrationResult())).find("no parameter was estimated"),
            std::string::npos);
  CalibrationResult wrong = calibration();
  wrong.correlation(0, 1) = wrong.correlation(1, 0) = 2.0;
  EXPECT_NE(refusal(calibrationJson(wrong)).find("correlation matrix is not positive definite"),
            std::string::npos);
  wrong = calibration();
  wrong[P::lever_arm_y].std = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(calibrationJson(wrong)).find("standard deviation of lever_arm_y is not known"),
            std::string::npos);
  try {
    readPriorFile("absent.json");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("absent.json"), std::string::npos);
  }
}

TEST(CalibrationJson, RecordsPriorAndHeldParameters) {
  CalibrationResult result = calibration();
  result[P::boresight_pitch].prior_share = 0.85;
  SystemVector mean = SystemVector::Zero();
  mean[1] = 0.04, mean[3] = 25.0 * kArcsec;
  Eigen::Matrix2d covariance;
  covariance << 25e-6, 0.01 * kArcsec, 0.01 * kArcsec, 36.0 * kArcsec * kArcsec;
  result.prior = biasPrior({P::lever_arm_y, P::boresight_pitch}, mean, covariance);
  result.prior.source = "history.json";
  result.prior.attitude = AttitudeSource::points;
  result.prior.of_other_missions = true;
  PriorDifference difference;
  difference.parameter = P::boresight_pitch;
  difference.prior = 25.0 * kArcsec, difference.prior_std = 6.0 * kArcsec;
  difference.flight = 90.0 * kArcsec, difference.flight_std = 2.0 * kArcsec;
  difference.change = 65.0 * kArcsec, difference.change_std = 6.5 * kArcsec;
  difference.significant = difference.released = true;
  result.prior_differences = {difference};
  result.rms_with_prior = 0.03;
  result.held_parameters.parameters = {P::range_bias};
  result.held_parameters.std = {0.2};
  result.held_parameters.effect = Eigen::Vector2d(0.25, -30.0 * kArcsec);

  const std::string text = calibrationJson(result);
  const OrderedJson instrument = OrderedJson::parse(text)["instrument"];
  EXPECT_NEAR(instrument["prior"]["mean"][1].get<double>(), 25.0, 1e-9);
  EXPECT_NEAR(instrument["prior"]["covariance"][0][1].get<double>(), 0.01, 1e-9);
  EXPECT_NEAR(instrument["prior"]["differences"][0]["change"].get<double>(), 65.0, 1e-9);
  EXPECT_NEAR(instrument["held"]["effect"][1][0].get<double>(), -30.0, 1e-9);  // arcsec per metre

  const CalibrationResult read = parseCalibration(text, "t");
  EXPECT_EQ(read[P::boresight_pitch].prior_share, 0.85);
  EXPECT_TRUE(read.prior.information.isApprox(result.prior.information, 1e-9));
  EXPECT_TRUE(read.prior.mean.isApprox(result.prior.mean, 1e-12));
  EXPECT_EQ(read.prior.source, "history.json");
  EXPECT_EQ(read.prior.attitude, AttitudeSource::points);
  EXPECT_TRUE(read.prior.of_other_missions);
  ASSERT_EQ(read.prior_differences.size(), 1U);
  EXPECT_NEAR(read.prior_differences[0].change, difference.change, 1e-15);
  EXPECT_TRUE(read.prior_differences[0].released);
  EXPECT_EQ(read.rms_with_prior, 0.03);
  EXPECT_EQ(read.held_parameters.parameters, result.held_parameters.parameters);
  EXPECT_TRUE(read.held_parameters.effect.isApprox(result.held_parameters.effect, 1e-12));

  // Without a prior nothing of it is written.
  const OrderedJson plain = OrderedJson::parse(calibrationJson(calibration()))["instrument"];
  EXPECT_FALSE(plain.contains("prior"));
  EXPECT_FALSE(plain.contains("held"));
  EXPECT_FALSE(plain["parameters"]["boresight_pitch"].contains("prior_share"));
}

}  // namespace
}  // namespace pcl_als
