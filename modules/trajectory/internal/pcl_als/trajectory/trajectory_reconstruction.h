// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <deque>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/trajectory/path_evidence.h>

namespace pcl_als {

/// Position of the sensor at a time as it was found from points.
struct PathSample {
  double time = 0.0;                                                  ///< seconds
  Eigen::Vector3d position = Eigen::Vector3d::Zero();                 ///< metres, ground frame
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();                 ///< metres per second
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();           ///< of the position, m^2
  Eigen::Matrix3d velocity_covariance = Eigen::Matrix3d::Identity();  ///< m^2/s^2
};

/// The path of a strip between gaps in its times, and what determined it.
struct ReconstructedPath {
  std::string name;     ///< of the strip, or of strips that were measured at the same times
  TimeRange times;      ///< of its points, seconds
  double points = 0.0;  ///< with a time
  /// Whether positions are determined to kLargestShare of the height above ground, and for which
  /// share of the time; samples are excluded elsewhere.
  bool found = false;
  double determined = 0.0;
  std::string reason;  ///< why it is not found; empty otherwise
  std::vector<PathSample> samples;
  Warnings warnings;  ///< findings and assumptions about the points

  PathEvidence::Counts counts;
  std::size_t rays = 0, rejected = 0;  ///< rays in the adjustment; those of them excluded
  double separation = 0.0;             ///< metres, median of the rays between their returns
  double height = 0.0;                 ///< metres above ground, mean
  /// Standard deviations, metres: of a return across its ray, and of a ray at the sensor apart from
  /// it.
  double across = 0.0, apart = 0.0;
  /// Square root of the power density of the accelerations in plan and height, m/s^2 per sqrt(Hz).
  double agility_plan = 0.0, agility_height = 0.0;

  struct Angles {
    bool used = false;
    bool right_positive = true;             ///< positive recorded angles are to the right of flight
    double scale = 0.0, scale_std = 0.0;    ///< relative error of the recorded angles' tangents
    double offset = 0.0, offset_std = 0.0;  ///< radians, constant
    double roll = 0.0;          ///< radians, standard deviation of their changes with time (roll)
    double noise = 0.0;         ///< radians, of the mean angle of a class in a quarter of a second
    double height_ratio = 0.0;  ///< height from angles alone over that of the path; 0: none
  } angles;

  /// Residuals of rays, in standard deviations of each: RMS over time steps of a tenth of the
  /// strip.
  std::vector<double> residuals;

  /// Root mean squares over time of the standard deviations east, north and up, metres.
  Eigen::Vector3d meanStd() const;
};

/** \brief The path of the sensor over time from the points of strips, without a trajectory.
 *
 * The returns of one pulse lie on a ray through the sensor. With points of standard deviation q
 * across the ray, a separation s and a distance D, the path passes the ray at
 * q sqrt((D / s)^2 + (D / s - 1)^2), so that a tree ten metres high shows the position to some
 * decimetres. Recorded scan angles show the height (tangent of the angle = lateral distance over
 * height) and the position across the course, to about a hundredth of the height; without rays, the
 * position along the course is that of the scan lines, uncertain by an unknown pitch.
 *
 * The path is a cubic B-spline in time per coordinate whose second differences are random (an
 * acceleration that is white noise). Its power, that of the roll in recorded angles, and the
 * standard deviations of rays and angles are variance components, estimated by restricted maximum
 * likelihood (Fellner 1986; Wood and Fasiolo 2017); rays are weighted robustly. The covariance of
 * the positions is that of this adjustment. Time O(points + duration), memory as PathEvidence.
 *
 * Strips that were measured at the same times (tiles with ids of their own, channels) have one
 * path; a strip has several where its times have gaps of more than kGap.
 *
 * What contradicts itself is no path: where rays and recorded scan angles show different heights
 * and the rays alone do not determine the path, where the angles do not fit the positions of the
 * points, or where the sensor would move faster than an aircraft. Of a pass of a few seconds the
 * straight line at constant speed through the rays is the measure: what the path deviates from it
 * by more than an aircraft bends is added to the covariance.
 *
 * The path is that of the origin of the pulses: it includes the lever arm, assumed as in the
 * computation of the points.
 * \code
 * TrajectoryReconstruction reconstruction;
 * const int strip = reconstruction.addStrip("1");
 * reconstruction.add(strip, points, count);
 * for (const ReconstructedPath& path : reconstruction.reconstruct()) ...
 * \endcode
 */
class TrajectoryReconstruction {
 public:
  /// Standard deviation over the height above ground beyond which a position is not determined.
  static constexpr double kLargestShare = 0.1;
  static constexpr double kGap = 4.0;  ///< seconds

  struct Settings {
    double knot_spacing = 0.5;  ///< seconds, > 0
    double interval = 0.1;      ///< seconds between samples, > 0
  };
  TrajectoryReconstruction() = default;
  /// UsageError for intervals that are not positive.
  explicit TrajectoryReconstruction(const Settings& settings);

  int addStrip(const std::string& name);
  /// Points of a strip, in any order. May be called by several threads for different strips.
  void add(int strip, const LidarReturn* points, std::size_t count);
  /// The paths of all strips in order of time, after all points were added; once.
  std::vector<ReconstructedPath> reconstruct();

 private:
  struct Strip {
    std::string name;
    PathEvidence evidence;
    std::vector<std::string> joined;  ///< names of strips with the same times
  };
  void joinSimultaneous();
  bool adjust(const Strip& strip, const TimeRange& span, ReconstructedPath& path) const;
  ReconstructedPath reconstruct(const Strip& strip, const TimeRange& span, bool first) const;

  Settings settings_;
  std::deque<Strip> strips_;
};

}  // namespace pcl_als
