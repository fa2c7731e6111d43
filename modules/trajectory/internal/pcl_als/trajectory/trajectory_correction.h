// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/trajectory/system_correction.h>

namespace pcl_als {

/// Samples of a trajectory corrected by a calibration.
struct CorrectedTrajectory {
  std::vector<TrajectorySample> samples;
  /// Variances of their positions due to those of the lever arm, east, north, up, m^2.
  std::vector<Eigen::Vector3d> lever_arm_variance;
  /// With strip corrections: a posteriori standard deviations of the samples, which include those
  /// of the lever arm: east, north, up (m); pitch, roll, heading (rad). NaN at times of which the
  /// calibration states none.
  std::vector<Eigen::Vector3d> position_std, angles_std;
  std::string flight_remark;  ///< SystemCorrection::flightRemark()
  std::size_t excluded = 0;   ///< samples that the flight does not cover
  /// Strip corrections hold angles, and the samples have no attitude that they could be applied to.
  bool angles_excluded = false;
};

/** \brief Corrects the samples of a trajectory by a calibration.
 *
 * With the lever arm bias l, the boresight B(b), the errors of the trajectory s (position) and a
 * (angles, TrajectoryErrors), the offset o of the block (blockOffset()), and the rotation R and
 * position X_0 of a sample, Habib et al. 2011, Eq. (1) gives
 *
 *   X_0' = X_0 - s - o - R l,   R' = R B(b + a)^T B(b).
 *
 * A point measured in the direction v of the body frame, with the assumed lever arm, lies at
 * X_0' + R' (l + f(B(b)^T (v - l))), where f removes range bias and scan angle scale: the position
 * that SystemCorrection gives. Boresight, range bias and scan angle scale are parameters of the
 * scanner, not of the trajectory; software that computes points from a trajectory keeps its lever
 * arm and is given the other biases.
 *
 * Frames: ground east, north, up (metres); body right, forward, up. R is that of the model of the
 * calibration; R' uses the attitude of the samples where they have one.
 *
 * \param flight as delivered, made of the same samples
 * \param options of SystemCorrection; Options::invert is not used. Errors as for its constructor
 */
CorrectedTrajectory correctTrajectory(const std::vector<TrajectorySample>& samples,
                                      const CalibrationResult& calibration,
                                      std::shared_ptr<const Trajectory> flight,
                                      const SystemCorrection::Options& options);

}  // namespace pcl_als
