// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include <pcl_als/registration/rigid_motion.h>

namespace pcl_als {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d turn(double angle, const Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// Angles of R = Rx Ry Rz: its first row is (cf ck, -cf sk, sf), its last column (sf, -sw cf, cw
/// cf).
Vector3d anglesOf(const Matrix3d& r) {
  return {std::atan2(-r(1, 2), r(2, 2)), std::asin(std::clamp(r(0, 2), -1.0, 1.0)),
          std::atan2(-r(0, 1), r(0, 0))};
}

}  // namespace

Matrix3d RigidMotion::rotationMatrix() const {
  return turn(rotation.x(), Vector3d::UnitX()) * turn(rotation.y(), Vector3d::UnitY()) *
         turn(rotation.z(), Vector3d::UnitZ());
}

Vector3d RigidMotion::apply(const Vector3d& source) const {
  return centroid + shift + scale * (rotationMatrix() * (source - centroid));
}

RigidMotion RigidMotion::inverse() const {
  return {centroid + shift, -shift, anglesOf(rotationMatrix().transpose()), 1.0 / scale};
}

Eigen::Affine3d RigidMotion::transformation(const Vector3d& source_origin,
                                            const Vector3d& target_origin) const {
  Eigen::Affine3d result = Eigen::Affine3d::Identity();
  result.linear() = scale * rotationMatrix();
  result.translation() =
      (centroid - target_origin) + shift - result.linear() * (centroid - source_origin);
  return result;
}

RigidMotion RigidMotion::about(const Vector3d& centroid, const Eigen::Affine3d& transformation) {
  RigidMotion motion;
  motion.centroid = centroid;
  motion.shift = transformation * centroid - centroid;
  motion.scale = std::cbrt(transformation.linear().determinant());
  motion.rotation = anglesOf(transformation.linear() / motion.scale);
  return motion;
}

Matrix3d RigidMotion::anglesFromTurn() const {
  // theta = ex domega + Rx ey dphi + Rx Ry ez dkappa.
  const Matrix3d rx = turn(rotation.x(), Vector3d::UnitX());
  const Matrix3d ry = turn(rotation.y(), Vector3d::UnitY());
  Matrix3d turn_from_angles;
  turn_from_angles << Vector3d::UnitX(), rx.col(1), (rx * ry).col(2);
  return turn_from_angles.inverse();
}

}  // namespace pcl_als
