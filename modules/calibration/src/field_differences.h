// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include <pcl_als/calibration/pair_observation.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "area_matcher.h"

namespace pcl_als {

/** \brief A pair of points of one strip of which one has the reference value of a field, the other
 * another value: one equation of what the other value's system parameters differ by.
 *
 * The two were measured within moments of each other, so that errors of the trajectory cancel.
 */
struct FieldPair {
  int strip = 0;
  int value = 0;                      ///< the other value
  SystemRow row = SystemRow::Zero();  ///< effect of the parameters' difference on the distance
  double distance = 0.0;              ///< of the corrected points, along the normal, metres
  double variance = 0.0;              ///< of the distance, with what it shares with others, m^2
};

/// Values of a field whose points are compared.
struct ComparedValues {
  PointField field = PointField::scanner_channel;
  int reference = 0;        ///< that of most points
  std::vector<int> others;  ///< in ascending order
  std::vector<int> all() const;
};

/// The values of a field that enough points have, from the numbers of points; the most frequent one
/// is the reference. No others where points have one value, or so many that they do not tell parts
/// of an instrument apart.
ComparedValues comparedValues(PointField field, const std::map<int, std::size_t>& counts);

/// Adds the pairs of a matcher from AreaMatcher::divided(), whose points were corrected for \a
/// biases and \a sources.
void addFieldPairs(const ComparedValues& values, int strip, const AreaObservations& observations,
                   const SystemVector& biases, const ErrorSourceVector& sources,
                   std::vector<FieldPair>& pairs);

/** \brief How probable it is that points with another value of a field differ from those with the
 * reference value in boresight, range bias or scan angle scale, and by how much.
 *
 * Least squares with Huber weights, one value after the other; the covariance is that of clusters
 * (what one strip has in one area), and presence follows from it as in addGroupDifferences().
 *
 * \param pairs by area; those of a strip follow each other
 */
std::vector<ErrorFinding> fieldDifferences(const ComparedValues& values,
                                           const std::vector<std::vector<FieldPair>>& pairs,
                                           const ScanGeometry& edge);

}  // namespace pcl_als
