// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/trajectory/calibration_covariance.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief Covariance of corrected points: what remains of the errors of parameters, trajectory,
 * range and direction.
 *
 * With the design A of the eight parameters (Habib et al. 2011, Eq. (8)), the effect B = [I, A of
 * the boresight angles] of the six trajectory errors, the joint covariance C of both
 * (CalibrationCovariance), the unit vector u of the pulse and the range r,
 *
 *   [A B] C [A B]' + (s_r^2 + s_f^2) u u' + s_a^2 r^2 (I - u u') + s_p^2 I.
 *
 * s_r, s_a, s_p: range, direction and short-term position (ErrorLevels); s_r is that of the point
 * itself (range_std of a decomposed waveform) where it is known and larger. s_f = footprint r tan
 * theta: on a surface with an angle of incidence theta the place within the footprint that the
 * range belongs to changes the range; without a known surface this term is omitted, and tan theta
 * is at most kSteepest. Error sources (ErrorSource) are taken as known. Without control, the height
 * of the block as a whole is not determined and not part of the covariance.
 *
 * Frames: ground east, north, up. Const functions may be called from several threads.
 */
class PointUncertainty {
 public:
  static constexpr double kSteepest = 3.0;  ///< of tan theta: walls

  /// \param flight with the attitude that the correction uses (SystemCorrection::flight())
  PointUncertainty(const CalibrationResult& calibration, std::shared_ptr<const Trajectory> flight,
                   const CalibrationCovariance::Options& options);

  /// Standard deviations of a point, metres. The horizontal one is that in the plane, the root of
  /// the sum of the variances of east and north (compare RMSE_H of the ASPRS standards), the
  /// vertical one that of the height.
  struct Sigma {
    double horizontal = 0.0, vertical = 0.0;
  };
  static Sigma sigmaOf(const Eigen::Matrix3d& covariance);

  /// Speeds up points in order of time; the result does not depend on it.
  struct Cursor {
    std::size_t sample = 0;
    double cell = -1.0;
    CalibrationCovariance::Matrix covariance;
  };
  /// Covariance of a point (m^2, ground frame); false, with nothing set, where the flight does not
  /// cover its time.
  /// \param time of the flight, seconds
  /// \param point corrected, metres
  /// \param normal of the surface, unit, ground frame; NaN: none known
  /// \param system of a calibration with several (SystemLookup): what is known of its differences
  /// to the first one is added, as if it were independent
  /// \param range_std standard deviation of the point's range, metres; NaN: not known
  bool covarianceAt(double time, const Eigen::Vector3d& point, const Eigen::Vector3d& normal,
                    Cursor& cursor, Eigen::Matrix3d& covariance, std::size_t system = 0,
                    double range_std = std::numeric_limits<double>::quiet_NaN()) const;

 private:
  /// Variances of a system's differences to the first one: parameters, coordinates.
  struct Difference {
    SystemVector parameters;
    Eigen::Vector3d offset;
  };
  std::vector<Difference> differences_;  ///< by system; empty: one system
  std::shared_ptr<const Trajectory> flight_;
  CalibrationCovariance shared_;
};

}  // namespace pcl_als
