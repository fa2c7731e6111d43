// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/error_source.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "adjustment.h"
#include "parameter_choice.h"
#include "spike_and_slab.h"

namespace pcl_als {

/// Prior probability that parts of a block do not differ in an unknown.
inline constexpr double kDifferenceAbsent = 0.9;

/// What may differ between parts of a block that one instrument measured.
struct DifferenceUnknown {
  int index;                      ///< of SystemUnknowns
  std::string name, title, unit;  ///< of results; title for people
  double per_unit;                ///< internal units
  double slab;  ///< standard deviation where there is a difference, internal units
};

/// Boresight, range bias and scan angle scale; with \a offsets also the coordinates.
std::vector<DifferenceUnknown> differenceUnknowns(bool offsets);

/// The finding of one unknown, without its source, title and hint. \param at index in the mixture
ErrorFinding differenceFinding(const DifferenceUnknown& unknown, const SpikeAndSlab& mixture,
                               Eigen::Index at, const ScanGeometry& edge);

/** \brief Groups of strips that may differ although no systems are given: sessions (three hours or
 * more without a strip between them) and, where strips are those of channels, channels. Where every
 * pass has the same number of strips with ids of their own, at most four, these are taken for
 * scanners, in the order of the strips.
 *
 * Named "session1", "session2_channel0", "scanner2" …, in order; empty where there is only one
 * group.
 *
 * \param times first and last time by strip; both zero: not used
 * \param passes by strip, passesOf()
 */
std::vector<StripGroup> comparedGroups(const std::vector<std::string>& ids,
                                       const std::vector<TimeSpan>& times,
                                       const std::vector<int>& passes);

/** \brief Weighs the pairs of an adjustment with the differences of the groups after the first to
 * the first one as unknowns.
 *
 * Under common parameters the pairs of a group that differs are outliers, most of all those that
 * show the difference best; robust weights then make it smaller than it is.
 *
 * \param choice the parameters that are estimated, and the solution from which the first weights
 * follow
 * \param adjustment whose systems are the groups; gets the weights, and keeps its unknowns
 * \return false if an adjustment could not be solved
 */
bool weighWithDifferences(const std::vector<StripGroup>& groups, const ParameterChoice& choice,
                          const std::vector<AreaObservations>& observations, int threads,
                          Adjustment& adjustment);

/** \brief Adds to the diagnosis how probable differences of the groups after the first to the first
 * one are: of boresight, range bias and scan angle scale, and between sessions of the coordinates
 * (base station, datum, geoid).
 *
 * The adjustment is solved with all differences of a group as unknowns and with variance components
 * estimated together with them: without them, differences inflate these. Presence follows from the
 * one solution (SpikeAndSlab), with Student's t distribution for the number of strips, to which the
 * prior of the trajectory errors contributes four degrees of freedom. Nothing is corrected.
 */
void addGroupDifferences(const std::vector<StripGroup>& groups, std::size_t strips,
                         const ScanGeometry& edge, const ParameterChoice& choice,
                         const Adjustment& adjustment, std::vector<ErrorFinding>& diagnosis);

/** \brief Warns of differences that are supported (determined, probability above 0.9), and objects
 * to a result whose parameters cannot be those of all groups.
 *
 * \param first of the findings of addGroupDifferences() or fieldDifferences()
 * \param relevant smallest effect of the difference of a parameter that is an objection, metres
 */
void judgeDifferences(std::size_t first, double relevant, Hint hint, CalibrationResult& result);

}  // namespace pcl_als
