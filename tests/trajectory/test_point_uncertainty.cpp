// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <memory>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/point_uncertainty.h>

#include "flights.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
const Eigen::Vector3d kUnknownSurface(kNone, kNone, kNone);

/// North at 1000 m; no noise and no trajectory errors but those that a test sets.
std::shared_ptr<const Trajectory> northward() {
  return std::make_shared<const Trajectory>(test::sampled(test::straight(0.0), 0.0, 30.0, 0.1));
}

CalibrationResult exact() {
  CalibrationResult result;
  result.error_levels = ErrorLevels{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  return result;
}

Eigen::Matrix3d covarianceOf(const CalibrationResult& calibration, const Eigen::Vector3d& point,
                             const Eigen::Vector3d& normal = kUnknownSurface,
                             bool strip_corrections = false) {
  const PointUncertainty uncertainty(calibration, northward(), {strip_corrections, {}});
  PointUncertainty::Cursor cursor;
  Eigen::Matrix3d covariance;
  EXPECT_TRUE(uncertainty.covarianceAt(10.0, point, normal, cursor, covariance));
  return covariance;
}

const Eigen::Vector3d kNadir(0.0, 600.0, 0.0);  // at 10 s

TEST(PointUncertainty, NoiseIsAlongAndAcrossThePulse) {
  CalibrationResult calibration = exact();
  calibration.error_levels->range = 0.02;
  calibration.error_levels->angle = 4e-5;
  calibration.error_levels->position = 0.005;
  const PointUncertainty::Sigma sigma =
      PointUncertainty::sigmaOf(covarianceOf(calibration, kNadir));
  // 4 cm of pointing and 0.5 cm of position in each axis of the plane.
  EXPECT_NEAR(sigma.horizontal, std::sqrt(2.0 * (0.04 * 0.04 + 0.005 * 0.005)), 1e-9);
  EXPECT_NEAR(sigma.vertical, std::hypot(0.02, 0.005), 1e-9);
}

TEST(PointUncertainty, RangesOfEchoesAreUsedWhereTheyAreLessCertain) {
  CalibrationResult calibration = exact();
  calibration.error_levels->range = 0.02;
  const PointUncertainty uncertainty(calibration, northward(), {false, {}});
  PointUncertainty::Cursor cursor;
  Eigen::Matrix3d covariance;
  const auto verticalOf = [&](double range_std) {
    EXPECT_TRUE(
        uncertainty.covarianceAt(10.0, kNadir, kUnknownSurface, cursor, covariance, 0, range_std));
    return PointUncertainty::sigmaOf(covariance).vertical;
  };
  EXPECT_NEAR(verticalOf(0.05), 0.05, 1e-12);
  EXPECT_NEAR(verticalOf(0.01), 0.02, 1e-12);
  EXPECT_EQ(verticalOf(kNone), 0.02);
}

TEST(PointUncertainty, FootprintActsOnSlopes) {
  CalibrationResult calibration = exact();
  calibration.error_levels->footprint = 0.075e-3;
  const Eigen::Vector3d slope(std::sin(0.5), 0.0, std::cos(0.5));
  EXPECT_NEAR(covarianceOf(calibration, kNadir).norm(), 0.0, 1e-15);
  EXPECT_NEAR(covarianceOf(calibration, kNadir, Eigen::Vector3d::UnitZ()).norm(), 0.0, 1e-15);
  EXPECT_NEAR(std::sqrt(covarianceOf(calibration, kNadir, slope)(2, 2)), 0.075 * std::tan(0.5),
              1e-9);
  const Eigen::Vector3d wall(1.0, 0.0, 0.0);  // tan of the incidence is at most 3
  EXPECT_NEAR(std::sqrt(covarianceOf(calibration, kNadir, wall)(2, 2)), 0.225, 1e-9);
}

TEST(PointUncertainty, ParametersActThroughTheirDesign) {
  CalibrationResult calibration = exact();
  calibration[P::boresight_roll].std = 2e-5;
  calibration[P::range_bias].std = 0.03;
  // 1000 m to the right and below: roll moves the point by 1000 m times its error in x and z.
  const Eigen::Vector3d point(1000.0, 600.0, 0.0);
  Eigen::Matrix3d covariance = covarianceOf(calibration, point);
  EXPECT_NEAR(covariance(0, 0), 0.02 * 0.02 + 0.5 * 0.03 * 0.03, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 0.02 * 0.02 + 0.5 * 0.03 * 0.03, 1e-9);
  // Correlated so that they cancel in height: dZ = -x droll - cos(beta) dr.
  calibration.correlation_order = {P::boresight_roll, P::range_bias};
  calibration.correlation = Eigen::Matrix2d::Identity();
  calibration.correlation(0, 1) = calibration.correlation(1, 0) = -1.0;
  covariance = covarianceOf(calibration, point);
  EXPECT_NEAR(covariance(2, 2), std::pow(0.02 - 0.03 * std::sqrt(0.5), 2), 1e-9);
}

CalibrationResult withStrip() {
  CalibrationResult calibration = exact();
  calibration[P::boresight_roll].std = 2e-5;
  calibration.correlation_order = {P::boresight_roll};
  calibration.correlation = Eigen::MatrixXd::Identity(1, 1);
  StripErrors strip;
  strip.id = "1";
  for (const double time : {0.0, 30.0}) {
    TrajectoryErrorKnot& knot = strip.knots.emplace_back();
    knot.time = time;
    knot.position = {0.0, 0.0, 0.05};
    knot.position_std = {0.01, 0.01, 0.02};
    knot.angles_std = {0.0, 3e-5, 0.0};
    StripErrorCorrelation& correlation = strip.correlations.emplace_back();
    correlation.time = time;
    correlation.errors.setIdentity();
    correlation.parameters.setZero(6, 1);
    correlation.parameters(4, 0) = -0.8;  // roll of the strip and boresight roll
  }
  calibration.strip_errors.push_back(strip);
  return calibration;
}

// A strip's roll and the boresight roll add up in the point, and are negatively correlated.
TEST(PointUncertainty, StripErrorsAreCorrelatedWithParameters) {
  const Eigen::Matrix3d covariance = covarianceOf(withStrip(), kNadir, kUnknownSurface, true);
  const double roll_sq = 4e-10 + 9e-10 - 2.0 * 0.8 * 2e-5 * 3e-5;
  EXPECT_NEAR(covariance(0, 0), 1e-4 + 1e6 * roll_sq, 1e-9);
  EXPECT_NEAR(covariance(2, 2), 4e-4, 1e-9);
}

TEST(PointUncertainty, ErrorsThatAreNotRemovedRemain) {
  EXPECT_NEAR(covarianceOf(withStrip(), kNadir)(2, 2), 4e-4 + 25e-4, 1e-9);
}

TEST(PointUncertainty, TimesOfNoStripHaveTheLevelsOrTheTrajectorysOwn) {
  CalibrationResult calibration = exact();
  calibration.error_levels->trajectory_position = 0.03;
  EXPECT_NEAR(covarianceOf(calibration, kNadir)(2, 2), 9e-4, 1e-12);
  TrajectoryErrorKnot stated;
  stated.time = 10.0;
  stated.position_std = {kNone, kNone, 0.05};
  const PointUncertainty uncertainty(calibration, northward(), {false, {stated}});
  PointUncertainty::Cursor cursor;
  Eigen::Matrix3d covariance;
  ASSERT_TRUE(uncertainty.covarianceAt(10.0, kNadir, kUnknownSurface, cursor, covariance));
  EXPECT_NEAR(covariance(2, 2), 25e-4, 1e-12);
  EXPECT_NEAR(covariance(0, 0), 9e-4, 1e-12);  // not stated
  EXPECT_FALSE(uncertainty.covarianceAt(99.0, kNadir, kUnknownSurface, cursor, covariance));
}

}  // namespace
}  // namespace pcl_als
