// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "plane_pair.h"

#include <cmath>

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

Eigen::Matrix<double, 6, 1> quadraticMonomials(const Eigen::Vector3d& e) {
  Eigen::Matrix<double, 6, 1> monomials;
  monomials << e.x() * e.x(), e.y() * e.y(), e.z() * e.z(), e.x() * e.y(), e.x() * e.z(),
      e.y() * e.z();
  return monomials;
}

namespace {

/// Coefficients of (n1 . e)(n2 . e).
Eigen::Matrix<double, 6, 1> productOf(const std::array<Eigen::Vector3d, 2>& normals) {
  const Eigen::Vector3d &a = normals[0], &b = normals[1];
  Eigen::Matrix<double, 6, 1> product;
  product << a.x() * b.x(), a.y() * b.y(), a.z() * b.z(), a.x() * b.y() + a.y() * b.x(),
      a.x() * b.z() + a.z() * b.x(), a.y() * b.z() + a.z() * b.y();
  return product;
}

}  // namespace

std::optional<std::array<Eigen::Vector3d, 2>> planePairOf(const ScannerDetection::Channel& channel,
                                                          double least_angle, double most_off) {
  const SymmetricEigen<Eigen::Dynamic> form = symmetricEigen(channel.quadratics / channel.pulses);
  const Eigen::VectorXd q = form.vectors.col(0);
  Eigen::Matrix3d matrix;
  matrix << 2.0 * q[0], q[3], q[4], q[3], 2.0 * q[1], q[5], q[4], q[5], 2.0 * q[2];
  const SymmetricEigen<Eigen::Dynamic> axes = symmetricEigen(0.5 * matrix);
  const double negative = axes.values[0], positive = axes.values[2];
  if (!(negative < 0.0) || !(positive > 0.0)) return std::nullopt;
  // n1 n2' + n2 n1' of unit normals has the eigenvalues 1 + c and c - 1, c = n1 . n2.
  const double unit = 0.5 * (positive - negative);
  const Eigen::Vector3d sum = std::sqrt(0.5 * positive / unit) * axes.vectors.col(2);
  const Eigen::Vector3d difference = std::sqrt(-0.5 * negative / unit) * axes.vectors.col(0);
  const std::array<Eigen::Vector3d, 2> normals{(sum + difference).normalized(),
                                               (sum - difference).normalized()};
  if (normals[0].cross(normals[1]).norm() < std::sin(least_angle)) return std::nullopt;
  // Mean squares of the distances from either plane: those of the pulses in the other one.
  const Eigen::Matrix3d products = channel.products / channel.pulses;
  double apart = 0.0, least = HUGE_VAL;
  for (const Eigen::Vector3d& normal : normals) {
    const double square = normal.dot(products * normal);
    apart += square;
    least = std::min(least, square);
  }
  constexpr double kLeastShare = 0.2;
  if (least < kLeastShare * apart) return std::nullopt;
  const Eigen::Matrix<double, 6, 1> product = productOf(normals);
  const double residual = product.dot(channel.quadratics * product) / channel.pulses;
  if (residual > most_off * most_off * apart) return std::nullopt;
  return normals;
}

}  // namespace pcl_als
