// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/radiometry/cross_section.h>

namespace pcl_als {
namespace {

constexpr double kMetresPerKilometre = 1000.0;
constexpr double kLambertian = 4.0;  ///< gamma over rho cos(theta)

/// Cross section of the beam at a range, m².
double beamArea(double range, double divergence_mrad) {
  const double diameter = 1e-3 * divergence_mrad * range;
  return 0.25 * kPi * diameter * diameter;
}

}  // namespace

void CrossSectionModel::check() const {
  if (!(std::isfinite(constant) && constant > 0.0))
    throw UsageError("cross sections: the calibration constant must be more than 0");
  if (!(extinction_per_km >= 0.0 && extinction_per_km <= 50.0))
    throw UsageError("cross sections: the extinction must be from 0 to 50 per km");
  if (!(beam_divergence > 0.0 && beam_divergence <= 100.0))
    throw UsageError(
        "cross sections: the beam divergence must be more than 0 and at most 100 mrad");
}

double CrossSectionModel::crossSection(double range, double energy) const {
  const double km = range / kMetresPerKilometre;
  return constant * std::pow(km, 4) * std::exp(2.0 * extinction_per_km * km) * energy;
}

double CrossSectionModel::coefficient(double range, double cross_section) const {
  return cross_section / beamArea(range, beam_divergence);
}

double CrossSectionModel::reflectance(double range, double energy, double cosine) const {
  return coefficient(range, crossSection(range, energy)) / (kLambertian * cosine);
}

std::vector<double> pulseTransmissions(const std::vector<double>& coefficients, double full,
                                       double least) {
  std::vector<double> transmissions;
  double before = 0.0;
  for (const double coefficient : coefficients) {
    transmissions.push_back(std::max(least, 1.0 - before / full));
    before += std::max(0.0, coefficient);
  }
  return transmissions;
}

}  // namespace pcl_als
