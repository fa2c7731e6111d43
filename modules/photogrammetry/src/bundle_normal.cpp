// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "bundle_normal.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als::photogrammetry {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

Eigen::Index at(std::size_t image) {
  return static_cast<Eigen::Index>(6 * image);
}

/// Pseudo-inverse of a small normal matrix: what is not determined has no variance here, and is
/// found in weakest().
MatrixXd inverseOf(const MatrixXd& normal) {
  const Eigen::VectorXd scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  return scale.asDiagonal() * inverseOfSymmetric(scaled) * scale.asDiagonal();
}

/// Changes of omega, phi, kappa (columns) for small rotations about the axes of the ground.
Matrix3d angleRates(const double* angles) {
  const double co = std::cos(angles[0]), so = std::sin(angles[0]);
  const double cp = std::cos(angles[1]), sp = std::sin(angles[1]);
  Matrix3d axes;  // of the rotations by omega, phi and kappa, in the ground frame
  axes.col(0) = Vector3d::UnitX();
  axes.col(1) = Vector3d(0.0, co, so);
  axes.col(2) = Vector3d(sp, -so * cp, co * cp);
  return axes.inverse();
}

/// "rotation about the vertical axis", of the components of the seven of a similarity.
std::string nameOf(const Eigen::VectorXd& direction) {
  Eigen::Index most = 0;
  direction.cwiseAbs().maxCoeff(&most);
  if (direction.head<3>().norm() > 0.7) {
    if (std::abs(direction[2]) > 0.7) return "the height of the block";
    double azimuth = std::atan2(direction[0], direction[1]) / kRadiansPerDegree;
    azimuth -= 180.0 * std::floor(azimuth / 180.0);
    char text[80];
    std::snprintf(text, sizeof text, "the shift of the block along azimuth %.0f degrees", azimuth);
    return text;
  }
  constexpr const char* kNames[] = {"the shift of the block to the east",
                                    "the shift of the block to the north",
                                    "the height of the block",
                                    "the rotation of the block about the east axis",
                                    "the rotation of the block about the north axis",
                                    "the rotation of the block about the vertical axis",
                                    "the scale of the block"};
  return kNames[most];
}

}  // namespace

BundleNormal::BundleNormal(const BundleProblem& problem) : problem_(problem) {
  const auto size = static_cast<Eigen::Index>(6 * problem.images.size());
  reduced_ = MatrixXd::Zero(size, size);
  blocks_.resize(problem.features.size());
  for (const Observation& o : problem.observations) {
    if (!problem.inUse(o)) continue;
    const Observation::Linear linear = problem.linearised(o);
    if (o.image != Observation::kNone)
      reduced_.block<6, 6>(at(o.image), at(o.image)).noalias() +=
          linear.image.transpose() * linear.image;
    if (o.feature == Observation::kNone) continue;
    Block& block = blocks_[o.feature];
    const MatrixXd normal = linear.feature.transpose() * linear.feature;
    block.normal = block.normal.size() == 0 ? normal : MatrixXd(block.normal + normal);
    if (o.image == Observation::kNone) continue;
    const MatrixXd mixed = linear.image.transpose() * linear.feature;
    const auto known = std::find_if(block.mixed.begin(), block.mixed.end(),
                                    [&](const auto& entry) { return entry.first == o.image; });
    if (known != block.mixed.end()) {
      known->second += mixed;
    } else {
      block.mixed.emplace_back(o.image, mixed);
    }
  }
  reduce();
}

void BundleNormal::reduce() {
  for (Block& block : blocks_) {
    if (block.normal.size() == 0) continue;
    block.inverse = inverseOf(block.normal);
    for (const auto& [row, left] : block.mixed) {
      const MatrixXd half = left * block.inverse;
      for (const auto& [column, right] : block.mixed)
        reduced_.block<6, 6>(at(row), at(column)).noalias() -= half * right.transpose();
    }
  }
}

MatrixXd BundleNormal::similarity() const {
  const auto images = static_cast<double>(problem_.images.size());
  Vector3d middle = Vector3d::Zero();
  for (const ImageVector& image : problem_.images) middle += image.head<3>() / images;
  double height = 0.0, used = 0.0;
  for (const Feature& feature : problem_.features) {
    if (!feature.used) continue;
    height += feature.line ? problem_.endsOf(feature).first.z() : feature.unknown[2];
    used += 1.0;
  }
  if (used > 0.0) middle.z() = height / used;
  double radius = 1.0;
  for (const ImageVector& image : problem_.images)
    radius = std::max(radius, (image.head<2>() - middle.head<2>()).norm());
  MatrixXd tangent = MatrixXd::Zero(reduced_.rows(), 7);
  for (std::size_t i = 0; i < problem_.images.size(); ++i) {
    const ImageVector& image = problem_.images[i];
    const Vector3d from = image.head<3>() - middle;
    tangent.block<3, 3>(at(i), 0).setIdentity();
    for (int axis = 0; axis < 3; ++axis)
      tangent.block<3, 1>(at(i), 3 + axis) = Vector3d::Unit(axis).cross(from) / radius;
    tangent.block<3, 3>(at(i) + 3, 3) = angleRates(image.data() + 3) / radius;
    tangent.block<3, 1>(at(i), 6) = from / radius;
  }
  return tangent;
}

BundleNormal::Weakest BundleNormal::weakest() const {
  const MatrixXd tangent = similarity();
  const SymmetricEigen<Eigen::Dynamic> eigen =
      symmetricEigen(tangent.transpose() * reduced_ * tangent);
  const double value = eigen.values[0];
  // Below the rounding of the largest eigenvalue nothing is known of the direction.
  const double least = std::max(value, 1e-13 * eigen.values[6]);
  return {nameOf(eigen.vectors.col(0)), 1.0 / std::sqrt(std::max(least, 1e-300))};
}

bool BundleNormal::invert() {
  const Eigen::VectorXd scale = reduced_.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * reduced_ * scale.asDiagonal();
  const Eigen::LLT<MatrixXd> factor(scaled);
  constexpr double kLeastPivot = 1e-7;  // its square is the rounding of the sums
  if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().minCoeff() < kLeastPivot)
    return false;
  reduced_ = factor.solve(MatrixXd::Identity(scaled.rows(), scaled.cols()));
  reduced_ = scale.asDiagonal() * reduced_ * scale.asDiagonal();
  inverted_ = true;
  return true;
}

Matrix6d BundleNormal::imageCovariance(std::size_t image) const {
  return reduced_.block<6, 6>(at(image), at(image));
}

MatrixXd BundleNormal::crossCovariance(std::size_t image, const Block& block) const {
  MatrixXd sum = MatrixXd::Zero(6, block.inverse.cols());
  for (const auto& [other, mixed] : block.mixed)
    sum.noalias() += reduced_.block<6, 6>(at(image), at(other)) * mixed;
  return -sum * block.inverse;
}

MatrixXd BundleNormal::featureCovariance(std::size_t feature) const {
  const Block& block = blocks_[feature];
  if (!inverted_) return block.inverse;
  MatrixXd sum = MatrixXd::Zero(block.inverse.rows(), block.inverse.cols());
  for (const auto& [image, mixed] : block.mixed)
    sum.noalias() -= mixed.transpose() * crossCovariance(image, block);
  return block.inverse + block.inverse * sum;
}

MatrixXd BundleNormal::adjustedCovariance(const Observation& o,
                                          const Observation::Linear& linear) const {
  MatrixXd covariance = MatrixXd::Zero(o.rows(), o.rows());
  if (o.feature != Observation::kNone)
    covariance += linear.feature * featureCovariance(o.feature) * linear.feature.transpose();
  if (o.image == Observation::kNone || !inverted_) return covariance;
  covariance += linear.image * imageCovariance(o.image) * linear.image.transpose();
  if (o.feature == Observation::kNone) return covariance;
  const MatrixXd cross =
      linear.image * crossCovariance(o.image, blocks_[o.feature]) * linear.feature.transpose();
  return covariance + cross + cross.transpose();
}

BundleNormal::Interior BundleNormal::interiorDerivative(const Observation& o) const {
  const ImageVector& image = problem_.images[o.image];
  const Feature& feature = problem_.features[o.feature];
  const double sigma = problem_.block.measurements[o.measurement].sigma;
  Interior derivative(o.rows(), 3);
  if (!feature.line) {
    const Vector3d p = inImage<double>(image.data(), feature.unknown);
    derivative << p.x() / p.z(), -1.0, 0.0, p.y() / p.z(), 0.0, -1.0;
    return derivative / sigma;
  }
  const auto [start, end] = problem_.endsOf(feature);
  const Vector3d n = planeOf<double>(inImage(image.data(), start), inImage(image.data(), end));
  // The sign of the distance, which differs between the formulations.
  const double distance =
      distanceFromLine(n, problem_.reduced(o.measurement), problem_.block.camera.focal_length);
  const double sign = distance * problem_.linearised(o).residual[0] < 0.0 ? -1.0 : 1.0;
  derivative << -n.z(), -n.x(), -n.y();
  return sign * derivative / (n.head<2>().norm() * sigma);
}

std::pair<Vector3d, Matrix3d> BundleNormal::interior() const {
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 3> with_images =
      Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(reduced_.rows(), 3);
  std::vector<MatrixXd> with_feature(blocks_.size());
  for (const Observation& o : problem_.observations) {
    if (!problem_.inUse(o) || o.measurement == Observation::kNone) continue;
    const Observation::Linear linear = problem_.linearised(o);
    const Interior derivative = interiorDerivative(o);
    normal += derivative.transpose() * derivative;
    right += derivative.transpose() * linear.residual;
    with_images.middleRows<6>(at(o.image)) += linear.image.transpose() * derivative;
    MatrixXd& sum = with_feature[o.feature];
    const MatrixXd part = linear.feature.transpose() * derivative;
    sum = sum.size() == 0 ? part : MatrixXd(sum + part);
  }
  for (std::size_t f = 0; f < blocks_.size(); ++f) {
    if (with_feature[f].size() == 0) continue;
    const MatrixXd half = blocks_[f].inverse * with_feature[f];
    normal -= with_feature[f].transpose() * half;
    for (const auto& [image, mixed] : blocks_[f].mixed)
      with_images.middleRows<6>(at(image)) -= mixed * half;
  }
  normal -= with_images.transpose() * reduced_ * with_images;
  const Matrix3d covariance = normal.inverse();
  return {-covariance * right, covariance};
}

}  // namespace pcl_als::photogrammetry
