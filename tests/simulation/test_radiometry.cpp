// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/simulation/radiometry.h>

namespace {

using namespace pcl_als::simulation;

AtmosphereOptions airOf(double visibility_km) {
  AtmosphereOptions air;
  air.visibility_km = visibility_km;
  air.temperature_c = 15.0;  // 288.15 K and 101.325 kPa: Rayleigh is 8e-4 per km
  air.pressure_kpa = 101.325;
  return air;
}

TEST(Radiometry, ExtinctionFollowsVisibility) {
  // 3.91 / V (1064/550)^-q, q = 1.14, 1.3, 1.3, 1.6 by hand, plus 8e-4. Three digits.
  EXPECT_NEAR(extinctionPerKilometre(airOf(5.0)), 0.3684 + 0.0008, 5e-4);
  EXPECT_NEAR(extinctionPerKilometre(airOf(10.0)), 0.1657 + 0.0008, 5e-4);
  EXPECT_NEAR(extinctionPerKilometre(airOf(23.0)), 0.0721 + 0.0008, 5e-4);
  EXPECT_NEAR(extinctionPerKilometre(airOf(60.0)), 0.0227 + 0.0008, 5e-4);
}

TEST(Radiometry, RayleighScalesWithTheDensityOfAir) {
  AtmosphereOptions air = airOf(500.0);
  const double thick = extinctionPerKilometre(air);
  air.pressure_kpa *= 0.5;
  EXPECT_NEAR(thick - extinctionPerKilometre(air), 4e-4, 1e-12);
  air.pressure_kpa *= 2.0;
  air.temperature_c = 2.0 * 288.15 - 273.15;
  EXPECT_NEAR(thick - extinctionPerKilometre(air), 4e-4, 1e-12);
}

TEST(Radiometry, ReferenceTargetGivesTheGain) {
  EXPECT_DOUBLE_EQ(digitalNumber(10000.0, 1.0, 1000.0, 0.0), 10000.0);
}

TEST(Radiometry, NumberByHand) {
  // Reflectance 0.5, 60 degrees: signal 0.25. 2000 m: a quarter. 0.1 per km, 4 km both ways:
  // exp(-0.4) = 0.670320. 10000 * 0.25 / 4 * 0.670320 = 418.950.
  EXPECT_NEAR(digitalNumber(10000.0, 0.25, 2000.0, 0.1), 418.950, 1e-3);
}

}  // namespace
