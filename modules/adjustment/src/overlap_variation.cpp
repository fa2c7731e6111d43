// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/adjustment/overlap_variation.h>
#include <pcl_als/common/distributions.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {

double significantMeanSquare(const Eigen::VectorXd& estimate, const Eigen::MatrixXd& covariance,
                             const Eigen::MatrixXd& moments) {
  constexpr double kChance = 0.05;
  const double limit = chiSquaredCritical(kChance, static_cast<double>(estimate.size()));
  const Eigen::MatrixXd inverse = inverseOrEmpty(covariance);
  if (inverse.size() == 0 || !(estimate.dot(inverse * estimate) > limit)) return 0.0;
  return estimate.dot(moments * estimate);
}

void OverlapVariation::add(std::int64_t group, const Eigen::Vector2d& place,
                           double height_difference) {
  groups_.push_back(group);
  places_.push_back(place);
  values_.push_back(height_difference);
}

Eigen::Vector2d OverlapVariation::centre() const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& place : places_) sum += place;
  return sum / static_cast<double>(std::max<std::size_t>(places_.size(), 1));
}

double OverlapVariation::ofOffset() const {
  constexpr double kScale = 100.0;  // metres: rows of size about 1
  const Eigen::Vector2d middle = centre();
  ClusteredRegression plane(3);
  Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const Eigen::Vector2d at = (places_[i] - middle) / kScale;
    plane.add(groups_[i], Eigen::Vector3d(1.0, at.x(), at.y()), values_[i], places_[i]);
    moments += at * at.transpose() / static_cast<double>(values_.size());
  }
  const ClusteredRegression::Result fit = plane.solve(true);
  if (!fit.determined) return 0.0;
  return significantMeanSquare(fit.estimate.tail<2>(), fit.covariance.bottomRightCorner<2, 2>(),
                               moments);
}

Eigen::Vector2d OverlapVariation::ofRotations() const {
  constexpr double kScale = 100.0;
  const Eigen::Vector2d middle = centre();
  ClusteredRegression bent(6);
  // Slopes along x and y of a x^2 + b x y + c y^2: their squares are quadratic forms of a, b, c.
  Eigen::Matrix3d along_x = Eigen::Matrix3d::Zero(), along_y = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const double x = (places_[i].x() - middle.x()) / kScale;
    const double y = (places_[i].y() - middle.y()) / kScale;
    Eigen::VectorXd row(6);
    row << 1.0, x, y, x * x, x * y, y * y;
    bent.add(groups_[i], row, values_[i], places_[i]);
    const Eigen::Vector3d slope_x(2.0 * x, y, 0.0), slope_y(0.0, x, 2.0 * y);
    along_x += slope_x * slope_x.transpose() / static_cast<double>(values_.size());
    along_y += slope_y * slope_y.transpose() / static_cast<double>(values_.size());
  }
  const ClusteredRegression::Result fit = bent.solve(true);
  if (!fit.determined) return Eigen::Vector2d::Zero();
  const Eigen::VectorXd bend = fit.estimate.tail<3>();
  const Eigen::MatrixXd covariance = fit.covariance.bottomRightCorner<3, 3>();
  return Eigen::Vector2d(significantMeanSquare(bend, covariance, along_y),
                         significantMeanSquare(bend, covariance, along_x)) /
         (kScale * kScale);
}

}  // namespace pcl_als
