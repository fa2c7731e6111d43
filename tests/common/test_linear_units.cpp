// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_units.h>

namespace pcl_als {
namespace {

// EPSG 9003: 1200/3937 m.
constexpr double kSurveyFoot = 1200.0 / 3937.0;

TEST(LengthUnit, LengthsWithFewDigitsAreTheUnitsThatTheyMean) {
  for (const double written : {kSurveyFoot, 0.3048006, 0.30480061, 0.3048006096012192}) {
    EXPECT_EQ(lengthUnitOf(written).name, "US survey foot") << written;
    EXPECT_DOUBLE_EQ(lengthUnitOf(written).metres, kSurveyFoot);
  }
  EXPECT_EQ(lengthUnitOf(0.3048).name, "foot");
  EXPECT_EQ(lengthUnitOf(0.3048).metres, 0.3048);
  EXPECT_TRUE(lengthUnitOf(1.0, "meter").isMetre());
}

TEST(LengthUnit, OthersKeepTheirNameAndLength) {
  // EPSG 9041: British foot (Sears 1922), 1e-5 shorter than the international one.
  const LengthUnit sears = lengthUnitOf(0.304799471538676, "British foot (Sears 1922)");
  EXPECT_EQ(sears.name, "British foot (Sears 1922)");
  EXPECT_EQ(sears.metres, 0.304799471538676);
  EXPECT_EQ(lengthUnitOf(0.9144).name, "unit of 0.9144 m");
}

TEST(LengthUnit, RefusesWhatIsNoLength) {
  for (const double metres : {0.0, -0.3048, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(lengthUnitOf(metres), UsageError) << metres;
}

TEST(LengthUnit, OptionsNameThreeUnits) {
  EXPECT_TRUE(lengthUnitNamed("m", "option -u").isMetre());
  EXPECT_EQ(lengthUnitNamed("ft", "option -u").metres, 0.3048);
  EXPECT_DOUBLE_EQ(lengthUnitNamed("us_ft", "option -u").metres, kSurveyFoot);
  try {
    lengthUnitNamed("feet", "option -u");
    FAIL() << "accepted";
  } catch (const UsageError& error) {
    EXPECT_EQ(std::string(error.what()),
              "option -u: 'feet' is none of m (metre), ft (international foot) and us_ft (US "
              "survey foot)");
  }
}

TEST(LinearUnits, AreMetresUntilStated) {
  LinearUnits units;
  EXPECT_FALSE(units.known());
  EXPECT_TRUE(units.metric());
  EXPECT_EQ(units.metres(), Eigen::Vector3d::Ones());
  units.vertical = lengthUnitOf(0.3048);
  EXPECT_FALSE(units.metric());
  EXPECT_EQ(units.metres(), Eigen::Vector3d(1.0, 1.0, 0.3048));
}

}  // namespace
}  // namespace pcl_als
