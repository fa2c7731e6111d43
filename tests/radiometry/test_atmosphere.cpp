// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/radiometry/atmosphere.h>

namespace pcl_als {
namespace {

Atmosphere visible(double km) {
  Atmosphere air;
  air.visibility_km = km;
  return air;
}

TEST(Atmosphere, AerosolAt1064NanometresByHand) {
  // 3.91 / V (1064/550)^-q; the exponents are those of Kim et al. 2001: 0.16 V + 0.34 = 1.14, 1.3,
  // 1.3; the two-way transmission of a kilometre is exp(-2 a). By hand, ln(1064/550) = 0.659872:
  // 0.782 exp(-0.752255) = 0.368559, 0.391 exp(-0.857834) = 0.165815, 0.17 exp(-0.857834) =
  // 0.072094; three digits are those of the project's table: 0.369, 0.166, 0.072.
  const double km[] = {5.0, 10.0, 23.0};
  const double extinction[] = {0.368559, 0.165815, 0.072094};
  const double transmission[] = {0.478491, 0.717753, 0.865726};
  const double table[][2] = {{0.369, 0.478}, {0.166, 0.718}, {0.072, 0.866}};
  for (int i = 0; i < 3; ++i) {
    const double found = extinctionOf(visible(km[i])).aerosol;
    EXPECT_NEAR(found, extinction[i], 2e-6);
    EXPECT_NEAR(twoWayTransmission(found, 1000.0), transmission[i], 5e-6);
    EXPECT_EQ(std::round(1000.0 * found), std::round(1000.0 * table[i][0]));
    EXPECT_EQ(std::round(1000.0 * twoWayTransmission(found, 1000.0)),
              std::round(1000.0 * table[i][1]));
  }
}

TEST(Atmosphere, AerosolInFogDoesNotDependOnWavelength) {
  // Kim et al. 2001: q = 0 under 0.5 km, V - 0.5 up to 1 km. 3.91 / 0.4 = 9.775.
  Atmosphere fog = visible(0.4);
  EXPECT_NEAR(extinctionOf(fog).aerosol, 9.775, 1e-12);
  fog.wavelength_nm = 1550.0;
  EXPECT_NEAR(extinctionOf(fog).aerosol, 9.775, 1e-12);
  // 3.91 / 0.75 (1550/550)^-0.25 = 5.2133 * 0.77181 = 4.0237, by hand.
  fog.visibility_km = 0.75;
  EXPECT_NEAR(extinctionOf(fog).aerosol, 4.0237, 5e-4);
}

TEST(Atmosphere, AerosolAt550NanometresIsTheDefinitionOfVisibility) {
  for (const double km : {0.2, 0.7, 3.0, 20.0, 100.0}) {
    Atmosphere air = visible(km);
    air.wavelength_nm = 550.0;
    // Koschmieder: 3.91 / V at the wavelength that the eye sees best.
    EXPECT_NEAR(extinctionOf(air).aerosol * km, 3.91, 1e-12);
  }
}

TEST(Atmosphere, RayleighAgreesWithAnIndependentFormula) {
  // Bucholtz 1995 (Appl. Opt. 34, 2765), table 3: volume scattering coefficient of standard air (15
  // C, 1013.25 hPa) above 500 nm, 1.02167e-3 lambda^-(3.99668 + 1.10298e-3 lambda + 0.0271393 /
  // lambda) per km, lambda in um: 7.960e-4 at 1.064 um. 0.5 % is what the two differ by up to 1.1
  // um; at 1.55 um, beyond the fit of either (where it is 1.8e-4 per km), 1 %.
  for (const double um : {0.532, 0.905, 1.064, 1.550}) {
    Atmosphere air;
    air.wavelength_nm = 1000.0 * um;
    const double exponent = 3.99668 + 1.10298e-3 * um + 0.0271393 / um;
    const double bucholtz = 1.02167e-3 * std::pow(um, -exponent);
    EXPECT_NEAR(extinctionOf(air).rayleigh / bucholtz, 1.0, um < 1.1 ? 5e-3 : 1e-2) << um;
  }
  EXPECT_NEAR(extinctionOf(Atmosphere()).rayleigh, 8e-4, 1e-5);
}

TEST(Atmosphere, RayleighScalesWithDensity) {
  Atmosphere thin;
  thin.pressure_kpa = 50.6625;
  EXPECT_NEAR(extinctionOf(thin).rayleigh / extinctionOf(Atmosphere()).rayleigh, 0.5, 1e-12);
  Atmosphere warm;
  warm.temperature_c = 45.0;
  EXPECT_NEAR(extinctionOf(warm).rayleigh / extinctionOf(Atmosphere()).rayleigh, 288.15 / 318.15,
              1e-12);
}

TEST(Atmosphere, WaterVapourByHand) {
  // 20 C, 100 %: 6.112 exp(17.62 * 20 / 263.12) = 23.33 hPa, 216.68 * 23.33 / 293.15 = 17.24 g/m3
  // (tables of saturated air: 17.3), 1.724 cm per km. Coefficient at 1064 nm between 1040 nm (1e-5)
  // and 1070 nm (1e-3): 8.02e-4. 0.2385 * 8.02e-4 * 1.724 / (1 + 20.07 * 1.383e-3)^0.45 = 3.257e-4.
  Atmosphere humid;
  humid.temperature_c = 20.0;
  humid.relative_humidity = 100.0;
  EXPECT_NEAR(extinctionOf(humid).water_vapour, 3.257e-4, 1e-6);
  humid.relative_humidity = 0.0;
  EXPECT_EQ(extinctionOf(humid).water_vapour, 0.0);
  // In the band at 940 nm vapour absorbs more than all else.
  humid.relative_humidity = 100.0;
  humid.wavelength_nm = 937.0;
  EXPECT_GT(extinctionOf(humid).water_vapour, 0.5);
  EXPECT_EQ(extinctionOf(humid).mixed_gases, 0.0);
}

TEST(Atmosphere, MixedGasesByHand) {
  // 1558 nm, standard air: 1.225 kg/m3 of 10332.3 kg/m2 in a km: 0.11856; times 0.13: 0.015413;
  // 1.41 * 0.015413 / (1 + 118.93 * 0.015413)^0.45 = 0.021733 / 1.59778 = 0.013602.
  Atmosphere air;
  air.wavelength_nm = 1558.0;
  EXPECT_NEAR(extinctionOf(air).mixed_gases, 0.013602, 1e-6);
}

TEST(Atmosphere, TheWeatherOfThePaper) {
  // Habib et al. 2011: 29.8 C, 48.3 km, 101.81 kPa. 3.91 / 48.3 (1064/550)^-1.3 = 0.034322;
  // Rayleigh 7.97e-4 * (101.81 / 101.325) (288.15 / 302.95) = 7.62e-4.
  Atmosphere paper = visible(48.3);
  paper.temperature_c = 29.8;
  paper.pressure_kpa = 101.81;
  paper.relative_humidity = 0.0;
  const Extinction extinction = extinctionOf(paper);
  EXPECT_NEAR(extinction.aerosol, 0.034322, 1e-5);
  EXPECT_NEAR(extinction.rayleigh, 7.62e-4, 2e-6);
  EXPECT_NEAR(twoWayTransmission(extinction.total(), 1150.0), 0.9225, 1e-3);
  EXPECT_NEAR(twoWayTransmission(extinction.total(), 540.0), 0.9628, 1e-3);
}

TEST(Atmosphere, DecibelsByHand) {
  EXPECT_NEAR(extinctionFromDecibel(10.0), 2.302585, 1e-6);
  // 3.0103 dB both ways leave half: 1.50515 dB/km over 1 km.
  EXPECT_NEAR(twoWayTransmission(extinctionFromDecibel(1.5051500), 1000.0), 0.5, 1e-6);
  EXPECT_THROW(extinctionFromDecibel(-0.1), UsageError);
  EXPECT_THROW(extinctionFromDecibel(NAN), UsageError);
}

TEST(Atmosphere, RefusesWhatNoStationReports) {
  const auto refused = [](void (*spoil)(Atmosphere&), const std::string& word) {
    Atmosphere air;
    spoil(air);
    try {
      extinctionOf(air);
      ADD_FAILURE() << word << " was accepted";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused([](Atmosphere& air) { air.visibility_km = 0.0; }, "visibility");
  refused([](Atmosphere& air) { air.visibility_km = -5.0; }, "visibility");
  refused([](Atmosphere& air) { air.temperature_c = 290.0; }, "temperature");
  refused([](Atmosphere& air) { air.pressure_kpa = 1013.0; }, "pressure");
  refused([](Atmosphere& air) { air.relative_humidity = 101.0; }, "humidity");
  refused([](Atmosphere& air) { air.wavelength_nm = 1.064; }, "wavelength");
}

}  // namespace
}  // namespace pcl_als
