// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Errors of the scan angle that are functions of it, and points whose coordinates were rounded.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "expected_truth.h"
#include "simulated_survey.h"
#include "warning_texts.h"

namespace pcl_als {
namespace {

using simulation::NoiseOptions;
using simulation::SimulationOptions;
using test::expectTruth;
using test::isWarnedOf;
using test::SimulatedSurvey;

CalibrationResult calibratedWithAttitude(const SimulatedSurvey& survey) {
  SimulatedSurvey::Request request;
  request.rigorous = true;
  request.control = survey.control;
  return survey.calibrate(request).result;
}

SimulationOptions blockWithError(const std::string& error, unsigned seed) {
  SimulationOptions options = SimulationOptions::preset("small", 0.8, 0.4);
  options.noise = NoiseOptions::named("realistic");
  options.seed = seed;
  if (!error.empty()) options.errors.add(error);
  return options;
}

ErrorFinding curveOf(const CalibrationResult& result) {
  for (const ErrorFinding& finding : result.diagnosis)
    if (finding.source == "scan_angle_curve") return finding;
  ADD_FAILURE() << "the curve is no hypothesis";
  return {};
}

/// A periodic error of the encoder: what the scale and a cubic function do not explain of it.
TEST(ScanAngles, APeriodicErrorOfTheEncoder) {
  constexpr double kAmplitude = 30.0;  // arcsec
  const CalibrationResult result =
      calibratedWithAttitude(SimulatedSurvey(blockWithError("encoder_sine=30", 2)));
  const ErrorFinding curve = curveOf(result);
  EXPECT_GT(curve.probability, 0.99);
  EXPECT_TRUE(curve.determined);
  EXPECT_EQ(result.verdict.status, CalibrationStatus::parameters_affected);
  EXPECT_TRUE(isWarnedOf(result.warnings, "scan_angle_curve: the scan angle has an error of"));
  EXPECT_FALSE(isWarnedOf(result.warnings, "check the attitude of the trajectory"));
  ASSERT_EQ(result.scan_angle_curve.size(), 24U);
  double product = 0.0, squares = 0.0, of_truth = 0.0;
  for (const AngleError& error : result.scan_angle_curve) {
    const double truth = kAmplitude * std::sin(36.0 * error.angle) * kRadiansPerArcsec;
    product += truth * error.error;
    squares += error.error * error.error;
    of_truth += truth * truth;
  }
  EXPECT_GT(product / std::sqrt(squares * of_truth), 0.85);  // their correlation, with its sign
  EXPECT_NEAR(std::sqrt(squares / of_truth), 0.85, 0.2);     // classes of 1.7 degrees smooth it
}

TEST(ScanAngles, NoCurveWhereThereIsNone) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const CalibrationResult result =
        calibratedWithAttitude(SimulatedSurvey(blockWithError("", seed)));
    EXPECT_LT(curveOf(result).probability, 0.9) << seed;
    EXPECT_TRUE(result.scan_angle_curve.empty());
    EXPECT_FALSE(isWarnedOf(result.warnings, "steps of")) << "the coordinates are not rounded";
  }
}

/// Steps of 0.1 m: without their rounding errors in the noise the roll was 9 standard deviations
/// wrong.
TEST(ScanAngles, CoordinatesThatWereRounded) {
  SimulatedSurvey survey(blockWithError("", 1));
  for (auto& strip : survey.strips)
    for (LidarReturn& point : strip)
      point.position = (10.0 * point.position).array().round().matrix() / 10.0;
  const CalibrationResult result = calibratedWithAttitude(survey);
  EXPECT_TRUE(isWarnedOf(result.warnings, "steps of 0.1 m (east), 0.1 m (north), 0.1 m (up)"));
  expectTruth(result, survey.bias);
}

}  // namespace
}  // namespace pcl_als
