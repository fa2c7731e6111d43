// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/radiometry/atmosphere.h>

namespace pcl_als {
namespace {

constexpr double kZeroCelsius = 273.15;

/// Bird and Riordan 1984, table 2-1: absorption coefficients of water vapour and mixed gases.
struct Band {
  double wavelength_nm, water, mixed;
};
constexpr std::array<Band, 60> kBands = {{
    {500, 0, 0},           {570, 0, 0},           {593, 0.075, 0},      {610, 0, 0},
    {656, 0, 0},           {667.6, 0, 0},         {690, 0.016, 0.15},   {710, 0.0125, 0},
    {718, 1.8, 0},         {724.4, 2.5, 0},       {740, 0.061, 0},      {752.5, 8e-4, 0},
    {757.5, 1e-4, 0},      {762.5, 1e-5, 4.0},    {767.5, 1e-5, 0.35},  {780, 6e-4, 0},
    {800, 0.036, 0},       {816, 1.6, 0},         {823.7, 2.5, 0},      {831.5, 0.5, 0},
    {840, 0.155, 0},       {860, 1e-5, 0},        {880, 0.0026, 0},     {905, 7.0, 0},
    {915, 5.0, 0},         {925, 5.0, 0},         {930, 27.0, 0},       {937, 55.0, 0},
    {948, 45.0, 0},        {965, 4.0, 0},         {980, 1.48, 0},       {993.5, 0.1, 0},
    {1040, 1e-5, 0},       {1070, 0.001, 0},      {1100, 3.2, 0},       {1120, 115.0, 0},
    {1130, 70.0, 0},       {1145, 75.0, 0},       {1161, 10.0, 0},      {1170, 5.0, 0},
    {1200, 2.0, 0},        {1240, 0.002, 0.05},   {1270, 0.002, 0.3},   {1290, 0.1, 0.02},
    {1320, 4.0, 2e-4},     {1350, 200.0, 1.1e-4}, {1395, 1000.0, 1e-5}, {1442.5, 185.0, 0.05},
    {1462.5, 80.0, 0.011}, {1477, 80.0, 0.005},   {1497, 12.0, 6e-4},   {1520, 0.16, 0},
    {1539, 0.002, 0.005},  {1558, 5e-4, 0.13},    {1578, 1e-4, 0.04},   {1592, 1e-5, 0.06},
    {1610, 1e-4, 0.13},    {1630, 0.001, 0.001},  {1646, 0.01, 0.0014}, {1678, 0.036, 1e-4},
}};

/// Between two bands of the table, linear in wavelength.
Band bandAt(double wavelength_nm) {
  const auto above =
      std::lower_bound(kBands.begin() + 1, kBands.end() - 1, wavelength_nm,
                       [](const Band& band, double nm) { return band.wavelength_nm < nm; });
  const Band &a = *(above - 1), &b = *above;
  const double t = (wavelength_nm - a.wavelength_nm) / (b.wavelength_nm - a.wavelength_nm);
  return {wavelength_nm, a.water + t * (b.water - a.water), a.mixed + t * (b.mixed - a.mixed)};
}

void require(double value, double low, double high, const char* what) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  std::ostringstream text;
  text << "atmosphere: " << what << ' ' << value << " is outside [" << low << ", " << high << ']';
  throw UsageError(text.str());
}

double aerosol(double visibility_km, double wavelength_nm) {
  const double v = visibility_km;
  double q = 0.0;
  if (v > 50.0)
    q = 1.6;
  else if (v > 6.0)
    q = 1.3;
  else if (v > 1.0)
    q = 0.16 * v + 0.34;
  else if (v > 0.5)
    q = v - 0.5;
  return 3.91 / v * std::pow(wavelength_nm / 550.0, -q);
}

double rayleigh(const Atmosphere& air) {
  constexpr double kBoltzmann = 1.380649e-23;  // J/K
  const double um2 = air.wavelength_nm * air.wavelength_nm * 1e-6;
  const double cross_section_cm2 = 1e-28 * (1.0455996 - 341.29061 / um2 - 0.90230850 * um2) /
                                   (1.0 + 0.0027059889 / um2 - 85.968563 * um2);
  const double per_m3 = air.pressure_kpa * 1e3 / (kBoltzmann * (air.temperature_c + kZeroCelsius));
  return cross_section_cm2 * 1e-4 * per_m3 * 1e3;
}

/// Precipitable water of one kilometre, cm.
double waterPerKilometre(const Atmosphere& air) {
  const double t = air.temperature_c;
  const double vapour_hpa =
      air.relative_humidity / 100.0 * 6.112 * std::exp(17.62 * t / (243.12 + t));
  const double grams_per_m3 = 216.68 * vapour_hpa / (t + kZeroCelsius);
  return 0.1 * grams_per_m3;
}

/// Share of a vertical column of air that one kilometre holds: density over 10 332 kg/m2.
double airMassPerKilometre(const Atmosphere& air) {
  constexpr double kGasConstant = 287.05;  // J/(kg K), dry air
  constexpr double kColumn = 101325.0 / 9.80665;
  const double density =
      air.pressure_kpa * 1e3 / (kGasConstant * (air.temperature_c + kZeroCelsius));
  return 1000.0 * density / kColumn;
}

}  // namespace

void Atmosphere::check() const {
  require(visibility_km, 0.01, 500.0, "visibility (km)");
  require(temperature_c, -60.0, 60.0, "temperature (C)");
  require(pressure_kpa, 20.0, 120.0, "pressure (kPa)");
  require(relative_humidity, 0.0, 100.0, "relative humidity (%)");
  require(wavelength_nm, 500.0, 1650.0, "wavelength (nm)");
}

Extinction extinctionOf(const Atmosphere& atmosphere) {
  atmosphere.check();
  const Band band = bandAt(atmosphere.wavelength_nm);
  const double water = band.water * waterPerKilometre(atmosphere);
  const double mixed = band.mixed * airMassPerKilometre(atmosphere);
  Extinction extinction;
  extinction.aerosol = aerosol(atmosphere.visibility_km, atmosphere.wavelength_nm);
  extinction.rayleigh = rayleigh(atmosphere);
  extinction.water_vapour = 0.2385 * water / std::pow(1.0 + 20.07 * water, 0.45);
  extinction.mixed_gases = 1.41 * mixed / std::pow(1.0 + 118.93 * mixed, 0.45);
  return extinction;
}

double extinctionFromDecibel(double decibel_per_km) {
  if (!std::isfinite(decibel_per_km) || decibel_per_km < 0.0 || decibel_per_km > 100.0) {
    throw UsageError("attenuation: must be between 0 and 100 dB/km");
  }
  return decibel_per_km * std::log(10.0) / 10.0;
}

double twoWayTransmission(double extinction_per_km, double range) {
  return std::exp(-2.0 * extinction_per_km * range / 1000.0);
}

}  // namespace pcl_als
