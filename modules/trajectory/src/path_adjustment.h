// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/adjustment/banded_normal.h>
#include <pcl_als/adjustment/cubic_spline.h>
#include <pcl_als/trajectory/path_evidence.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

namespace pcl_als::detail {

/// The ray of a pulse in the adjustment.
struct AdjustedRay {
  UniformCubicSpline::Weights at;
  Eigen::Vector3d lower, direction;  ///< metres, local; unit vector, upwards
  double time = 0.0;                 ///< seconds
  double separation = 0.0;           ///< metres, of its returns
  double distance = 1000.0;          ///< metres, from the lower return to the sensor
  double variance = 1.0;             ///< m^2, of each component of its distance from the path
  double weight = 1.0;               ///< robust; 0: rejected
  double residual = 0.0;             ///< metres, distance from the path

  /// Variance at the sensor for a variance of one of either return across the ray.
  double leverage() const;
};

/// The mean of the points of a class of recorded scan angles in a quarter of a second.
struct AdjustedAngle {
  UniformCubicSpline::Weights at;
  double time = 0.0;  ///< seconds, mean
  std::int64_t bin = 0;
  int index = 0;                          ///< of the class
  Eigen::Vector3d mean;                   ///< metres, local
  double tangent = 0.0, tangent_z = 0.0;  ///< means; tangent_z: metres
  double weight = 1.0, residual = 0.0;    ///< robust weight; residual in radians
  bool nadir = false;                     ///< nearest the vertical of its bin
};

/** \brief The adjustment of one strip's path: splines of east, north and up, and of the roll in
 * recorded scan angles, with their variance components.
 */
class PathAdjustment {
 public:
  /// \param span the times of the path, within those of the evidence
  PathAdjustment(const PathEvidence& evidence, const TimeRange& span,
                 const TrajectoryReconstruction::Settings& settings);

  std::size_t rayCount() const { return rays_.size(); }
  bool hasAngles() const { return !angles_.empty(); }

  /// The path from rays alone; false where the equations are singular.
  bool adjustRays();
  /// The path from recorded angles and from rays, if any.
  bool adjustWithAngles();

  PathSample sampleAt(double time) const;
  /// Mean height of the path above the points, metres.
  double heightAboveGround() const;
  /// Counts, variance components and residuals.
  void describe(ReconstructedPath& path) const;

 private:
  static constexpr int kBlock = 4;   ///< unknowns of a knot: east, north, up (m), roll (rad)
  static constexpr int kCommon = 4;  ///< scale, offset, truncation of recorded angles; pitch

  void takeRays();
  void takeAngles();
  bool estimate();
  bool solve();
  void addRays();
  void addAngles();
  void addAlong(const AdjustedAngle& angle);
  void addPrior();
  /// Adds the observation `sum of row = value` of a variance: the row of the path (by coordinate
  /// of kBlock, times the spline's weights) and of the common unknowns.
  void addObservation(const UniformCubicSpline::Weights& at,
                      const Eigen::Matrix<double, kBlock, 1>& row,
                      const Eigen::Matrix<double, kCommon, 1>& common, double value,
                      double information);

  void weighRays(bool start);
  void weighAngles();
  void updateRayVariances();
  void updateAngleVariance();
  void updateAgility();
  void updateRoll();
  void findInflation();
  /// Sum of squares of a coordinate's second differences, and its expectation given the data.
  double secondDifferences(int coordinate, double& uncertainty) const;
  double effectiveUnknowns() const;

  Eigen::Vector3d valueAt(const UniformCubicSpline::Weights& at, bool slope = false) const;
  double rollAt(const UniformCubicSpline::Weights& at) const;
  /// Unit vector of the course; that of the points before there is a path.
  Eigen::Vector2d courseAt(const UniformCubicSpline::Weights& at) const;
  bool startFromAngles();
  void allowForSkew();
  /// The observation of a class: row . (path, roll) + common . unknowns = value, metres.
  struct AngleRow {
    Eigen::Matrix<double, kBlock, 1> path;
    Eigen::Matrix<double, kCommon, 1> common;
    double value = 0.0, metres_per_radian = 1.0;
  };
  AngleRow rowOf(const AdjustedAngle& angle) const;
  double heightOf(const AdjustedAngle& angle) const;
  double angleSlope() const;

  /// Calls \a take with the index and the evidence of each quarter of a second of the path.
  template <typename Take>
  void forBins(const Take& take) const {
    for (const auto& entry : evidence_.bins())
      if (entry.second.first <= span_.last && entry.second.last >= span_.first)
        take(entry.first, entry.second);
  }

  const PathEvidence& evidence_;
  TimeRange span_;
  Eigen::Vector3d origin_;
  UniformCubicSpline spline_;
  BandedNormal normal_;
  Eigen::VectorXd coefficients_, common_;
  std::vector<AdjustedRay> rays_;
  std::vector<AdjustedAngle> angles_;
  Eigen::Vector2d start_course_{0.0, 0.0};
  /// Factors on the variances east, north and up for errors that neighbouring rays share.
  Eigen::Vector3d inflation_ = Eigen::Vector3d::Ones();
  bool solved_ = false, with_angles_ = false;
  double sign_ = 1.0;          ///< of recorded angles: positive to the right
  double start_height_ = 0.0;  ///< metres above the points, from angles alone; 0: none
  // Variances: of a return across, of a ray apart from it (m^2); of second differences of the
  // coefficients in plan and height (m^2); of the roll in recorded angles and of the mean angle of
  // a class (rad^2).
  double across_, apart_ = 0.0, plan_ = 0.0, height_ = 0.0, roll_, noise_;
  double scale_;  ///< prior standard deviation of the scale of recorded angles
  double skew_cosine_ =
      1.0;  ///< of the angle between scan lines and the perpendicular of the course
};

}  // namespace pcl_als::detail
