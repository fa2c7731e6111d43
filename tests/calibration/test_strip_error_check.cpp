// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include "strip_error_check.h"

namespace pcl_als {
namespace {

/// Two strips; the second has a constant error in height and in roll.
CalibrationResult resultWith(double up, double roll) {
  CalibrationResult result;
  result.strip_errors = {{"7", {{0.0}, {1.0}}}, {"8", {{0.0}, {1.0}}}};
  for (TrajectoryErrorKnot& knot : result.strip_errors[1].knots) {
    knot.position.z() = up;
    knot.angles[1] = roll;
  }
  return result;
}

TEST(StripErrorCheck, AcceptsErrorsOfTheAPrioriSize) {
  CalibrationResult result = resultWith(0.04, -16.0 * kRadiansPerArcsec);  // two deviations each
  assessStripErrors(SharedErrorModel(), result);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_TRUE(result.verdict.usable());
}

TEST(StripErrorCheck, WarnsBeyondThreeDeviations) {
  CalibrationResult result = resultWith(0.0, -32.0 * kRadiansPerArcsec);
  assessStripErrors(SharedErrorModel(), result);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("strip 8: trajectory correction in roll of 32 arcsec"),
            std::string::npos)
      << result.warnings[0];
  EXPECT_NE(result.warnings[0].find("4.0 times"), std::string::npos) << result.warnings[0];
  EXPECT_TRUE(result.verdict.usable());
}

TEST(StripErrorCheck, ObjectsBeyondFive) {
  CalibrationResult result = resultWith(-0.307, 0.0);
  assessStripErrors(SharedErrorModel(), result);
  EXPECT_EQ(result.verdict.status, CalibrationStatus::parameters_affected);
  EXPECT_NE(result.verdict.reason.find("height of 307 mm"), std::string::npos)
      << result.verdict.reason;
  EXPECT_NE(result.verdict.reason.find("20 mm"), std::string::npos);
}

TEST(StripErrorCheck, ReportsThatOnlyCorrectionsMakeStripsAgree) {
  PairFit fit;
  fit.correspondences = 100;
  fit.rms_before = fit.rms_after = 0.2;
  fit.rms_strips = 0.03;
  CalibrationResult small = resultWith(0.0, 0.0);  // as after an earlier calibration
  small.pairs = {fit};
  assessStripErrors(SharedErrorModel(), small);
  EXPECT_EQ(small.warnings.size(), 1U);
  EXPECT_TRUE(small.verdict.usable());
  CalibrationResult large = resultWith(0.08, 0.0);  // four a priori standard deviations
  large.pairs = {fit};
  assessStripErrors(SharedErrorModel(), large);
  EXPECT_EQ(large.verdict.status, CalibrationStatus::parameters_affected);
  large = resultWith(0.08, 0.0);
  fit.rms_after = 0.05;  // the biases explain most of the misfit
  large.pairs = {fit};
  assessStripErrors(SharedErrorModel(), large);
  EXPECT_TRUE(large.verdict.usable());
  EXPECT_EQ(large.warnings.size(), 1U);
}

}  // namespace
}  // namespace pcl_als
