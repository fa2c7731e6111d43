// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/processing/checked_block.h>
#include <pcl_als/quality/area_offsets.h>
#include <pcl_als/quality/strip_course.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {

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

  /// First pass: the ground that each strip covers. Returns the points that the reader excluded.
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
