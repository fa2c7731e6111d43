// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "synthetic_pairs.h"

namespace pcl_als {

/// Properties of a block on which the parameters depend by section 2.2 of Habib et al. 2011.
/// Strips without observations are not considered.
struct BlockFacts {
  std::vector<double> heights;  ///< metres above ground, those that differ by a tenth, ascending
  std::vector<std::size_t> lines_at;  ///< number of strips at each height
  bool opposite_lines = false;        ///< two overlapping strips of opposite directions
  bool crossing_lines = false;        ///< two overlapping strips of different axes
  /// two overlapping strips of the same direction, displaced laterally
  bool parallel_lines = false;
  double separation = 0.0;  ///< the largest displacement of these, share of the swath's half width
  bool heights_meet = false;       ///< two overlapping strips of different heights
  std::size_t control = 0;         ///< control points covered by a strip
  std::string control_text;        ///< "6 control points, 1 reference surface"
  double slope = 0.0;              ///< RMS tilt of the measuring normals, radians
  double sloped = 0.0;             ///< share of pairs on surfaces steeper than 5 degrees
  double half_angle = 0.0;         ///< largest angle off the vertical of a pair, radians
  double least_angle = 0.5 * kPi;  ///< and the smallest

  explicit BlockFacts(const ObservedBlock& block);

  /// The cause for which the block cannot separate these parameters, or does not determine the one;
  /// empty when none of the known causes applies.
  std::string causeOf(const std::vector<SystemParameter>& parameters) const;
  /// "heights 540 and 1150 m, opposite lines, …": the facts in one line.
  std::string text() const;

 private:
  void countHeights(const ObservedBlock& block, const std::set<int>& strips);
  std::string fewLines() const;
};

/// Distribution of the slopes of the pairs of a block.
SurfaceModel surfaceOf(const BlockFacts& facts);

}  // namespace pcl_als
