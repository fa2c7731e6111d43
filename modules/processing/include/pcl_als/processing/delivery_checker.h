// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/shared_work.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/processing/separation_image.h>
#include <pcl_als/quality/area_offsets.h>
#include <pcl_als/quality/control_check.h>
#include <pcl_als/quality/pair_assessment.h>
#include <pcl_als/quality/strip_alignment.h>
#include <pcl_als/quality/strip_course.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {

/// Settings of a check.
struct CheckSettings {
  SurfaceLimits limits;
  SurveyMap::Selection selection;
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

/** \brief Checks one set of strips: three passes over the files, memory for the chosen areas only.
 *
 * The processes of the SurveyReader share the work: each measures its share of the areas, for which
 * it receives the points, and aligns its share of the pairs. All functions are collective and give
 * the same results in all processes.
 */
class DeliveryChecker {
 public:
  DeliveryChecker(SurveyReader& survey, const CheckSettings& settings,
                  std::shared_ptr<const Trajectory> trajectory);

  /// First pass: the ground that each strip covers. Returns the points that the reader left out.
  /// InputError when no strips overlap.
  std::vector<ExcludedPoints> surveyBlock();
  const std::vector<SurveyMap::Overlap>& overlaps() const { return overlaps_; }
  /// Sum of the areas that the strips cover, m^2.
  double coveredArea() const;

  /// Chooses areas, or uses those of another set of the same block.
  void chooseAreas();
  void setAreas(std::vector<SurveyArea> areas);
  const std::vector<SurveyArea>& areas() const { return areas_; }

  /// Second pass, point by point; \a also receives every point, strip by strip (of several
  /// processes: in the first one).
  using PointSink = std::function<void(int strip, const LidarReturn& point)>;
  void load(const PointSink& also);
  std::size_t loadedPoints() const { return loaded_points_; }

  CheckedBlock assess(const std::function<void(double)>& progress);

 private:
  LidarReturn pointOf(const SurveyReader::Run& run, std::size_t row, std::size_t& cursor) const;
  void checkTrajectory();
  void findRoughness();
  void measureAreas();
  void measureControl(CheckedBlock& block);
  std::string placeOfControl() const;
  void findDistance(std::size_t overlap, CheckedPair& pair);
  CheckedPair assessOverlap(std::size_t overlap, CellMeans& cells);
  void registerPairs(std::vector<CheckedPair>& pairs, const std::function<void(double)>& progress);
  static bool isAligned(const CheckedPair& pair) {
    return !pair.too_small && pair.assessment.status != PairAssessment::Status::copy;
  }
  void readByFirst(const PointSink& sink);
  // What processes tell each other.
  void shareStrips();
  void shareAreas();
  void shareMeasurements(std::vector<std::vector<double>>& repeated);
  void receivePoints(std::vector<ByteWriter>& sent);
  void sharePairPoints(const std::vector<CheckedPair>& pairs, const SharedItems& shares);
  AreaOffsets& target(std::size_t i) {
    return i < offsets_.size() ? offsets_[i] : control_offsets_[i - offsets_.size()];
  }
  /// Does the work for the own ones of some areas, or of the control points behind them.
  void forOwn(std::size_t first, std::size_t count,
              const std::function<void(std::size_t i)>& work) const;

  SurveyReader& survey_;
  CheckSettings settings_;
  std::shared_ptr<const Trajectory> trajectory_;
  std::optional<TrajectoryPlausibility> plausibility_;  ///< with a trajectory
  SurveyMap map_;
  std::vector<StripCourse> courses_;
  std::vector<bool> used_;
  std::vector<bool> untimed_;  ///< times are too coarse for the trajectory
  std::vector<SurveyMap::Overlap> overlaps_;
  std::vector<SurveyArea> areas_;
  std::vector<AreaOffsets> offsets_;                             ///< of the areas
  std::vector<AreaOffsets> control_offsets_;                     ///< around the control points
  std::vector<std::vector<std::vector<OffsetSample>>> samples_;  ///< by area, then by overlap
  std::vector<std::vector<double>> milliseconds_;                ///< the same
  std::vector<std::vector<std::size_t>> counts_;                 ///< points by area, then by strip
  std::vector<double> repeated_;                                 ///< by strip
  SharedItems strip_shares_;
  SharedItems target_shares_;      ///< of the areas, then of the control points
  std::size_t loaded_points_ = 0;  ///< of all processes
  Warnings warnings_;
  std::vector<ExcludedPoints> excluded_;
  mutable std::atomic<std::uint64_t> uncovered_{0};  ///< points that the trajectory does not cover
};

}  // namespace pcl_als
