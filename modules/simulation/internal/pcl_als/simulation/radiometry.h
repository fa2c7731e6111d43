// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

/** \brief Extinction of the air at 1064 nm, per kilometre.
 *
 * Aerosol from the visibility V (km), a = 3.91 / V (1064/550)^-q with q of Kruse and Kim (1.6 above
 * 50 km, 1.3 from 6, 0.16 V + 0.34 from 1, V - 0.5 from 0.5, else 0), plus Rayleigh scattering of
 * 8e-4 per km at 101.325 kPa and 15 C, in proportion to the density of the air.
 */
double extinctionPerKilometre(const AtmosphereOptions& atmosphere);

/** \brief Digital number of an echo by the radar equation for extended targets.
 *
 * Habib et al. 2011, Eq. (35)-(36): gain * signal * (1000 m / range)^e * exp(-2 extinction range),
 * e = 2 but for receivers that are not linear, where signal is the sum over the footprint of energy
 * share * reflectance * cos(incidence). Not rounded, not limited.
 */
double digitalNumber(double gain, double signal, double range, double extinction_per_km,
                     double range_exponent = 2.0);

/// cos(incidence) that represents the leaves of a clump, which have all orientations.
inline constexpr double kFoliageCosine = 0.5;

}  // namespace pcl_als::simulation
