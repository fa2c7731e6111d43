// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "area_matcher.h"
#include "pair_observation.h"
#include "shared_errors.h"

namespace pcl_als {

/// Numbers of points by strip and value of a field.
using ValueCounts = std::map<int, std::map<int, std::size_t>>;

/** \brief A block whose strips are divided by the value of a field: the points of a strip that have
 * the k-th value are a strip of their own, number strip * values.size() + k.
 *
 * The parts of a strip are one pass (their trajectory errors are the same), the points of one value
 * are those of one system.
 */
struct FieldDivision {
  PointField field = PointField::scanner_channel;
  std::vector<int> values;  ///< in ascending order; empty: nothing to compare

  /// The values that enough points have, where some strip has two of them. None where there are so
  /// many values that they do not tell parts of an instrument apart.
  static FieldDivision of(PointField field, const ValueCounts& counts);

  std::size_t parts() const { return values.size(); }
  int partOf(int strip, std::size_t k) const {
    return strip * static_cast<int>(parts()) + static_cast<int>(k);
  }
  /// "channel1", "user_data3", "points_scanned_to_the_left": the points of the k-th value.
  std::string nameOf(std::size_t k) const;
  /// All combinations of the parts of these pairs of strips, and the pairs of parts of each of
  /// these strips.
  std::vector<StripPair> pairs(const std::vector<StripPair>& of_strips,
                               const std::vector<int>& strips) const;
  /// For each part what is given for each strip.
  template <class T>
  std::vector<T> repeated(const std::vector<T>& of_strips) const {
    std::vector<T> all;
    for (const T& value : of_strips) all.insert(all.end(), parts(), value);
    return all;
  }
  StripSystems systems(std::size_t strips) const;
};

/// An adjustment of a block, of which differences within strips are found by a further one.
struct AdjustedBlock {
  std::vector<TimeSpan> spans;  ///< by strip
  SharedErrorModel model;
  VarianceFactors levels;
  std::vector<SystemParameter> estimate;
  int threads = 0;
};

/** \brief How probable it is that points with another value of a field differ from those with the
 * first value in boresight, range bias or scan angle scale, and by how much.
 *
 * The block is adjusted once more with divided strips, for changes of its parameters together with
 * the differences: a difference between crossing scan planes resembles a pitch of both, by which
 * the parameters of one system absorb most of it. Presence as of addGroupDifferences().
 *
 * \param observations by area, of the parts; misclosures are those of corrected points
 */
std::vector<ErrorFinding> fieldDifferences(const FieldDivision& division,
                                           const AdjustedBlock& block,
                                           const std::vector<AreaObservations>& observations,
                                           const ScanGeometry& edge);

}  // namespace pcl_als
