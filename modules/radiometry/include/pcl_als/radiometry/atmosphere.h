// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

namespace pcl_als {

/// The atmosphere between sensor and ground, as reported by a weather station.
/// \code
/// pcl_als::Atmosphere weather;
/// weather.visibility_km = 48.3;
/// const double per_km = pcl_als::extinctionOf(weather).total();
/// \endcode
struct Atmosphere {
  double visibility_km = 23.0;      ///< meteorological range, [0.01, 500]
  double temperature_c = 15.0;      ///< [-60, 60]
  double pressure_kpa = 101.325;    ///< [20, 120]
  double relative_humidity = 50.0;  ///< percent, [0, 100]
  double wavelength_nm = 1064.0;    ///< of the laser, [500, 1650]

  /// UsageError naming the first value out of its range.
  void check() const;
};

/** \brief Extinction of the air near the ground by its causes, 1/km.
 *
 * - aerosol: 3.91 / V (lambda / 550 nm)^-q. Kruse, McGlauchlin, McQuistan 1962; q of Kim, McArthur,
 *   Korevaar 2001 (Proc. SPIE 4214): 1.6 above 50 km, 1.3 from 6, 0.16 V + 0.34 from 1, V - 0.5
 * from 0.5, else 0. The formula jumps by 0.1 (6 %) at V = 50 km, as published.
 * - rayleigh: cross section of Bodhaine, Wood, Dutton, Slusser 1999 (J. Atmos. Oceanic Technol.
 * 16), Eq. (29), times the number of molecules, p / (k T).
 * - water_vapour, mixed_gases: band model of Bird and Riordan 1984 (SERI/TR-215-2436), Eq. (2-8)
 * and (2-11), for one kilometre; vapour from the humidity with the Magnus formula (WMO-No. 8).
 *   These are means over bands of 10 to 30 nm: a laser line can lie on or between absorption lines.
 */
struct Extinction {
  double aerosol = 0.0, rayleigh = 0.0, water_vapour = 0.0, mixed_gases = 0.0;
  double total() const { return aerosol + rayleigh + water_vapour + mixed_gases; }
};

/// The extinction for an atmosphere. UsageError as Atmosphere::check().
Extinction extinctionOf(const Atmosphere& atmosphere);

/// Extinction coefficient (1/km) from an attenuation of the power in dB/km, one way: the value
/// times ln(10) / 10. UsageError unless it is in [0, 100].
double extinctionFromDecibel(double decibel_per_km);

/// Transmission exp(-2 a r) from the sensor to the ground and back; extinction a in 1/km, range r
/// in metres.
double twoWayTransmission(double extinction_per_km, double range);

}  // namespace pcl_als
