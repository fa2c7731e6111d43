// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <pcl_als/adjustment/robust_weight.h>

#include "path_adjustment.h"
#include "path_constants.h"
#include "ray_fit.h"

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
  for (AdjustedRay& ray : rays_) scaled.push_back(ray.compareWith(valueAt(ray.at)));
  if (start) {
    across_ = std::pow(acrossOf(std::move(scaled)), 2);
    apart_ = 0.0;
  }
  const RobustWeight robust =
      start ? RobustWeight{1.0, kNoRejection} : RobustWeight{kNormHuber, kNormRejection};
  for (AdjustedRay& ray : rays_) {
    ray.variance = across_ * ray.leverage() + apart_;
    ray.weight = robust(ray.residual, std::sqrt(ray.variance));
  }
}

/// Weights and variance components from the latest solution. \return the largest relative change of
/// a variance of movements
double PathAdjustment::updateVariances() {
  weighRays(false);
  updateRayVariances();
  if (with_angles_) {
    weighAngles();
    updateAngleVariances();
    updateAttitude();
  }
  const Eigen::Vector3d before(plan_, height_, rough_);
  updateAgility();
  updateRoughness();
  const Eigen::Vector3d after(plan_, height_, rough_);
  return (after.cwiseQuotient(before) - Eigen::Vector3d::Ones()).lpNorm<Eigen::Infinity>();
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
  double effective = 0.0;
  for (int c = 0; c < 3; ++c) effective += effectiveUnknowns(c);
  const double free = std::max(2.0 * weights - effective, 0.2 * weights);
  found *= 2.0 * weights / free;
  across_ = (weights * found[0] + kPriorRays * kAcross * kAcross) / (weights + kPriorRays);
  if (weights > kManyRays) across_ = found[0];
  across_ = std::max(across_, kLeastAcross * kLeastAcross);
  apart_ = found[1];
}

PathAdjustment::Effect PathAdjustment::accelerations(int coordinate) const {
  Effect effect;
  for (const Innovation& innovation : innovations_) {
    double value = 0.0;
    for (int a = 0; a < 4; ++a) {
      if (innovation.at(a) == 0.0) continue;
      const int i = kBlock * (innovation.first + a) + coordinate;
      value += innovation.at(a) * coefficients_[i];
      for (int b = 0; b < 4; ++b)
        if (innovation.at(b) != 0.0)
          effect.uncertainty += innovation.at(a) * innovation.at(b) *
                                normal_.covariance(i, kBlock * (innovation.first + b) + coordinate);
    }
    effect.squares += value * value;
  }
  return effect;
}

/// Unknowns of a coordinate that the observations determine, in the sense of the trace of the
/// projection.
double PathAdjustment::effectiveUnknowns(int coordinate) const {
  return 2.0 * spline_.count() -
         accelerations(coordinate).uncertainty / (coordinate < 2 ? plan_ : height_) -
         processOf(kRoughOf + coordinate, kRoughTime).uncertainty / rough_;
}

void PathAdjustment::updateAgility() {
  const double least = kLeastAgility * kLeastAgility * perDensity(),
               most = kMostAgility * kMostAgility * perDensity();
  const double rank = std::max(1, spline_.count() - 2);
  const Effect east = accelerations(0), north = accelerations(1), up = accelerations(2);
  plan_ = fellnerStep(plan_, east.squares + north.squares, east.uncertainty + north.uncertainty,
                      2.0 * rank);
  height_ = fellnerStep(height_, up.squares, up.uncertainty, rank);
  plan_ = std::clamp(plan_, least, most);
  height_ = std::clamp(height_, least, most);
}

/// Few or imprecise rays leave it at what is usual for the errors of a delivered trajectory.
void PathAdjustment::updateRoughness() {
  double squares = kPriorRough * kRough * kRough, uncertainty = 0.0;
  for (int c = 0; c < 3; ++c) {
    const Effect effect = processOf(kRoughOf + c, kRoughTime);
    squares += effect.squares;
    uncertainty += effect.uncertainty;
  }
  rough_ =
      std::clamp(fellnerStep(rough_, squares, uncertainty, kPriorRough + 3.0 * spline_.count()),
                 kLeastRough * kLeastRough, kMostRough * kMostRough);
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
    const Eigen::Matrix3d across = ray.information();
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
    const double free = std::max(count - effectiveUnknowns(c), kLeastFree * count);
    if (expected[c] > 0.0 && count > kFewestBins)
      inflation_[c] = std::max(1.0, squares[c] / expected[c] * count / free);
  }
}

/// What the rays of a tenth of a second have in common.
struct PathAdjustment::SharedRays {
  Eigen::Vector3d score = Eigen::Vector3d::Zero();
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d path = Eigen::Matrix3d::Zero();  ///< covariance
  double own_scores = 0.0, own_information = 0.0;  ///< of each ray by itself

  void add(const Eigen::Matrix3d& across, const Eigen::Vector3d& residual) {
    score += across * residual;
    information += across;
    own_scores += (across * residual).squaredNorm() + (across * path * across).trace();
    own_information += across.squaredNorm();
  }
  /// Products of the residuals of two rays, without the noise of both and with that of the path;
  /// and what a variance of one would add to them.
  double products() const {
    return score.squaredNorm() + (information * path * information).trace() - own_scores;
  }
  double pairs() const { return information.squaredNorm() - own_information; }
};

/// The part of a rough movement that is faster than the knots: its spectrum beyond the frequency pi
/// / step, of which the estimated variance contains as much again. Or, if it is more, what rays of
/// a short time have significantly in common beside the uncertainty of the path.
void PathAdjustment::findJitter() {
  std::map<std::int64_t, SharedRays> bins;
  for (const AdjustedRay& ray : rays_) {
    if (!(ray.weight > 0.0)) continue;
    const auto [bin, fresh] =
        bins.try_emplace(static_cast<std::int64_t>(std::floor(ray.time / kJitterTime)));
    if (fresh) bin->second.path = covarianceAt(ray.at.first, ray.at.value);
    bin->second.add(ray.information(), ray.lower - valueAt(ray.at));
  }
  double common = 0.0;
  for (int i = 0; i < kJitterSteps; ++i) {
    double products = 0.0, expected = 0.0, variance = 0.0;
    for (const auto& entry : bins) {
      const SharedRays& rays = entry.second;
      const double scaled = 1.0 / (1.0 + 0.5 * common * rays.information.trace());
      const double share = scaled * scaled;
      products += share * rays.products();
      expected += share * rays.pairs();
      variance += share * share * 2.0 * rays.pairs();  // of the products, without such movements
    }
    const bool significant = products > kSignificant * std::sqrt(variance);
    common = significant ? products / expected : 0.0;
    if (!significant) break;
  }
  jitter_ = std::max(common, rough_ / kRoughTime * spline_.step() / (kPi * kPi));
}

/// A Gauss-Markov process, for a variance of one.
PathAdjustment::Effect PathAdjustment::processOf(int unknown, double time) const {
  const double keep = std::exp(-spline_.step() / time), inner = 1.0 / (1.0 - keep * keep);
  Effect effect;
  const auto element = [&](int i, int j, double value) {
    effect.squares += value * coefficients_[i] * coefficients_[j];
    effect.uncertainty += value * normal_.covariance(i, j);
  };
  for (int knot = 0; knot < spline_.count(); ++knot) {
    const int i = kBlock * knot + unknown;
    const bool end = knot == 0 || knot + 1 == spline_.count();
    element(i, i, inner * (end ? 1.0 : 1.0 + keep * keep));
    if (knot > 0) element(i, i - kBlock, -2.0 * inner * keep);
  }
  return effect;
}

/// Without rays, movements along the course cannot be told from those of the pitch.
void PathAdjustment::updateAttitude() {
  const auto update = [this](int unknown, double variance, double least) {
    const Effect effect = processOf(unknown, kAttitudeTime);
    return std::clamp(fellnerStep(variance, effect.squares, effect.uncertainty, spline_.count()),
                      least * least, kMostAttitude * kMostAttitude);
  };
  roll_ = update(kRollOf, roll_, kLeastRoll);
  if (!rays_.empty()) pitch_ = update(kPitchOf, pitch_, kLeastPitch);
}

}  // namespace pcl_als::detail
