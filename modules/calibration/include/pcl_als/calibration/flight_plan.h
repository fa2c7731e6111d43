// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/calibration_result.h>
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

/// A place on the ground: height above the mean ground, metres, and upward unit normal.
struct SurfacePoint {
  double height = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// Distribution of the slopes of surfaces on which pairs are formed; aspects are uniform.
struct SurfaceModel {
  double ground_slope = 5.0 * kRadiansPerDegree;  ///< RMS slope of open ground; 0: a plane
  double steep_slope = 25.0 * kRadiansPerDegree;  ///< slope of roofs, banks
  double steep_share = 0.0625;                    ///< share of these in the usable surface
  double usable = 0.5;                            ///< share of the points on solid, smooth surfaces
  /// Pairs are chosen evenly over slopes and aspects, as by AreaMatcher, so that steep surfaces
  /// have more pairs than their share; false: the shares are those of the pairs.
  bool balanced = true;
  /// Terrain that replaces ground_slope; empty where it is not known.
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d&)> terrain;

  void validate() const;  ///< UsageError that names an impossible value
};

/// One direction in the space of parameters and its standard deviation.
struct ParameterDirection {
  /// A unit vector; each parameter is expressed by its effect on a ground point, so that equal
  /// components have equal effects.
  SystemVector components = SystemVector::Zero();
  double std = 0.0;  ///< along the direction, metres on the ground; infinite without information
  /// "lever_arm_y and boresight_pitch together; they may be wrong by -0.013 m and 35 arcsec (one
  /// standard deviation), each up to 13.1 mm on the ground"
  std::string text;
};

/// Parameters that the observations cannot separate, or one that they hardly determine.
struct WeakCombination {
  std::vector<SystemParameter> parameters;  ///< one or two, the less certain one first
  double correlation = 0.0;                 ///< of two
  std::string cause;  ///< from the facts of the block; empty where none applies
  std::string text;  ///< "boresight_pitch with lever_arm_y, correlation 0.97: single flying height"
};

/// A virtual line or control, and its effect.
struct Advice {
  std::string what;  ///< "an opposite line at 540 m over line 3"
  bool is_line = true;
  StripGeometry line;                    ///< of a line
  std::vector<Eigen::Vector2d> control;  ///< positions of virtual control
  SystemVector before =
      SystemVector::Zero();  ///< standard deviations, internal units; infinite: not determined
  SystemVector after = SystemVector::Zero();
  double benefit = 0.0;  ///< sum of ln(before / after), with weak priors
  std::string text;      ///< the line or control and its benefit, in one line

  double duration() const { return is_line ? line.duration() : 0.0; }  ///< seconds
};

/// What a block determines, the causes of weak determination, and advice.
struct ObservabilityReport {
  std::string facts;
  double other_errors = 0.0;  ///< metres: std of a point on the ground, by the trajectory
  std::vector<ParameterDirection> directions;  ///< weakest first
  std::vector<WeakCombination> weak;           ///< weakest first
  std::vector<Advice> advice;                  ///< best first; beneficial advice only

  /// The line with the largest benefit relative to its flying time; null without beneficial lines.
  const Advice* cheapestLine() const;
  /// The report line by line: the two weakest directions with a standard deviation above a
  /// centimetre and above other_errors, and the best six pieces of advice.
  std::vector<std::string> text() const;
};

/// Expected result of a planned flight.
struct FlightPlanResult {
  std::vector<StripGeometry> lines;
  struct Overlap {
    std::string a, b;
    std::size_t areas = 0;  ///< areas in which the two are compared
    double pairs = 0.0;     ///< expected point-to-patch pairs
  };
  std::vector<Overlap> overlaps;
  std::size_t control_points = 0;  ///< control points covered by a line
  /// Standard deviations, correlations, statuses and reasons in the form of a calibration result;
  /// biases are zero, converged states whether all requested parameters are determined.
  CalibrationResult expected;
  ObservabilityReport observability;
};

/** \brief Predicts the standard deviations that a calibration flight will give.
 *
 * Pairs are synthesised in the overlaps of the planned lines and are processed by the same
 * adjustment, shared errors and choice of parameters as measured ones.
 */
class FlightPlan {
 public:
  struct Settings {
    std::vector<SystemParameter> estimate;  ///< empty: all that the plan determines
    NoiseModel noise;
    SharedErrorModel shared_errors;
    SurfaceModel surface;
    double control_sigma = 0.02;     ///< metres
    std::size_t control_points = 0;  ///< distributed over the block
    int threads = 0;
  };
  /// UsageError for a line that cannot be flown, an id that appears twice or an impossible setting.
  FlightPlan(std::vector<StripGeometry> lines, const Settings& settings);

  /// InputError when no two lines overlap and there is no control.
  FlightPlanResult evaluate() const;

 private:
  std::vector<StripGeometry> lines_;
  Settings settings_;
};

}  // namespace pcl_als
