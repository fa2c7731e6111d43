// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/quality/control_check.h>
#include <pcl_als/quality/pair_assessment.h>
#include <pcl_als/registration/patch_alignment.h>

namespace pcl_als {

/// Settings of a check.
struct CheckSettings {
  SurfaceLimits limits;
  AreaSelection selection;
  std::vector<ControlPoint> control;
  double control_sigma = 0.02;        ///< metres, where the file gives none
  std::size_t minimum_points = 1000;  ///< strips with fewer are excluded
  double minimum_overlap = 500.0;     ///< m^2: pairs with less are listed but not compared
  /// places of comparison in all areas, on level ground and on slopes each
  std::size_t candidates = 100'000;
  bool force = false;  ///< continue with a trajectory that cannot belong to the points
  int threads = 0;
};

/// One pair in a report.
struct CheckedPair {
  std::string a, b;
  double overlap_area = 0.0;  ///< m^2
  bool too_small = false;     ///< below CheckSettings::minimum_overlap: areas are not chosen for it
  bool of_one_pass = false;   ///< both share their errors, and agree whatever these are
  std::size_t areas = 0;      ///< areas of comparison
  PairAssessment assessment;
  std::optional<PatchAlignmentResult> alignment;  ///< where it was attempted
  std::vector<OffsetSample> samples;  ///< at most kScatter at even intervals, for scatter plots
  std::size_t points_a = 0, points_b = 0;
  double milliseconds = 0.0;  ///< spent on this pair, all threads
  double memory_mb = 0.0;     ///< of its points and surfaces

  static constexpr std::size_t kScatter = 5000;
};

struct CheckedStrip {
  std::string id;
  std::uint64_t points = 0;
  std::optional<Eigen::Vector2d> course;
  double repeated = 0.0;  ///< share of points with the coordinates of another point of the strip
};

/// How many overlapping pairs were measured, and why the others were not.
struct PairCounts {
  std::size_t measured = 0;      ///< of two passes
  std::size_t of_one_pass = 0;   ///< measured, but of one pass: they are not pairs of a delivery
  std::size_t too_far = 0;       ///< further apart than surfaces are compared
  std::size_t unmeasurable = 0;  ///< too little in common, or the same points twice
  std::size_t too_small = 0;     ///< overlaps below CheckSettings::minimum_overlap, not measured

  std::size_t all() const { return measured + too_far + unmeasurable; }
};
PairCounts countPairs(const std::vector<CheckedPair>& pairs);
/// Pairs of strips that overlap and were not measured, with the reason or the distance, in one
/// sentence for each of both; at most five are named in each. Empty where all were measured.
std::vector<std::string> unmeasuredPairs(const std::vector<CheckedPair>& pairs);

/// A reduced swath separation image: at every place the most frequent colour of the cells that two
/// strips cover.
struct SeparationOverview {
  enum Code : std::uint8_t { nothing, one_strip, within_limit, within_twice, beyond };
  int columns = 0, rows = 0;
  double cell = 0.0;                                     ///< metres
  Eigen::Vector2d north_west = Eigen::Vector2d::Zero();  ///< metres, ground frame
  std::vector<std::uint8_t> codes;                       ///< row by row from the north-west
};

/// Numbers of cells of a swath separation image by colour, and its georeference.
struct SeparationSummary {
  double cell = 0.0;   ///< metres
  double limit = 0.0;  ///< metres: green up to it, yellow up to twice as much
  std::uint64_t green = 0, yellow = 0, red = 0;
  std::vector<std::string> files;
  SeparationOverview overview;
};

/// Result of a check of one set of strips.
struct CheckedBlock {
  std::vector<std::string> files;
  std::vector<CheckedStrip> strips;
  std::vector<CheckedPair> pairs;
  std::vector<TriangleClosure> triangles;  ///< of vertical offsets
  std::vector<MotionClosure> motions;      ///< of alignments
  std::optional<ControlAssessment> control;
  std::optional<SeparationSummary> separation;  ///< of the images that were written
  double roughness_limit = 0.0;                 ///< metres: limit of smooth surfaces
  Warnings warnings;
  std::vector<ExcludedPoints> excluded;  ///< points that were excluded
};

}  // namespace pcl_als
