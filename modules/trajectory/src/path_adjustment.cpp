// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "path_adjustment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "path_constants.h"

namespace pcl_als::detail {
namespace {

using Weights = UniformCubicSpline::Weights;

/// The times of the path: those of the points, extended to whole samples.
UniformCubicSpline splineOf(const TimeRange& span,
                            const TrajectoryReconstruction::Settings& settings) {
  const double from = std::floor(span.first / settings.interval) * settings.interval;
  const double to = std::ceil(span.last / settings.interval) * settings.interval;
  return {from, std::max(to, from + settings.interval), settings.knot_spacing};
}

}  // namespace

double AdjustedRay::leverage() const {
  const double extended = distance / separation;
  return extended * extended + (extended - 1.0) * (extended - 1.0);
}

PathAdjustment::PathAdjustment(const PathEvidence& evidence, const TimeRange& span,
                               const TrajectoryReconstruction::Settings& settings)
    : evidence_(evidence),
      span_(span),
      origin_(evidence.origin()),
      spline_(splineOf(span, settings)),
      normal_(spline_.count() * kBlock, 4 * kBlock - 1, kCommon),
      across_(kAcross * kAcross),
      roll_(kRoll * kRoll),
      noise_(kAngleNoise * kAngleNoise),
      scale_(kScale) {
  const double cube = std::pow(spline_.step(), 3.0);
  plan_ = height_ = kAgility * kAgility * cube;
  takeRays();
  takeAngles();
}

void PathAdjustment::takeRays() {
  forBins([this](std::int64_t, const PathEvidence::Bin& bin) {
    for (const PulseRay& ray : bin.rays) {
      AdjustedRay& taken = rays_.emplace_back();
      taken.at = spline_.at(ray.time);
      taken.time = ray.time;
      taken.lower = ray.lower - origin_;
      taken.separation = ray.separation();
      taken.direction = ray.span.cast<double>() / taken.separation;
    }
  });
}

Eigen::Vector3d PathAdjustment::valueAt(const Weights& at, bool slope) const {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k) {
    const auto a = static_cast<std::size_t>(k);
    value +=
        (slope ? at.slope[a] : at.value[a]) * coefficients_.segment<3>(kBlock * (at.first + k));
  }
  return value;
}

double PathAdjustment::rollAt(const Weights& at) const {
  double value = 0.0;
  for (int k = 0; k < 4; ++k)
    value += at.value[static_cast<std::size_t>(k)] * coefficients_[kBlock * (at.first + k) + 3];
  return value;
}

void PathAdjustment::addObservation(const Weights& at, const Eigen::Matrix<double, kBlock, 1>& row,
                                    const Eigen::Matrix<double, kCommon, 1>& common, double value,
                                    double information) {
  for (int a = 0; a < 4; ++a) {
    const double wa = information * at.value[static_cast<std::size_t>(a)];
    for (int i = 0; i < kBlock; ++i) {
      if (row[i] == 0.0) continue;
      const int left = kBlock * (at.first + a) + i;
      normal_.addRight(left, wa * row[i] * value);
      for (int c = 0; c < kCommon; ++c) normal_.addBorder(left, c, wa * row[i] * common[c]);
      for (int b = 0; b < 4; ++b) {
        for (int j = 0; j < kBlock; ++j) {
          const int right = kBlock * (at.first + b) + j;
          if (right > left || row[j] == 0.0) continue;
          normal_.add(left, right, wa * row[i] * at.value[static_cast<std::size_t>(b)] * row[j]);
        }
      }
    }
  }
  if (!common.isZero(0.0))
    normal_.addCorner(information * common * common.transpose(), information * value * common);
}

/// The path at the time of a ray is on it: two components across.
void PathAdjustment::addRays() {
  for (const AdjustedRay& ray : rays_) {
    if (!(ray.weight > 0.0)) continue;
    const Eigen::Matrix3d across =
        (ray.weight / ray.variance) *
        (Eigen::Matrix3d::Identity() - ray.direction * ray.direction.transpose());
    const Eigen::Vector3d right = across * ray.lower;
    for (int a = 0; a < 4; ++a) {
      const double wa = ray.at.value[static_cast<std::size_t>(a)];
      const int left = kBlock * (ray.at.first + a);
      for (int i = 0; i < 3; ++i) normal_.addRight(left + i, wa * right[i]);
      for (int b = 0; b <= a; ++b) {
        const double wab = wa * ray.at.value[static_cast<std::size_t>(b)];
        const int top = kBlock * (ray.at.first + b);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            if (top + j <= left + i) normal_.add(left + i, top + j, wab * across(i, j));
      }
    }
  }
}

/// Random second differences of the path, a Gauss-Markov process of the roll, and priors of the
/// common unknowns. A very weak prior of the position makes the equations regular.
void PathAdjustment::addPrior() {
  const int knots = spline_.count();
  constexpr std::array<double, 3> kDifference = {1.0, -2.0, 1.0};
  for (int knot = 0; knot + 2 < knots; ++knot) {
    for (int c = 0; c < 3; ++c) {
      const double information = 1.0 / (c < 2 ? plan_ : height_);
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b <= a; ++b)
          normal_.add(kBlock * (knot + a) + c, kBlock * (knot + b) + c,
                      information * kDifference[static_cast<std::size_t>(a)] *
                          kDifference[static_cast<std::size_t>(b)]);
    }
  }
  const double keep = std::exp(-spline_.step() / kRollTime), information = 1.0 / roll_;
  const double inner = information / (1.0 - keep * keep);
  for (int knot = 0; knot < knots; ++knot) {
    const int i = kBlock * knot + 3;
    const bool end = knot == 0 || knot + 1 == knots;
    normal_.add(i, i, inner * (end ? 1.0 : 1.0 + keep * keep));
    if (knot > 0) normal_.add(i, i - kBlock, -inner * keep);
    for (int c = 0; c < 3; ++c) normal_.add(i - 3 + c, i - 3 + c, kRegular);
  }
  Eigen::Vector4d priors(scale_, kOffset, evidence_.counts().whole_degrees ? kTruncation : 1e-4,
                         kPitch);
  normal_.addCorner(priors.cwiseAbs2().cwiseInverse().asDiagonal().toDenseMatrix(),
                    Eigen::Vector4d::Zero());
}

bool PathAdjustment::solve() {
  normal_.setZero();
  addRays();
  if (with_angles_) addAngles();
  addPrior();
  if (!normal_.solve()) return false;
  coefficients_ = normal_.solution();
  common_ = normal_.commonSolution();
  solved_ = true;
  return true;
}

bool PathAdjustment::adjustRays() {
  with_angles_ = false;
  if (rays_.empty() || !solve()) return false;
  for (int i = 0; i < kRobustSteps; ++i) {
    weighRays(true);
    if (!solve()) return false;
  }
  return estimate();
}

/// Recorded angles must be those of the path from rays, whatever their sign; where they are not, or
/// without such a path, the path from angles alone is the start.
bool PathAdjustment::adjustWithAngles() {
  if (angles_.empty()) return false;
  const bool started = startFromAngles();
  if (started) allowForSkew();
  const double slope = solved_ ? angleSlope() : 0.0;
  if (std::abs(std::abs(slope) - 1.0) < kSlopeTolerance) {
    sign_ = slope > 0.0 ? 1.0 : -1.0;
    with_angles_ = true;
    return solve() && estimate();
  }
  solved_ = false;
  for (AdjustedRay& ray : rays_) ray.weight = 0.0;
  if (!started) return false;
  with_angles_ = true;
  for (int i = 0; i < kRobustSteps; ++i) {
    if (!solve()) return false;
    weighRays(true);
  }
  return solve() && estimate();
}

/// Variance components and robust weights, until nothing changes.
bool PathAdjustment::estimate() {
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::VectorXd before = coefficients_;
    weighRays(false);
    updateRayVariances();
    if (with_angles_) {
      weighAngles();
      updateAngleVariance();
      updateRoll();
    }
    const Eigen::Vector2d agility(plan_, height_);
    updateAgility();
    if (!solve()) return false;
    const double change = (coefficients_ - before).lpNorm<Eigen::Infinity>();
    const double growth =
        (Eigen::Vector2d(plan_, height_).cwiseQuotient(agility) - Eigen::Vector2d::Ones())
            .lpNorm<Eigen::Infinity>();
    if (change < kConverged && growth < kConvergedVariance) break;
  }
  weighRays(false);
  findInflation();
  return true;
}

PathSample PathAdjustment::sampleAt(double time) const {
  const Weights at = spline_.at(time);
  PathSample sample;
  sample.time = time;
  sample.position = origin_ + valueAt(at);
  sample.velocity = valueAt(at, true);
  sample.covariance.setZero();
  sample.velocity_covariance.setZero();
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const double c = normal_.covariance(kBlock * (at.first + static_cast<int>(a)) + i,
                                              kBlock * (at.first + static_cast<int>(b)) + j);
          sample.covariance(i, j) += at.value[a] * at.value[b] * c;
          sample.velocity_covariance(i, j) += at.slope[a] * at.slope[b] * c;
        }
      }
    }
  }
  const Eigen::Vector3d factors = inflation_.cwiseSqrt();
  const Eigen::Matrix3d both = factors * factors.transpose();
  sample.covariance.array() *= both.array();
  sample.velocity_covariance.array() *= both.array();
  return sample;
}

double PathAdjustment::heightAboveGround() const {
  double sum = 0.0, n = 0.0;
  for (const AdjustedRay& ray : rays_) {
    if (!(ray.weight > 0.0)) continue;
    sum += valueAt(ray.at).z() - ray.lower.z();
    n += 1.0;
  }
  if (n > 0.0) return sum / n;
  for (const AdjustedAngle& angle : angles_) {
    sum += valueAt(angle.at).z() - angle.mean.z();
    n += 1.0;
  }
  return n > 0.0 ? sum / n : 0.0;
}

}  // namespace pcl_als::detail
