// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/height_check.h>

namespace pcl_als {
namespace {

/// A swath of 40 degrees from \a height, seen from a trajectory that is too high by \a error, with
/// angles in whole degrees times \a factor, looking ahead by \a tilt radians.
HeightCheck seen(double height, double error, double factor = 1.0, double tilt = 0.0) {
  HeightCheck check;
  for (int i = -2000; i <= 2000; ++i) {
    const double angle = 20.0 * kRadiansPerDegree * i / 2000.0;
    const double whole = factor * std::round(angle / kRadiansPerDegree) * kRadiansPerDegree;
    const double range = height / (std::cos(angle) * std::cos(tilt));
    check.add(range * std::sin(angle), range * std::cos(angle) * std::sin(tilt), height + error,
              whole);
  }
  return check;
}

TEST(HeightCheck, AcceptsTheRightHeight) {
  // Conventions: either side; in the plane of a scanner that looks ahead.
  EXPECT_EQ(heightError({seen(600.0, 0.0), seen(1200.0, 0.0)}).kind, HeightError::Kind::none);
  EXPECT_EQ(heightError({seen(600.0, 0.0, -1.0)}).kind, HeightError::Kind::none);
  EXPECT_EQ(heightError({seen(600.0, 0.0, 1.0, 0.3)}).kind, HeightError::Kind::none);
  EXPECT_EQ(heightError({}).kind, HeightError::Kind::none);
}

// 2026-11: a trajectory 50 m too high changed lever_arm_x by five standard deviations, unnoticed.
TEST(HeightCheck, FindsAConstantErrorAtTwoHeights) {
  const HeightError found = heightError({seen(600.0, 50.0), seen(1200.0, 50.0)});
  EXPECT_EQ(found.kind, HeightError::Kind::offset);
  EXPECT_NEAR(found.metres, 50.0, 2.0);  // whole degrees: 0.1 % of the height
  EXPECT_NE(found.text.find("m too high"), std::string::npos) << found.text;
  EXPECT_NEAR(heightError({seen(600.0, -40.0), seen(1200.0, -40.0)}).metres, -40.0, 2.0);
}

// A trajectory with ellipsoidal heights and points above a geoid, or the reverse.
TEST(HeightCheck, NamesTheGeoidWhereItExplainsTheOffset) {
  const auto named = [](const HeightError& error) {
    return error.text.find("heights above a geoid") != std::string::npos;
  };
  EXPECT_TRUE(named(heightError({seen(600.0, 47.0), seen(1200.0, 47.0)})));
  EXPECT_TRUE(named(heightError({seen(1000.0, -30.0)})));
  EXPECT_FALSE(named(heightError({seen(2000.0, 250.0), seen(4000.0, 250.0)})));
  EXPECT_FALSE(named(heightError({seen(600.0, 1370.0)})));  // feet
}

TEST(HeightCheck, OneHeightLeavesTheAnglesOpen) {
  EXPECT_EQ(heightError({seen(600.0, 30.0)}).kind, HeightError::Kind::scale);
  EXPECT_EQ(heightError({seen(600.0, 0.0, 1.04), seen(1200.0, 0.0, 1.04)}).kind,
            HeightError::Kind::scale);
}

TEST(HeightCheck, HeightsInFeetAreNoConvention) {
  const HeightError found = heightError({seen(600.0, 1370.0)});
  EXPECT_EQ(found.kind, HeightError::Kind::gross);
}

// Angles of a mirror are half of those of its pulses.
TEST(HeightCheck, HalfAndTwiceTheAngleAreConventions) {
  EXPECT_EQ(heightError({seen(600.0, 0.0, 0.5)}).kind, HeightError::Kind::scale);
  EXPECT_NE(heightError({seen(600.0, 0.0, 2.0)}).kind, HeightError::Kind::gross);
}

// Strips that contradict each other, as pieces of reconstructed flight lines do.
TEST(HeightCheck, ContradictionsAreNotJudged) {
  EXPECT_EQ(heightError({seen(600.0, 30.0), seen(600.0, -30.0)}).kind, HeightError::Kind::none);
}

}  // namespace
}  // namespace pcl_als
