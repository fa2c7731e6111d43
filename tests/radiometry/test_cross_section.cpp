// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/radiometry/cross_section.h>

namespace pcl_als {
namespace {

TEST(CrossSection, FollowsTheRadarEquation) {
  CrossSectionModel model;
  model.constant = 2.0;
  model.extinction_per_km = 0.1;
  EXPECT_NEAR(model.crossSection(1000.0, 50.0), 122.140276, 1e-5);   // 2 * 1 * e^0.2 * 50
  EXPECT_NEAR(model.crossSection(2000.0, 50.0), 2386.919516, 1e-4);  // 2 * 16 * e^0.4 * 50
}

TEST(CrossSection, OverThatOfTheBeamIsTheCoefficient) {
  CrossSectionModel model;
  model.beam_divergence = 0.3;  // a diameter of 0.3 m at 1000 m, 0.070686 m²
  EXPECT_NEAR(model.coefficient(1000.0, 0.1413717), 2.0, 1e-6);
  EXPECT_NEAR(model.coefficient(2000.0, 0.1413717), 0.5, 1e-6);
}

TEST(CrossSection, OfALambertianSurfaceGivesItsReflectance) {
  CrossSectionModel model;
  // rho = 0.4 at an incidence of 60 degrees: gamma = 4 * 0.4 * 0.5 = 0.8, sigma = 0.8 * 0.070686.
  model.constant = 0.0565487 / 100.0;
  EXPECT_NEAR(model.reflectance(1000.0, 100.0, 0.5), 0.4, 1e-6);
}

TEST(CrossSection, NeedsValuesWithinTheirLimits) {
  CrossSectionModel model;
  EXPECT_NO_THROW(model.check());
  model.constant = 0.0;
  EXPECT_THROW(model.check(), UsageError);
  model.constant = 1.0;
  model.beam_divergence = 0.0;
  EXPECT_THROW(model.check(), UsageError);
  model.beam_divergence = 0.3;
  model.extinction_per_km = -0.1;
  EXPECT_THROW(model.check(), UsageError);
}

TEST(PulseTransmissions, AreWhatEarlierEchoesLeave) {
  const std::vector<double> left = pulseTransmissions({0.5, 0.3, 0.4}, 2.0);
  ASSERT_EQ(left.size(), 3U);
  EXPECT_DOUBLE_EQ(left[0], 1.0);
  EXPECT_DOUBLE_EQ(left[1], 0.75);
  EXPECT_DOUBLE_EQ(left[2], 0.6);
}

TEST(PulseTransmissions, AreNotLessThanTheLeast) {
  EXPECT_EQ(pulseTransmissions({3.0, 1.0}, 2.0), (std::vector<double>{1.0, 0.1}));
  EXPECT_EQ(pulseTransmissions({3.0, 1.0}, 2.0, 0.25), (std::vector<double>{1.0, 0.25}));
}

// A canopy of the ground's material that intercepts 30 %: both get the cross section of the ground.
TEST(PulseTransmissions, RestoreTheGroundUnderACanopy) {
  const double full = 1.2;
  const std::vector<double> seen{0.3 * full, 0.7 * full};
  const std::vector<double> left = pulseTransmissions(seen, full);
  EXPECT_NEAR(seen[1] / left[1], full, 1e-12);
}

}  // namespace
}  // namespace pcl_als
