// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/time_resolution.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/heading_check.h>
#include <pcl_als/trajectory/height_check.h>
#include <pcl_als/trajectory/path_evidence.h>
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
 * that recorded scan angles imply, and the trajectory with the rays through several returns of a
 * pulse, which pass through it. With times of coarse steps the firing point is uncertain by the
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
    used,      ///< results depend on it: a wrong attitude is refused; positions alone would do
    needed,    ///< the same where nothing can be computed without an attitude
    not_used,  ///< a wrong attitude gives a warning, because it may be that of another flight
    not_compared,
  };
  explicit TrajectoryPlausibility(std::shared_ptr<const Trajectory> flight,
                                  Attitude attitude = Attitude::used);

  int addStrip(const std::string& name);
  /// \a scan_angle as recorded, degrees; NaN: none
  void add(int strip, double time, const Eigen::Vector3d& point,
           double scan_angle = std::numeric_limits<double>::quiet_NaN());
  /// As many of consecutive points of a strip as are sufficient for add(), and the times of all.
  void addRun(int strip, const LidarReturn* points, std::size_t count);
  /// A return of a run of consecutive ones: the rays through several returns of a pulse show where
  /// the points were measured from. Beside add(), which needs single points only.
  void addReturn(int strip, const LidarReturn& point) {
    strips_[static_cast<std::size_t>(strip)].rays.add(point);
  }
  /// The trajectory was reconstructed from points: findings are of it, and not of one that a user
  /// gave.
  void nameReconstructed() { reconstructed_ = true; }
  /// The time of a point, for the resolution of the times: of all points, or of runs of consecutive
  /// ones.
  void addTime(int strip, double time) {
    if (std::isfinite(time)) strips_[static_cast<std::size_t>(strip)].times.add(time);
  }
  /// All points of a strip so far, for another process.
  void putStrip(int strip, ByteWriter& out) const;
  void getStrip(int strip, ByteReader& in);
  /// Excludes a strip that is not used from findings().
  void exclude(int strip) { strips_[static_cast<std::size_t>(strip)].used = false; }

  /// Mean height of the trajectory above a strip's points, metres; 0 where no point lies below it.
  double meanHeight(int strip) const {
    const Strip& s = strips_[static_cast<std::size_t>(strip)];
    const auto below = static_cast<double>(s.count - s.above);
    return below > 0.0 ? s.height_sum / below : 0.0;
  }

  /// Metres that the sensor moves within a step of the strip's times; zero where these are not
  /// rounded or no point was added.
  double distancePerStep(int strip) const;
  /// Whether the places that a strip was measured from are not known well enough, because its times
  /// are rounded.
  bool timesTooCoarse(int strip) const;
  /// TimeResolution::describe()
  std::string timeSteps(int strip) const {
    return strips_[static_cast<std::size_t>(strip)].times.describe();
  }

  /// Why most points of a strip cannot have been measured from the trajectory ("its points lie 5283
  /// m beside the trajectory"), with the likely cause; empty where they can, or none was added.
  std::string whyOutOfReach(int strip) const;

  struct Finding {
    bool refuse = false;  ///< results would be wrong; otherwise only suspicious
    Warning warning;      ///< what is wrong, the likely cause and the hint
    bool height = false;  ///< of the height of the trajectory
  };
  std::vector<Finding> findings() const;
  /// The first finding that refuses the trajectory is thrown as an InputError; with \a force all
  /// findings are returned, as are those that only warn, and with \a force_height those of a wrong
  /// height, of which the caller judges the effect by heightError().
  Warnings check(bool force, bool force_height = false) const;
  /// Frees the second trajectory, with which check() compares the attitude: nothing may be added or
  /// checked after it.
  void release();
  /// The error of the trajectory's height; none where another finding comes first.
  HeightError heightError() const;

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
    double along_sum = 0.0;                         ///< metres ahead, of all points
    Eigen::Vector3d point_sum = Eigen::Vector3d::Zero(), sensor_sum = point_sum;  ///< metres
    TimeResolution times;
    std::size_t path_cursor = 0;
    HeadingCheck heading;
    HeightCheck angles;
    PathEvidence rays;
    std::optional<AttitudeRecovery> recovery;  ///< where the trajectory's attitude is used
  };
  /// Mean position of the points of a strip relative to the sensor.
  struct View {
    Eigen::Vector2d direction;  ///< of flight, unit
    double ahead = 0.0;         ///< metres
    double height = 0.0;        ///< metres, of the sensor
    double spread = 0.0;        ///< standard deviation of ahead / height
  };

  /// Every so many of \a count points from \a duration seconds are sufficient for add(): roll is
  /// seen at the edges of the swath, for which points of each tenth of a second are needed.
  std::size_t spacing(std::size_t count, double duration) const;
  static std::string objection(const Strip& strip);
  /// The likely cause of an objection, and what can be stated about it; empty where none is found.
  static Warning causeOf(const Strip& strip);
  static Warning outOfReach(const Strip& strip);
  static bool viewOf(const Strip& strip, View& view);
  void checkStrips(std::vector<Finding>& findings) const;
  void checkTimes(std::vector<Finding>& findings) const;
  void checkOffset(std::vector<Finding>& findings) const;
  void checkRays(std::vector<Finding>& findings) const;
  void checkHeight(std::vector<Finding>& findings) const;
  void checkHeading(std::vector<Finding>& findings) const;
  void checkRollAndPitch(std::vector<Finding>& findings) const;
  static void nameReconstructed(std::vector<Finding>& findings);
  Finding ofAttitude(bool wrong, const std::string& text) const;
  HeightError heightOfStrips() const;
  Eigen::Vector2d offset(const std::vector<View>& views) const;

  std::shared_ptr<const Trajectory> flight_;
  std::shared_ptr<const Trajectory> path_;  ///< without attitude; null where none is compared
  Attitude attitude_;
  bool reconstructed_ = false;
  std::deque<Strip> strips_;
};

}  // namespace pcl_als
