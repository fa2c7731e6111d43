// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/simulation/radiometry.h>

namespace pcl_als::simulation {

double extinctionPerKilometre(const AtmosphereOptions& atmosphere) {
  const double v = atmosphere.visibility_km;
  double q = 0.0;
  if (v > 50.0)
    q = 1.6;
  else if (v > 6.0)
    q = 1.3;
  else if (v > 1.0)
    q = 0.16 * v + 0.34;
  else if (v > 0.5)
    q = v - 0.5;
  const double aerosol = 3.91 / v * std::pow(1064.0 / 550.0, -q);
  const double rayleigh =
      8e-4 * (atmosphere.pressure_kpa / 101.325) * (288.15 / (273.15 + atmosphere.temperature_c));
  return aerosol + rayleigh;
}

double digitalNumber(double gain, double signal, double range, double extinction_per_km,
                     double range_exponent) {
  const double kilometres = range / 1000.0;
  return gain * signal / std::pow(kilometres, range_exponent) *
         std::exp(-2.0 * extinction_per_km * kilometres);
}

}  // namespace pcl_als::simulation
