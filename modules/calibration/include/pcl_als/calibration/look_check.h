// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/calibration/calibration_point.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief Whether the points of a strip can have been measured from a trajectory.
 *
 * A trajectory of another flight, of another clock or in other coordinates may cover the same
 * times. Points then lie above the sensor, beyond any scan angle, or far ahead of or behind their
 * own firing position, where a linear scanner that looks down never looks. Each is a share of the
 * points; more than half of them says that it is not the trajectory of this strip.
 */
class LookCheck {
 public:
  explicit LookCheck(std::shared_ptr<const Trajectory> trajectory)
      : trajectory_(std::move(trajectory)) {}

  /// Some points of the strip; one in a hundred will do. Those outside the trajectory are ignored.
  void add(const CalibrationPoint& point);

  /// What is impossible, for a message: "its points lie 412 m ahead of …"; empty when all is well.
  std::string objection() const;

  /// Where a strip's points lie on average, from where they were fired.
  struct Look {
    Eigen::Vector2d direction;  ///< of flight, unit
    double ahead = 0.0;         ///< metres
    double height = 0.0;        ///< metres, of the sensor
    bool seen = false;          ///< false: no point
  };
  Look look() const;

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  std::size_t cursor_ = 0, count_ = 0;
  std::size_t above_ = 0, beside_ = 0, ahead_ = 0;
  double beside_sum_ = 0.0, ahead_sum_ = 0.0;  ///< metres, of those that are too far
  Eigen::Vector2d direction_sum_ = Eigen::Vector2d::Zero();
  double mean_ahead_sum_ = 0.0, height_sum_ = 0.0;  ///< metres, of those below the sensor
};

/** \brief How far the trajectory lies beside its own place, metres, in plan: one in other
 * coordinates than the points, as after a change of datum.
 *
 * Strips flown one way then look ahead and strips flown the other way back, which no mounting of
 * the scanner explains: ahead = c height - offset . direction, for all strips together. Zero where
 * it is no more than differences in pitch (5 degrees; one degree where the attitude is known)
 * may be, and across parallel lines, where nothing shows it.
 */
Eigen::Vector2d trajectoryOffset(const std::vector<LookCheck::Look>& looks, bool attitude_known);

}  // namespace pcl_als
