// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/error_source.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "field_differences.h"
#include "pair_observation.h"

namespace pcl_als {

/// A hypothesis: errors of the scan angle that are a function of the scan angle.
struct AngleCurve {
  static constexpr const char* kSource = "scan_angle_curve";
  ErrorFinding finding;            ///< value: RMS over the swath, arcsec
  std::vector<AngleError> errors;  ///< by scan angle, from right to left
};

/** \brief How probable it is that the scan angle has an error that depends on the scan angle in
 * another way than by its scale, a quadratic and a cubic function, and the curve.
 *
 * Points are divided into classes of the scan angle, and every class has a roll of its own: a
 * random effect, whose variance is found together with the variance components of the trajectory
 * errors by the restricted likelihood. The Bayes factor is that of a normal prior with standard
 * deviations from 3 to 100 arcsec against none; the likelihood is divided by the overdispersion of
 * the areas' contributions. For scanners that deflect the beam in one plane across the flight.
 *
 * \param observations all pairs of the adjustment, with the effects of the error sources
 * \param considered sources that the adjustment estimates
 * \param largest_angle radians
 */
AngleCurve angleCurve(const AdjustedBlock& block, const WeightedObservations& observations,
                      const std::vector<ErrorSource>& considered, double largest_angle,
                      const ScanGeometry& edge);

/// Adds the curve to the diagnosis, and objects to a result whose parameters it affects. \param
/// relevant smallest effect that is an objection, metres
void judgeAngleCurve(AngleCurve curve, double relevant, CalibrationResult& result);

}  // namespace pcl_als
