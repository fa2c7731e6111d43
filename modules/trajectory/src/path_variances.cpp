// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <pcl_als/adjustment/robust_weight.h>
#include <pcl_als/common/statistics.h>

#include "path_adjustment.h"
#include "path_constants.h"

namespace pcl_als::detail {
namespace {

/// A step of Fellner's iteration for the variance of a random effect: \a squares of the estimates,
/// their \a uncertainty (sum of the variances given the data), \a rank. It is limited to a factor
/// of ten.
double fellnerStep(double variance, double squares, double uncertainty, double rank) {
  constexpr double kFactor = 10.0, kLeastShare = 1e-6;
  const double effective = std::max(rank - uncertainty / variance, kLeastShare * rank);
  return std::clamp(squares / effective, variance / kFactor, variance * kFactor);
}

}  // namespace

/// Residuals, variances and robust weights. At the start the scale is that of the median residual,
/// and weights decrease from there on as for the least sum of absolute values.
void PathAdjustment::weighRays(bool start) {
  if (rays_.empty()) return;
  std::vector<double> scaled;
  for (AdjustedRay& ray : rays_) {
    const Eigen::Vector3d to_path = valueAt(ray.at) - ray.lower;
    const double along = ray.direction.dot(to_path);
    ray.distance = std::max(along, 1.001 * ray.separation);
    ray.residual = (to_path - along * ray.direction).norm();
    scaled.push_back(ray.residual / std::sqrt(ray.leverage()));
  }
  if (start) {
    const double scale = medianInPlace(scaled) / kNormMedian;
    across_ = std::max(scale * scale, kLeastAcross * kLeastAcross);
    apart_ = 0.0;
  }
  for (AdjustedRay& ray : rays_) {
    ray.variance = across_ * ray.leverage() + apart_;
    const double size = ray.residual / std::sqrt(ray.variance);
    if (start) {
      ray.weight = 1.0 / std::max(1.0, size);
    } else {
      ray.weight = size > kNormRejection ? 0.0 : huberWeight(size, 1.0, kNormHuber);
    }
  }
}

/// The squares of the residuals are fitted by two variances, one that grows with the distance of
/// the sensor over the separation of the returns and one that does not.
void PathAdjustment::updateRayVariances() {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double weights = 0.0;
  for (const AdjustedRay& ray : rays_) {
    if (!(ray.weight > 0.0)) continue;
    const Eigen::Vector2d row(ray.leverage(), 1.0);
    const double w = ray.weight / (ray.variance * ray.variance);
    normal += w * row * row.transpose();
    right += w * row * (0.5 * ray.residual * ray.residual);
    weights += ray.weight;
  }
  if (!(weights > 0.0)) return;
  const double determinant = normal.determinant();
  Eigen::Vector2d found(right[0] / normal(0, 0), 0.0);
  if (determinant > 1e-6 * normal(0, 0) * normal(1, 1)) {
    const Eigen::Vector2d both((normal(1, 1) * right[0] - normal(0, 1) * right[1]) / determinant,
                               (normal(0, 0) * right[1] - normal(0, 1) * right[0]) / determinant);
    if (both[1] > 0.0) found = both[0] > 0.0 ? both : Eigen::Vector2d(0.0, right[1] / normal(1, 1));
  }
  const double free = std::max(2.0 * weights - effectiveUnknowns(), 0.2 * weights);
  found *= 2.0 * weights / free;
  across_ = (weights * found[0] + kPriorRays * kAcross * kAcross) / (weights + kPriorRays);
  if (weights > kManyRays) across_ = found[0];
  across_ = std::max(across_, kLeastAcross * kLeastAcross);
  apart_ = found[1];
}

double PathAdjustment::secondDifferences(int coordinate, double& uncertainty) const {
  constexpr std::array<double, 3> kDifference = {1.0, -2.0, 1.0};
  double squares = 0.0;
  uncertainty = 0.0;
  for (int knot = 0; knot + 2 < spline_.count(); ++knot) {
    double difference = 0.0;
    for (int a = 0; a < 3; ++a) {
      const int i = kBlock * (knot + a) + coordinate;
      const double da = kDifference[static_cast<std::size_t>(a)];
      difference += da * coefficients_[i];
      for (int b = 0; b < 3; ++b)
        uncertainty += da * kDifference[static_cast<std::size_t>(b)] *
                       normal_.covariance(i, kBlock * (knot + b) + coordinate);
    }
    squares += difference * difference;
  }
  return squares;
}

/// Unknowns of the path that the observations determine, in the sense of the trace of the
/// projection.
double PathAdjustment::effectiveUnknowns() const {
  double effective = 3.0 * spline_.count();
  for (int c = 0; c < 3; ++c) {
    double uncertainty = 0.0;
    secondDifferences(c, uncertainty);
    effective -= uncertainty / (c < 2 ? plan_ : height_);
  }
  return std::max(0.0, effective);
}

void PathAdjustment::updateAgility() {
  const double cube = std::pow(spline_.step(), 3.0);
  const double least = kLeastAgility * kLeastAgility * cube,
               most = kMostAgility * kMostAgility * cube;
  const double rank = std::max(1, spline_.count() - 2);
  std::array<double, 3> squares{}, uncertainty{};
  for (int c = 0; c < 3; ++c) {
    const auto k = static_cast<std::size_t>(c);
    squares[k] = secondDifferences(c, uncertainty[k]);
  }
  plan_ = fellnerStep(plan_, squares[0] + squares[1], uncertainty[0] + uncertainty[1], 2.0 * rank);
  height_ = fellnerStep(height_, squares[2], uncertainty[2], rank);
  plan_ = std::clamp(plan_, least, most);
  height_ = std::clamp(height_, least, most);
}

/// Errors that rays of a quarter of a second share are not independent of each other: the squares
/// of the sums of their weighted residuals, which are then larger than the sums of their
/// information.
void PathAdjustment::findInflation() {
  struct Sums {
    Eigen::Vector3d score = Eigen::Vector3d::Zero(), information = score;
  };
  std::map<std::int64_t, Sums> bins;
  for (const AdjustedRay& ray : rays_) {
    if (!(ray.weight > 0.0)) continue;
    const Eigen::Matrix3d across =
        (ray.weight / ray.variance) *
        (Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose());
    Sums& sums = bins[static_cast<std::int64_t>(std::floor(ray.time / kSharedTime))];
    sums.score += across * (ray.lower - valueAt(ray.at));
    sums.information += across.diagonal();
  }
  inflation_.setOnes();
  Eigen::Vector3d squares = Eigen::Vector3d::Zero(), expected = squares;
  for (const auto& entry : bins) {
    squares += entry.second.score.cwiseAbs2();
    expected += entry.second.information;
  }
  const auto count = static_cast<double>(bins.size());
  for (int c = 0; c < 3; ++c) {
    double uncertainty = 0.0;
    secondDifferences(c, uncertainty);
    const double used = spline_.count() - uncertainty / (c < 2 ? plan_ : height_);
    const double free = std::max(count - used, kLeastFree * count);
    if (expected[c] > 0.0 && count > kFewestBins)
      inflation_[c] = std::max(1.0, squares[c] / expected[c] * count / free);
  }
}

/// The variance of the roll's Gauss-Markov process.
void PathAdjustment::updateRoll() {
  const double keep = std::exp(-spline_.step() / kRollTime), inner = 1.0 / (1.0 - keep * keep);
  double squares = 0.0, uncertainty = 0.0;
  const auto element = [&](int i, int j, double value) {
    squares += value * coefficients_[i] * coefficients_[j];
    uncertainty += value * normal_.covariance(i, j);
  };
  for (int knot = 0; knot < spline_.count(); ++knot) {
    const int i = kBlock * knot + 3;
    const bool end = knot == 0 || knot + 1 == spline_.count();
    element(i, i, inner * (end ? 1.0 : 1.0 + keep * keep));
    if (knot > 0) element(i, i - kBlock, -2.0 * inner * keep);
  }
  roll_ = std::clamp(fellnerStep(roll_, squares, uncertainty, spline_.count()),
                     kLeastRoll * kLeastRoll, kMostRoll * kMostRoll);
}

}  // namespace pcl_als::detail
