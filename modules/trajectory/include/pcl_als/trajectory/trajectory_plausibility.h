// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/heading_check.h>
#include <pcl_als/trajectory/height_check.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief Whether the points of strips can have been measured from a trajectory.
 *
 * A trajectory of another flight, in another time system, in other units or coordinates may cover
 * the same times. Points then lie above the sensor, beyond any scan angle, or far ahead of or
 * behind the sensor; a trajectory is rejected where this holds for more than half of the points.
 * Smaller displacements become visible where strips of several courses are displaced in different
 * directions. The heading is compared with the course, pitch with the planes of the pulses, and
 * roll with the edges of the swath and with recorded scan angles, where these are mirror angles;
 * without changes of pitch and roll these are not assessed. The height is compared with the one
 * that recorded scan angles imply. With times of coarse steps the firing point is uncertain by the
 * distance flown in a step.
 *
 * Some points of every strip are sufficient (one in a hundred). Points at times outside the
 * trajectory are ignored. add() may be called by several threads for different strips.
 * \code
 * TrajectoryPlausibility check(flight);
 * const int strip = check.addStrip("1");
 * check.add(strip, time, point);
 * for (const auto& finding : check.findings()) ...
 * \endcode
 */
class TrajectoryPlausibility {
 public:
  enum class Attitude {
    used,      ///< results depend on it: a wrong attitude is refused
    not_used,  ///< a wrong attitude gives a warning, because it may be that of another flight
  };
  explicit TrajectoryPlausibility(std::shared_ptr<const Trajectory> flight,
                                  Attitude attitude = Attitude::used);

  int addStrip(const std::string& name);
  /// \a scan_angle as recorded, degrees; NaN: none
  void add(int strip, double time, const Eigen::Vector3d& point,
           double scan_angle = std::numeric_limits<double>::quiet_NaN());
  /// Excludes a strip that is not used from findings().
  void leaveOut(int strip) { strips_[static_cast<std::size_t>(strip)].used = false; }

  /// Mean height of the trajectory above a strip's points, metres; 0 where no point lies below it.
  double meanHeight(int strip) const {
    const Strip& s = strips_[static_cast<std::size_t>(strip)];
    const auto below = static_cast<double>(s.count - s.above);
    return below > 0.0 ? s.height_sum / below : 0.0;
  }

  struct Finding {
    bool refuse = false;  ///< results would be wrong; otherwise only suspicious
    std::string text;     ///< what is wrong, the likely cause and the remedy
    /// the height of the trajectory is wrong, and parameters that depend on it
    bool height = false;
  };
  std::vector<Finding> findings() const;
  /// The first finding that refuses the trajectory is thrown as an InputError; with \a force all
  /// findings are returned, as are those that only warn.
  std::vector<std::string> check(bool force) const;
  /// The finding of a wrong height of the trajectory that affects the results; empty without one.
  std::string heightError() const;

 private:
  struct Strip {
    std::string name;
    bool used = true;
    std::size_t cursor = 0, count = 0;
    std::size_t above = 0, beside = 0, ahead = 0;
    double beside_sum = 0.0, ahead_sum = 0.0;  ///< metres, of those that are too far
    Eigen::Vector2d direction_sum = Eigen::Vector2d::Zero();
    double mean_ahead_sum = 0.0, height_sum = 0.0;  ///< metres, of those below the sensor
    double slope_sum = 0.0, slope_sum_sq = 0.0;     ///< of ahead / height
    double speed_sum = 0.0;                         ///< metres per second
    double last_time = std::numeric_limits<double>::quiet_NaN();
    double shortest_step = std::numeric_limits<double>::infinity();  ///< seconds
    std::size_t path_cursor = 0;
    HeadingCheck heading;
    HeightCheck angles;
    std::optional<AttitudeRecovery> recovery;  ///< where the trajectory's attitude is used
  };
  /// Mean position of the points of a strip relative to the sensor.
  struct View {
    Eigen::Vector2d direction;  ///< of flight, unit
    double ahead = 0.0;         ///< metres
    double height = 0.0;        ///< metres, of the sensor
    double spread = 0.0;        ///< standard deviation of ahead / height
  };

  static std::string objection(const Strip& strip);
  static bool viewOf(const Strip& strip, View& view);
  void checkStrips(std::vector<Finding>& findings) const;
  void checkTimes(std::vector<Finding>& findings) const;
  void checkOffset(std::vector<Finding>& findings) const;
  void checkHeight(std::vector<Finding>& findings) const;
  void checkHeading(std::vector<Finding>& findings) const;
  void checkRollAndPitch(std::vector<Finding>& findings) const;
  Finding ofAttitude(bool wrong, const std::string& text) const;
  Eigen::Vector2d offset(const std::vector<View>& views) const;

  std::shared_ptr<const Trajectory> flight_;
  std::shared_ptr<const Trajectory> path_;  ///< without attitude; null where none is compared
  Attitude attitude_;
  std::deque<Strip> strips_;
};

}  // namespace pcl_als
