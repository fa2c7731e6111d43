// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/scanner_detection.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "pair_observation.h"
#include "shared_errors.h"

namespace pcl_als {

/// The strips of a block and the surfaces that they are compared with, by index.
struct BlockStrips {
  /// A reference surface, or the fixed strips together.
  struct Held {
    ReferenceSurface surface;
    bool is_reference = false;
  };

  std::vector<std::string> ids;       ///< of strips, and names of reference surfaces
  std::vector<bool> used;             ///< false: excluded
  std::vector<int> fixed_surface_of;  ///< index in held; -1: the strip is not held fixed
  std::vector<Held> held;

  std::size_t size() const { return ids.size(); }
  /// Returns the index.
  int add(const std::string& id);
  /// UsageError for a standard deviation that is not positive, or a name of a strip.
  int addReference(const ReferenceSurface& surface);

  bool isFixed(int strip) const { return fixed_surface_of[static_cast<std::size_t>(strip)] >= 0; }
  bool isFixed(const PairObservation& o) const {
    return o.a != PairObservation::kControl && (isFixed(o.a) || isFixed(o.b));
  }
  bool isReference(int strip) const;
  /// Whether a strip is used and was flown.
  bool isFlown(int strip) const {
    return used[static_cast<std::size_t>(strip)] && !isReference(strip);
  }
  /// The strips that are, in increasing order.
  std::vector<int> flown() const;
  /// By strip, whether it is used and not held fixed.
  std::vector<bool> corrected() const;
  /// The index of a strip; UsageError for an unknown id.
  int named(const std::string& id) const;
};

/** \brief Holds the strips fixed that the settings name, and gives each held surface a system that
 * has no unknowns.
 *
 * \param systems those of all strips; those of the held surfaces are added
 * UsageError for a strip that does not exist, or where nothing is left to be calibrated.
 */
void holdSurfaces(const CalibrationSettings& settings, BlockStrips& strips, StripSystems& systems);

/** \brief What the first pass over all points finds out about a block: by strip the cells that it
 * covers, its times, its height below the trajectory, and what tells its scanner and its attitude.
 *
 * Points of different strips may be added from several threads. The index of a strip can be written
 * and read (putStrip(), getStrip()), so that indices of different strips can be merged. Memory: 48
 * bytes per cell of 10 m that a strip covers.
 */
class BlockIndex {
 public:
  /// \param trajectory as delivered; with attitude the model is rigorous (Eq. (1)), without
  /// quasi-rigorous
  /// \param anchor south-west corner of the block (metres, ground frame), the origin of the grid of
  /// areas
  BlockIndex(std::shared_ptr<const Trajectory> trajectory, const Eigen::Vector2d& anchor);

  /// Returns the index of the strip.
  int addStrip(const std::string& id);
  /// A surface that is held fixed, as one more strip, whose times are not used. UsageError for a
  /// standard deviation that is not positive, or a name of a strip.
  int addReference(const ReferenceSurface& surface);
  /// Points of a strip, ground frame, in any number of calls.
  void add(int strip, const LidarReturn* points, std::size_t count);

  /// The index of one strip; getStrip() replaces what is known of it.
  void putStrip(int strip, ByteWriter& out) const;
  void getStrip(int strip, ByteReader& in);

  const std::shared_ptr<const Trajectory>& trajectory() const { return trajectory_; }
  const BlockStrips& strips() const { return strips_; }
  const SurveyMap& map() const { return map_; }
  const TrajectoryPlausibility& plausibility() const { return plausibility_; }
  TrajectoryPlausibility& plausibility() { return plausibility_; }
  /// By strip; empty with attitude in the trajectory.
  const std::deque<AttitudeRecovery>& recoveries() const { return recoveries_; }
  /// By strip; empty without attitude in the trajectory.
  const std::deque<ScannerDetection>& scanners() const { return scanners_; }

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  BlockStrips strips_;
  SurveyMap map_;
  TrajectoryPlausibility plausibility_;
  std::deque<AttitudeRecovery> recoveries_;
  std::deque<ScannerDetection> scanners_;
};

/// What is to be calibrated, besides the points and the trajectory.
struct BlockRequest {
  CalibrationSettings settings;
  std::vector<ControlPoint> control;
  /// The only pairs of strips that are used, by id; other strips are used for control only. Empty:
  /// all that overlap.
  std::vector<std::pair<std::string, std::string>> pairs;
};

/// The trajectory that is used, and where its attitude is from.
struct BlockTrajectory {
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
  /// Sessions, channels and scanners, where no systems are given.
  std::vector<StripGroup> compared;
  BlockTrajectory flight;
  BlockScanner scanner;
  std::vector<StripPair> pairs;
  std::vector<SurveyMap::HeightOffset> pair_heights;  ///< by pair
  std::vector<SurveyArea> areas;  ///< those of pairs, then one for each control point
  std::string control_remark;     ///< why no strip covers control; empty: unknown
  std::vector<ExcludedPoints> excluded;
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
 * Strips with few points or rounded times are excluded. Without attitude in the trajectory, pitch
 * and crab are recovered from the points (AttitudeRecovery); with it, the planes of scanners that
 * have several are found.
 *
 * InputError when no strips overlap, when a reference surface overlaps none or lies far above or
 * below them, when control lies elsewhere, when the trajectory cannot belong to the points, or when
 * a strip begins before the trajectory or ends after it: such points are to be excluded by the
 * caller. Points in gaps of the trajectory are not used. UsageError for unknown strips.
 */
SurveyBlock chooseAreas(BlockIndex&& index, const BlockRequest& request);

}  // namespace pcl_als
