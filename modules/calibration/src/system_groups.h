// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/strip_group.h>

#include "adjustment.h"
#include "parameter_choice.h"

namespace pcl_als {

/** \brief By strip, the first strip of its pass.
 *
 * Strips are of one pass if their ids are those of channels of one strip, or if half of the time of
 * the shorter one, or more, is also time of the other, as of two scanners with ids of their own.
 * Their trajectory errors are the same: as errors of several passes they would make standard
 * deviations too small.
 *
 * \param flown first and last firing time of each strip, seconds; equal: the strip is not used
 */
std::vector<int> passesOf(const std::vector<std::string>& ids, const std::vector<TimeSpan>& flown);

/// The systems of the strips \a ids. UsageError for a group without a strip, a strip in two groups,
/// two groups of one name, and a strip that does not exist. \param pass by strip, passesOf()
StripSystems stripSystems(const std::vector<StripGroup>& groups, const PerSystemParameters& own,
                          const std::vector<std::string>& ids, std::vector<int> pass);

/// Differences of all systems to the first one according to a solution
/// (AdjustmentSolution::shared).
std::vector<SystemUnknowns> systemDifferences(const SharedErrors& errors,
                                              const Eigen::VectorXd& shared);

/// Effect on the distance of a pair of the differences of the systems to the first one, metres.
double effectOfSystems(const StripSystems& systems, const std::vector<SystemUnknowns>& differences,
                       const PairObservation& observation);

/// Lets systems share unknowns whose differences to the first system are less well determined than
/// the limits, the worst one of each system. Returns whether there were any.
bool shareUndetermined(const Adjustment& adjustment, const ParameterChoice& choice,
                       const DeterminationLimits& limits, SharedErrors& errors);

/// Adds the systems to the result of a calibration, where there are several.
void addSystems(const Adjustment& adjustment, const SharedErrors& errors,
                const ParameterChoice& choice, const std::vector<StripGroup>& groups,
                const std::vector<std::string>& ids, CalibrationResult& result);

/// Differences of the systems to the first one as a result states them, by which points are
/// corrected; none for strips that are held fixed, whose points stay where they are.
/// \param solved of all systems; the heights of reference surfaces stay as they are
std::vector<SystemUnknowns> statedDifferences(const CalibrationResult& result,
                                              const StripSystems& systems,
                                              std::vector<SystemUnknowns> solved);

}  // namespace pcl_als
