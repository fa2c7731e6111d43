// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/adjustment/banded_normal.h>
#include <pcl_als/adjustment/cubic_spline.h>
#include <pcl_als/trajectory/path_evidence.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

#include "sensor_ray.h"

namespace pcl_als::detail {

/// The ray of a pulse in the adjustment.
struct AdjustedRay : SensorRay {
  UniformCubicSpline::Weights at;
  double variance = 1.0;  ///< m^2, of each component of its distance from the path
  double weight = 1.0;    ///< robust; 0: rejected

  /// Of its distance from the path, 1/m^2.
  Eigen::Matrix3d information() const { return (weight / variance) * across(); }
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
};

/// The mean of the points of a second: ahead of the sensor by the pitch, where they
/// were measured on both sides of it.
struct AdjustedMiddle {
  UniformCubicSpline::Weights at;
  std::int64_t window = 0;
  double points = 0.0, time = 0.0;                       ///< number; seconds, sum
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();        ///< metres, local
  Eigen::Vector2d covariance = Eigen::Vector2d::Zero();  ///< of place and height, m^2
  double tangent = 0.0;                                  ///< mean of the recorded angles
  bool nadir = false;                                    ///< the points reach the vertical
  double weight = 1.0, residual = 0.0;                   ///< as AdjustedAngle
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
  /// Share of the rays that miss the path.
  double missingShare() const;
  /// Recorded angles against those of the path: rad, of the mean of a class.
  double angleNoise() const { return std::sqrt(noise_); }

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
  struct SharedRays;
  /// Sum of the squares of a random effect, and its expectation given the data.
  struct Effect {
    double squares = 0.0, uncertainty = 0.0;
  };
  /// A sum of four coefficients of a coordinate that is random: what is new in its acceleration.
  struct Innovation {
    int first = 0;
    std::array<double, 4> factors{};
    double at(int i) const { return factors[static_cast<std::size_t>(i)]; }
  };
  void makeInnovations();
  double perDensity() const;
  /// Unknowns of a knot: east, north, up of the smooth path (m), roll and pitch (rad), and what a
  /// rough movement adds to east, north and up (m).
  static constexpr int kBlock = 8;
  static constexpr int kRollOf = 3, kPitchOf = 4, kRoughOf = 5;
  static constexpr std::array<int, 2> kParts = {0, kRoughOf};  ///< whose sum is the path
  static constexpr int kCommon = 4;  ///< scale, offset, truncation of recorded angles; pitch

  void takeRays();
  void takeAngles();
  void addToMiddle(std::int64_t index, const PathEvidence::Bin& bin);
  void finishMiddles();
  bool start();
  bool estimate();
  bool solve();
  void addRays();
  void addAngles();
  void addPrior();
  /// Adds the observation `sum of row = value` of a variance: the row of the path (by coordinate
  /// of kBlock, times the spline's weights) and of the common unknowns.
  void addObservation(const UniformCubicSpline::Weights& at,
                      const Eigen::Matrix<double, kBlock, 1>& row,
                      const Eigen::Matrix<double, kCommon, 1>& common, double value,
                      double information);

  void weighRays(bool start);
  void weighAngles();
  double updateVariances();
  void updateRayVariances();
  void updateAngleVariances();
  void updateAgility();
  void addProcess(int unknown, double variance, double time);
  Effect processOf(int unknown, double time) const;
  void updateRoughness();
  void updateAttitude();
  void findInflation();
  void findJitter();
  /// Innovations of a coordinate.
  Effect accelerations(int coordinate) const;
  double effectiveUnknowns(int coordinate) const;

  /// Of the sum of four coefficients times \a factors, as adjusted.
  Eigen::Matrix3d covarianceAt(int first, const std::array<double, 4>& factors) const;
  Eigen::Vector3d valueAt(const UniformCubicSpline::Weights& at, bool slope = false) const;
  double angleAt(const UniformCubicSpline::Weights& at, int unknown) const;
  /// Unit vector of the course; that of the points before there is a path.
  Eigen::Vector2d courseAt(const UniformCubicSpline::Weights& at) const;
  bool startFromAngles();
  void allowForSkew();
  /// The observation of a class: row . (path, roll) + common . unknowns = value, metres.
  struct AngleRow {
    Eigen::Matrix<double, kBlock, 1> path;
    Eigen::Matrix<double, kCommon, 1> common;
    void setPath(const Eigen::Vector3d& position, double roll, double pitch) {
      path << position, roll, pitch, position;
    }
    double value = 0.0;  ///< metres
    double metres_per_radian = 1.0;
  };
  AngleRow rowOf(const AdjustedAngle& angle) const;
  AngleRow rowOf(const AdjustedMiddle& middle) const;
  template <typename Angle>
  double residualOf(const Angle& angle, const AngleRow& row) const;
  double heightOver(const UniformCubicSpline::Weights& at, double ground) const;
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
  std::vector<Innovation> innovations_;
  Eigen::VectorXd coefficients_, common_;
  std::vector<AdjustedRay> rays_;
  std::vector<AdjustedAngle> angles_;
  std::vector<AdjustedMiddle> middles_;
  Eigen::Vector2d start_course_{0.0, 0.0};
  /// Factors on the variances east, north and up for errors that neighbouring rays share.
  Eigen::Vector3d inflation_ = Eigen::Vector3d::Ones();
  double jitter_ = 0.0;  ///< m^2, of each coordinate: movements faster than the knots
  bool solved_ = false, with_angles_ = false;
  double sign_ = 1.0;          ///< of recorded angles: positive to the right
  double start_height_ = 0.0;  ///< metres above the points, from angles alone; 0: none
  // Variances: of a return across, of a ray apart from it (m^2); of second differences of the
  // coefficients in plan and height (m^2); of the roll in recorded angles and of the mean angle of
  // a class; of the pitch and of the place along the course that the middle of the swath shows
  // (rad^2).
  double across_, apart_ = 0.0, plan_ = 0.0, height_ = 0.0, roll_, noise_, pitch_, along_, rough_;
  double scale_;  ///< prior standard deviation of the scale of recorded angles
  /// Tangent of the angle between scan lines and the perpendicular of the course.
  double skew_ = 0.0;
};

}  // namespace pcl_als::detail
