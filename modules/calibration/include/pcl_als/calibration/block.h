// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/calibration/block_index.h>
#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// What is to be calibrated, besides the points and the trajectory.
struct BlockRequest {
  CalibrationSettings settings;
  std::vector<ControlPoint> control;
  /// The only pairs of strips that are used, by id; other strips are used for control only. Empty:
  /// all that overlap.
  std::vector<std::pair<std::string, std::string>> pairs;
};

/// The trajectory that is used, and where its attitude is from.
struct BlockFlight {
  std::shared_ptr<const Trajectory> trajectory;
  AttitudeSource attitude = AttitudeSource::none;
  RecoveredAttitude recovered;
  std::vector<std::string> remarks;  ///< on the recovery of attitude and on scan planes
  HeightError height_error;          ///< of the trajectory, from recorded scan angles
};

/// The pattern of the scanner, where the trajectory has attitude.
struct BlockScanner {
  bool conical = false, rosette = false;
  bool about_axis = false;  ///< whether the beam is not deflected by a mirror about one axis

  bool isLinear() const { return !conical && !rosette; }
};

/// Of the points of a strip.
struct SurveyedStrip {
  TimeSpan span;  ///< first and last firing time, seconds
  std::size_t points = 0;
  double height = 0.0;  ///< mean height of the sensor above them, metres; 0: unknown
};

/** \brief A block whose strips, pairs and areas are chosen; constant from then on. */
struct SurveyBlock {
  BlockRequest request;  ///< with limits of determination for the flying height
  BlockStrips strips;
  std::vector<SurveyedStrip> surveyed;  ///< by strip
  StripSystems systems;
  std::vector<StripGroup> compared;  ///< sessions and channels, where no systems are given
  BlockFlight flight;
  BlockScanner scanner;
  std::vector<StripPair> pairs;
  std::vector<SurveyMap::HeightOffset> pair_heights;  ///< by pair
  std::vector<SurveyArea> areas;  ///< those of pairs, then one for each control point
  std::string control_remark;     ///< why no strip covers control; empty: unknown
  std::vector<LeftOutPoints> left_out;
  Warnings warnings;

  const CalibrationSettings& settings() const { return request.settings; }
  const Trajectory& trajectory() const { return *flight.trajectory; }
  /// The number of areas of pairs.
  std::size_t pairAreas() const { return areas.size() - request.control.size(); }
  bool isControl(std::size_t area) const { return area >= pairAreas(); }
  /// The control point of an area.
  const ControlPoint& controlOf(std::size_t area) const {
    return request.control[area - pairAreas()];
  }
  /// Firing times by strip; zero for strips that are not used and for reference surfaces.
  std::vector<TimeSpan> flownTimes() const;
};

/** \brief Chooses the strips, the pairs and the areas of a block from its index, which is consumed.
 *
 * Strips with few points or rounded times are left out. Without attitude in the trajectory, pitch
 * and crab are recovered from the points (AttitudeRecovery); with it, the planes of scanners that
 * have several are found.
 *
 * InputError when no strips overlap, when a reference surface overlaps none or lies far above or
 * below them, when control lies elsewhere, when the trajectory cannot belong to the points, or when
 * a strip begins before the trajectory or ends after it: such points are to be left out by the
 * caller. Points in gaps of the trajectory are not used. UsageError for unknown strips.
 */
SurveyBlock chooseAreas(BlockIndex&& index, const BlockRequest& request);

}  // namespace pcl_als
