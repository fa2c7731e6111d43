// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief A flight line as used for the geometry of a calibration: straight, level, at constant
 * speed, with a vertical scanner.
 *
 * Plan coordinates are metres in any local ground frame (east, north).
 */
struct StripGeometry {
  std::string id;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< metres, plan, of the sensor
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double height = 1000.0;                        ///< metres above the mean ground of the block
  double half_angle = 20.0 * kRadiansPerDegree;  ///< radians, half the field of view
  double speed = 60.0;                           ///< metres per second
  double density = 1.0;                          ///< pulses per square metre
  double first_time = 0.0;                       ///< seconds, firing time at start

  double length() const { return (end - start).norm(); }  ///< metres
  double duration() const { return length() / speed; }    ///< seconds
  Eigen::Vector2d direction() const { return (end - start) / length(); }
  double course() const;     ///< radians clockwise from grid north, [0, 2 pi)
  double halfSwath() const;  ///< metres, on ground at the mean height
  /// Signed distance of a place from the line in plan, right of flight positive, metres.
  double lateral(const Eigen::Vector2d& place) const;
  /// Distance along the line from its start, metres; outside [0, length()] beyond its ends.
  double along(const Eigen::Vector2d& place) const;
  /// Whether the swath covers a place at the mean height.
  bool covers(const Eigen::Vector2d& place) const;
  /// Pose of the sensor abeam of a place; height 0 is the mean ground.
  SensorPose poseAbeam(const Eigen::Vector2d& place) const;
  /// Time of emission for points abeam, seconds.
  double timeAbeam(const Eigen::Vector2d& place) const { return first_time + along(place) / speed; }
  /// UsageError naming the line when it cannot be flown: length, height, angle, speed, density.
  void validate() const;
};

/// Angle between two courses, radians, [0, pi].
double courseDifference(const StripGeometry& a, const StripGeometry& b);

/// Whether two lines have the same axis (within 20 degrees), in the same or the opposite direction.
bool sameWay(const StripGeometry& a, const StripGeometry& b);
bool opposite(const StripGeometry& a, const StripGeometry& b);

/// Distance of the middles of two lines across the first, metres.
double lateralSeparation(const StripGeometry& a, const StripGeometry& b);

/// Whether two lines' heights differ by no more than a tenth.
bool sameHeight(const StripGeometry& a, const StripGeometry& b);

}  // namespace pcl_als
