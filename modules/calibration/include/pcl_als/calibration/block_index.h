// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>

#include <pcl_als/calibration/block_strips.h>
#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/scanner_detection.h>
#include <pcl_als/trajectory/trajectory.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als {

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

}  // namespace pcl_als
