// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

namespace pcl_als {

/** \brief The radar equation for echoes of waveforms: their backscatter cross section and
 * backscatter coefficient.
 *
 * Wagner 2010 (ISPRS Journal of Photogrammetry and Remote Sensing 65, 505-513): the cross section
 * of the targets of an echo is sigma = C R^4 / eta P s, with the range R, the transmission eta of
 * the atmosphere on both ways, the amplitude P and the width s of the echo, and a calibration
 * constant C of sensor and flight. The backscatter coefficient is the cross section over the cross
 * section of the beam at the target, gamma = 4 sigma / (pi R² beta²). Of a Lambertian surface that
 * fills the beam gamma is 4 rho cos(theta).
 *
 * The energy of an echo is its amplitude (digitizer counts) times its full width at half maximum
 * (ns). R^4 is counted in km^4, so that C has the unit m² per count and nanosecond.
 */
struct CrossSectionModel {
  double constant = 1.0;           ///< C; 1: cross sections are relative
  double extinction_per_km = 0.0;  ///< of the air, one way, [0, 50]
  double beam_divergence = 0.3;    ///< beta, full angle, mrad, (0, 100]

  void check() const;  ///< UsageError naming value and limits
  /// sigma, m² with a calibrated constant. \param range metres
  double crossSection(double range, double energy) const;
  /// gamma of a cross section. \param range metres
  double coefficient(double range, double cross_section) const;
  /// Reflectance rho of a Lambertian target that fills the beam. \param cosine of the incidence
  /// angle, > 0
  double reflectance(double range, double energy, double cosine) const;
};

/** \brief Transmission of a pulse to each of its echoes, as the earlier ones leave it.
 *
 * An echo whose targets intercept the share f of the beam has gamma = f G, with the coefficient G
 * of a surface of the same material that intercepts all of it. What is behind gets the rest: T_i =
 * 1 - sum of gamma_j / G over the echoes before. Nothing more is lost on the way back, because the
 * light returns through the gaps that it came through. Cross sections divided by T are those that
 * the targets would have without the others.
 * \param coefficients gamma of the echoes, in order of time, not corrected
 * \param full G, > 0
 * \param least smallest transmission, for pulses whose echoes together exceed G
 */
std::vector<double> pulseTransmissions(const std::vector<double>& coefficients, double full,
                                       double least = 0.1);

}  // namespace pcl_als
