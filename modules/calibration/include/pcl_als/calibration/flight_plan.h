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

/** \brief A planned flight line: straight, level, at constant speed, with a vertical scanner.
 *
 * Plan coordinates are metres in any local ground frame (east, north).
 */
struct StripGeometry {
  std::string id;
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< sensor in plan, metres
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double height = 1000.0;                        ///< metres above the mean ground of the block
  double half_angle = 20.0 * kRadiansPerDegree;  ///< radians, half the field of view
  double speed = 60.0;                           ///< metres per second
  double density = 1.0;                          ///< pulses per square metre
  double first_time = 0.0;                       ///< seconds, time of the sensor at \a start

  double length() const { return (end - start).norm(); }  ///< metres
  double duration() const { return length() / speed; }    ///< seconds
  Eigen::Vector2d direction() const { return (end - start) / length(); }
  double course() const;     ///< radians clockwise from grid north, [0, 2 pi)
  double halfSwath() const;  ///< metres, on ground at the mean height
  /// Signed distance of a position from the line in plan, positive to the right of flight, metres.
  double lateral(const Eigen::Vector2d& place) const;
  /// Distance of a position along the line from its start, metres; outside [0, length()] beyond the
  /// ends of the line.
  double along(const Eigen::Vector2d& place) const;
  /// Whether the swath covers a position at the mean height of the ground.
  bool covers(const Eigen::Vector2d& place) const;
  /// Pose of the sensor abeam of a position; height 0 is the mean ground.
  SensorPose poseAbeam(const Eigen::Vector2d& place) const;
  /// Time of emission of the pulses abeam of the sensor, seconds.
  double timeAbeam(const Eigen::Vector2d& place) const { return first_time + along(place) / speed; }
  /// UsageError naming the line if its ends, length, height, field of view, speed or density are
  /// impossible.
  void validate() const;
};

/// Height above the mean ground, metres, and upward unit normal of the ground at a position.
struct SurfacePoint {
  double height = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// Distribution of the slopes of the surfaces on which pairs are formed, radians; aspects are
/// uniformly distributed.
struct SurfaceModel {
  double ground_slope = 5.0 * kRadiansPerDegree;  ///< RMS slope of open ground; 0: a plane
  double steep_slope = 25.0 * kRadiansPerDegree;  ///< slope of roofs, banks
  double steep_share = 0.0625;                    ///< share of steep slopes in the usable surface
  double usable = 0.5;                            ///< share of the points on solid, smooth surfaces
  /// Whether pairs are chosen evenly over slopes and aspects, as in a calibration, so that steep
  /// surfaces have more pairs than their share. False: the shares are those of the pairs.
  bool balanced = true;
  /// Terrain by position (metres), which replaces ground_slope; nothing where it is not known.
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d&)> terrain;

  void validate() const;  ///< UsageError that names an impossible value
};

/// A direction in the space of the parameters and its standard deviation.
struct ParameterDirection {
  /// Unit vector. Each parameter is expressed by its effect on a ground point, so that equal
  /// components have equal effects.
  SystemVector components = SystemVector::Zero();
  double std = 0.0;  ///< along the direction, metres on the ground; infinite without information
  /// "lever_arm_y and boresight_pitch together; they may be wrong by -0.013 m and 35 arcsec (one
  /// standard deviation), each up to 13.1 mm on the ground"
  std::string text;
};

/// Two parameters that the observations cannot separate, or one that they hardly determine.
struct WeakCombination {
  std::vector<SystemParameter> parameters;  ///< one or two, the less certain one first
  double correlation = 0.0;                 ///< of two parameters
  std::string cause;  ///< cause in the geometry of the block; empty if none is known
  std::string text;  ///< "boresight_pitch with lever_arm_y, correlation 0.97: single flying height"
};

/// Advice for a block: an additional line or control field and its effect.
struct Advice {
  std::string what;                      ///< "an opposite line at 540 m over line 3"
  bool is_line = true;                   ///< a line, not control
  StripGeometry line;                    ///< the line
  std::vector<Eigen::Vector2d> control;  ///< positions of the control points, metres
  /// Standard deviations without and with it, internal units; infinite: not determined.
  SystemVector before = SystemVector::Zero();
  SystemVector after = SystemVector::Zero();
  double benefit = 0.0;  ///< sum of ln(before / after), with weak priors
  std::string text;      ///< the line or control and its benefit, in one line

  double duration() const { return is_line ? line.duration() : 0.0; }  ///< seconds
};

/// What a block determines, the causes of weak determination, and advice.
struct ObservabilityReport {
  std::string facts;  ///< flying heights, directions, control and slopes of the block, in one line
  double other_errors = 0.0;  ///< metres: standard deviation of a ground point by the trajectory
  std::vector<ParameterDirection> directions;  ///< weakest first
  std::vector<WeakCombination> weak;           ///< weakest first
  std::vector<Advice> advice;                  ///< only what is beneficial, best first

  /// The line with the largest benefit relative to its flying time; null if no line is beneficial.
  const Advice* cheapestLine() const;
  /// The report line by line: the two weakest directions with a standard deviation above a
  /// centimetre and above other_errors, and the best six pieces of advice.
  std::vector<std::string> text() const;
};

/// Expected result of a planned flight.
struct FlightPlanResult {
  std::vector<StripGeometry> lines;
  struct Overlap {
    std::string a, b;       ///< ids of the two lines
    std::size_t areas = 0;  ///< number of areas in which they are compared
    double pairs = 0.0;     ///< expected number of point-to-patch pairs
  };
  std::vector<Overlap> overlaps;
  std::size_t control_points = 0;  ///< number of control points that a line covers
  /// Standard deviations, correlations, statuses and reasons in the form of a calibration result.
  /// The biases are zero; \a converged states whether all requested parameters are determined.
  CalibrationResult expected;
  ObservabilityReport observability;
};

/** \brief Predicts the standard deviations that a calibration flight will give.
 *
 * Pairs are simulated in the overlaps of the planned lines and are processed by the same
 * adjustment, models of correlated errors and choice of parameters as measured pairs. The method is
 * described on the page of module calibration, What a block determines.
 * \code
 * pcl_als::StripGeometry line;
 * line.id = "1";
 * line.end = {2000.0, 0.0};  // metres, start at (0, 0)
 * pcl_als::StripGeometry back = line;
 * back.id = "2";
 * std::swap(back.start, back.end);
 * pcl_als::FlightPlan::Settings settings;
 * settings.control_points = 5;
 * const auto result = pcl_als::FlightPlan({line, back}, settings).evaluate();
 * use(result.expected[pcl_als::SystemParameter::boresight_roll].std);  // radians
 * \endcode
 */
class FlightPlan {
 public:
  struct Settings {
    std::vector<SystemParameter> estimate;  ///< empty: all that the plan determines
    NoiseModel noise;
    SharedErrorModel shared_errors;
    SurfaceModel surface;
    double control_sigma = 0.02;     ///< metres, standard deviation of the heights of control
    std::size_t control_points = 0;  ///< number of control points, distributed over the block
    int threads = 0;                 ///< 0: all cores
  };
  /// UsageError unless there are 1 to 200 lines, for a line that cannot be flown, a repeated id, or
  /// an impossible setting.
  FlightPlan(std::vector<StripGeometry> lines, const Settings& settings);

  /// The expected result. InputError if no two lines overlap and there is no control.
  FlightPlanResult evaluate() const;

 private:
  std::vector<StripGeometry> lines_;
  Settings settings_;
};

}  // namespace pcl_als
