// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/mounting_convention.h>

namespace pcl_als {

/// Mounting of a scanner in the form of a MountingConvention.
struct Mounting {
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();     ///< in the unit and order of the convention
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();  ///< metres
};

/// M, the rotation from the scanner's coordinates to right, forward, up of the body, and P, the
/// position of the scanner there (metres).
struct MountingFrame {
  Eigen::Matrix3d body_from_scanner = Eigen::Matrix3d::Identity();
  Eigen::Vector3d lever_arm = Eigen::Vector3d::Zero();
};
MountingFrame mountingFrame(const MountingConvention& convention, const Mounting& mounting);

/** \brief The mounting with which a program computes corrected points, from the one with which it
 * computed the points of a calibration.
 *
 * Derivation. The program computes a point of the scanner s (3-vector, metres) at
 *
 *     X = X_0 + R (P + M s),                                                      (a)
 *
 * with position X_0 and rotation R of the body (right, forward, up) and the assumed M, P. The
 * calibration states that this is wrong by the biases: with B = Rz(dkappa) Rx(domega) Ry(dphi) and
 * dP, assumed - true, the corrected point is (corrected() without range bias and scale)
 *
 *     X_c = X_0 + R B' (R' (X - X_0) - dP).                                       (b)
 *
 * Inserting (a) gives X_c = X_0 + R (B' (P - dP) + B' M s), which is (a) with
 *
 *     M_new = B' M,        P_new = B' (P - dP).                                   (c)
 *
 * The correction therefore acts in the axes of the body, however the scanner is mounted: it is
 * multiplied from the left, and a bias of boresight_roll turns a scanner about the flight direction
 * also where its own x axis points to the right or down. With the program's body axes E
 * (bodyFromAxes()) and its matrix A, M = E A, the new matrix is A_new = (E' B' E) A, or A_new = A
 * (E' B E) for a matrix in the opposite direction. The lever arm is turned together with the
 * scanner because the calibration has its rotation about the origin of the body.
 *
 * A range bias and a scale of the scan angle are no part of a mounting. (b) applies them along the
 * line from the body's origin and in the plane across the body; a program applies them along the
 * pulse and in the scanner's own plane. The difference is about range_bias |P| / range.
 */
struct MountingCorrection {
  Mounting before, after;
  Eigen::Matrix3d matrix;  ///< of after, from the scanner to the body's axes of the convention
  /// Of after: the three angles as typed (unit of the convention), then the lever arm (m). Angles
  /// that cannot be told apart (gimbal lock) have NaN.
  Eigen::Matrix<double, 6, 6> covariance;
  double gimbal_sine = 1.0;  ///< of after, gimbalSine()

  /// What subtracting the biases from old angles and lever arm would give, axis by axis.
  Mounting subtracted;
  double subtracted_angle = 0.0;  ///< its rotation against the exact one, radians
  double subtracted_lever = 0.0;  ///< its lever arm against the exact one, metres
  /// Displacement of points where the old lever arm is kept, metres.
  double kept_lever = 0.0;

  double std(int i) const;  ///< of angle 0 to 2 (unit of the convention), lever arm 3 to 5 (m)
};

/** \brief Equation (c) in the form of a convention, with the covariance of the result.
 *
 * \param biases assumed - true (m, rad, 1) \param covariance of them, in these units; that of the
 * result is J covariance J', with J the exact derivatives of (c) and of the angles. UsageError for
 * biases that no sensor has (refusedBias()) and for values that are not finite.
 */
MountingCorrection correctedMounting(const MountingConvention& convention, const Mounting& mounting,
                                     const SystemVector& biases,
                                     const SystemMatrix& covariance = SystemMatrix::Zero());

}  // namespace pcl_als
