// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "path_adjustment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <pcl_als/adjustment/robust_iteration.h>

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
      pitch_(kPitchMotion * kPitchMotion),
      along_(kAlongNoise * kAlongNoise),
      rough_(kRough * kRough),
      scale_(kScale) {
  plan_ = height_ = kAgility * kAgility * perDensity();
  makeInnovations();
  takeRays();
  takeAngles();
}

/// The first second difference, which is stationary, and the change of each to the next.
void PathAdjustment::makeInnovations() {
  const double keep = std::exp(-spline_.step() / kAccelerationTime);
  const double start = std::sqrt(1.0 - keep * keep);
  innovations_.push_back({0, {start, -2.0 * start, start, 0.0}});
  for (int knot = 0; knot + 3 < spline_.count(); ++knot)
    innovations_.push_back({knot, {-keep, 1.0 + 2.0 * keep, -2.0 - keep, 1.0}});
}

/// Variance of an innovation for accelerations of a power density of one at low frequencies.
double PathAdjustment::perDensity() const {
  const double change = 1.0 - std::exp(-spline_.step() / kAccelerationTime);
  return std::pow(spline_.step(), 3.0) * change * change;
}

void PathAdjustment::takeRays() {
  forBins([this](std::int64_t, const PathEvidence::Bin& bin) {
    for (const PulseRay& ray : bin.rays)
      rays_.push_back({SensorRay(ray, origin_), spline_.at(ray.time)});
  });
}

Eigen::Vector3d PathAdjustment::valueAt(const Weights& at, bool slope) const {
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k) {
    const auto a = static_cast<std::size_t>(k);
    const double factor = slope ? at.slope[a] : at.value[a];
    for (const int part : kParts)
      value += factor * coefficients_.segment<3>(kBlock * (at.first + k) + part);
  }
  return value;
}

double PathAdjustment::angleAt(const Weights& at, int unknown) const {
  double value = 0.0;
  for (int k = 0; k < 4; ++k)
    value +=
        at.value[static_cast<std::size_t>(k)] * coefficients_[kBlock * (at.first + k) + unknown];
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
  const auto addProduct = [this](int left, int top, const Eigen::Matrix3d& matrix) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (top + j <= left + i) normal_.add(left + i, top + j, matrix(i, j));
  };
  for (const AdjustedRay& ray : rays_) {
    if (!(ray.weight > 0.0)) continue;
    const Eigen::Matrix3d across = ray.information();
    const Eigen::Vector3d right = across * ray.lower;
    for (int a = 0; a < 4; ++a) {
      const double wa = ray.at.value[static_cast<std::size_t>(a)];
      for (const int part : kParts) {
        const int left = kBlock * (ray.at.first + a) + part;
        for (int i = 0; i < 3; ++i) normal_.addRight(left + i, wa * right[i]);
        for (int b = 0; b <= a; ++b)
          for (const int other : kParts)
            addProduct(left, kBlock * (ray.at.first + b) + other,
                       wa * ray.at.value[static_cast<std::size_t>(b)] * across);
      }
    }
  }
}

/// Accelerations that are Gauss-Markov processes, as are processes of roll and pitch, and priors of
/// the common unknowns. A very weak prior of the position makes the equations regular.
void PathAdjustment::addPrior() {
  for (const Innovation& innovation : innovations_) {
    for (int c = 0; c < 3; ++c) {
      const double information = 1.0 / (c < 2 ? plan_ : height_);
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b <= a && innovation.at(a) != 0.0; ++b)
          normal_.add(kBlock * (innovation.first + a) + c, kBlock * (innovation.first + b) + c,
                      information * innovation.at(a) * innovation.at(b));
    }
  }
  for (int knot = 0; knot < spline_.count(); ++knot)
    for (int c = 0; c < 3; ++c) normal_.add(kBlock * knot + c, kBlock * knot + c, kRegular);
  addProcess(kRollOf, roll_, kAttitudeTime);
  addProcess(kPitchOf, pitch_, kAttitudeTime);
  for (int c = 0; c < 3; ++c) addProcess(kRoughOf + c, rough_, kRoughTime);
  Eigen::Vector4d priors(scale_, kOffset, evidence_.counts().whole_degrees ? kTruncation : 1e-4,
                         kPitch);
  normal_.addCorner(priors.cwiseAbs2().cwiseInverse().asDiagonal().toDenseMatrix(),
                    Eigen::Vector4d::Zero());
}

/// A Gauss-Markov process with a correlation time.
void PathAdjustment::addProcess(int unknown, double variance, double time) {
  const double keep = std::exp(-spline_.step() / time);
  const double inner = 1.0 / (variance * (1.0 - keep * keep));
  for (int knot = 0; knot < spline_.count(); ++knot) {
    const int i = kBlock * knot + unknown;
    const bool end = knot == 0 || knot + 1 == spline_.count();
    normal_.add(i, i, inner * (end ? 1.0 : 1.0 + keep * keep));
    if (knot > 0) normal_.add(i, i - kBlock, -inner * keep);
  }
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

/// Robust weights, with the scale of the median residual, until there is a path to start from.
bool PathAdjustment::start() {
  return reweight(
             kRobustSteps + 1, 0.0, [this] { return solve() ? std::optional(1.0) : std::nullopt; },
             [this] { weighRays(true); })
      .solved();
}

bool PathAdjustment::adjustRays() {
  with_angles_ = false;
  return !rays_.empty() && start() && estimate();
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
  return start() && estimate();
}

/// Variance components and robust weights, until nothing changes.
bool PathAdjustment::estimate() {
  double growth = updateVariances();
  const auto solution = [&]() -> std::optional<double> {
    const Eigen::VectorXd before = coefficients_;
    if (!solve()) return std::nullopt;
    const double change = (coefficients_ - before).lpNorm<Eigen::Infinity>();
    return std::max(change / kConverged, growth / kConvergedVariance);
  };
  if (!reweight(kMostSteps, 1.0, solution, [&] { growth = updateVariances(); }).solved())
    return false;
  weighRays(false);
  findInflation();
  findJitter();
  return true;
}

Eigen::Matrix3d PathAdjustment::covarianceAt(int first,
                                             const std::array<double, 4>& factors) const {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  const auto add = [&](double factor, int left, int right) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        covariance(i, j) += factor * normal_.covariance(left + i, right + j);
  };
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b)
      for (const int part : kParts)
        for (const int other : kParts)
          add(factors[static_cast<std::size_t>(a)] * factors[static_cast<std::size_t>(b)],
              kBlock * (first + a) + part, kBlock * (first + b) + other);
  return covariance;
}

PathSample PathAdjustment::sampleAt(double time) const {
  const Weights at = spline_.at(time);
  const Eigen::Vector3d factors = inflation_.cwiseSqrt();
  const Eigen::Matrix3d both = factors * factors.transpose();
  PathSample sample;
  sample.time = time;
  sample.position = origin_ + valueAt(at);
  sample.velocity = valueAt(at, true);
  sample.covariance = covarianceAt(at.first, at.value).cwiseProduct(both);
  sample.covariance.diagonal().array() += jitter_;
  sample.velocity_covariance = covarianceAt(at.first, at.slope).cwiseProduct(both);
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
