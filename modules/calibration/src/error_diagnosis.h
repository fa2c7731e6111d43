// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "pair_observation.h"
#include "parameter_choice.h"
#include "shared_errors.h"

namespace pcl_als {

/// Geometry at the edge of the highest swath: the largest lateral distance and height of a pair.
ScanGeometry swathEdge(const std::vector<AreaObservations>& observations);

constexpr double kSupported = 0.9;  ///< probability from which the data support a source

/// Standard deviation of a bias of a new system, for the probability that it is present; internal
/// units.
double slabOf(SystemParameter p);
/// The evidence for a finding in words, from its value and standard deviation.
std::string evidenceOf(const ErrorFinding& finding);

/// Whether the data support a source and points are corrected for it.
bool isCorrected(ErrorSource source, const AdjustmentSolution& diagnosed,
                 const SharedErrorModel& model);

/// Whether there is positive evidence for a source that the data determine: a Bayes factor of more
/// than 3 (Kass and Raftery 1995, JASA 90).
bool isPossible(ErrorSource source, const AdjustmentSolution& diagnosed,
                const SharedErrorModel& model);

/** \brief Adds the diagnosis: for every estimated system parameter and every error source that was
 * considered, the probability that it is present (SpikeAndSlab), its value, its effect at the edge
 * of the swath, the evidence and the hint.
 *
 * Sources that the data support are corrected, slope_ranging excepted, which depends on the
 * surface. A source is determined as in SharedErrorModel::isDetermined().
 */
/// \param diagnosed solution with all sources
void addErrorSources(const SharedErrors& errors, const ParameterChoice& choice,
                     const AdjustmentSolution& diagnosed, const ScanGeometry& edge,
                     const ErrorSourceScale& scale, double speed, CalibrationResult& result);

/// Marks sources as corrected with these values, where they are not zero.
void addHeldSources(const ErrorSourceVector& values, CalibrationResult& result);

/// Where a range error that depends on the intensity is corrected: the intensity to which the range
/// bias refers.
void stateReferenceIntensity(CalibrationResult& result);

/// Names the offsets of the block that are corrected.
void warnOfBlockOffset(CalibrationResult& result);

/// Adds the effects of sources with these values to PairObservation::further.
void addSourceEffects(const ErrorSourceVector& values, AreaObservations& observations);
/// Takes the effects of sources with these values out of the observations.
void removeSources(const ErrorSourceVector& values, AreaObservations& observations);

}  // namespace pcl_als
