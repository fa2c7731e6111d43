// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <pcl_als/common/linear_solvers.h>

#include "adjustment.h"

namespace pcl_als {
namespace {

constexpr int kComponents = VarianceFactors::kCount;
using Vector = Eigen::Matrix<double, kComponents, 1>;
using Matrix = Eigen::Matrix<double, kComponents, kComponents>;

// Range of the logarithms of the components: factors of 1/4096 and 16; 1024 for attitude, whose
// errors differ that much between the grades of inertial systems. Larger position errors would
// absorb heights in another unit.
const double kLowest = -12.0 * std::log(2.0);

// Of each component: position (and the shifts, which come last), roll and pitch, heading.
constexpr int kKinds = 3;

Vector highest() {
  return Vector::NullaryExpr(
      [](Eigen::Index k) { return (k % kKinds == 0 ? 4.0 : 10.0) * std::log(2.0); });
}

VarianceFactors levelsOf(const Vector& logarithms) {
  std::array<double, kComponents> values{};
  for (int k = 0; k < kComponents; ++k)
    values[static_cast<std::size_t>(k)] = std::exp(logarithms[k]);
  return VarianceFactors::of(values);
}

Vector logarithmsOf(const VarianceFactors& levels) {
  Vector logarithms;
  const auto values = levels.values();
  for (int k = 0; k < kComponents; ++k)
    logarithms[k] = std::log(values[static_cast<std::size_t>(k)]);
  return logarithms;
}

/// Restricted likelihood with the prior of the components, as a quadratic function about a point.
struct Objective {
  double value = 0.0;
  Vector gradient = Vector::Zero();
  SymmetricEigen<Eigen::Dynamic> curvature;
};

/// Of which component a component has the most likely logarithm a priori; -1: that of the model.
/// Grades of inertial systems differ in roll, pitch and heading alike, and short lines hardly
/// determine errors of the heading.
int followedBy(int component) {
  return component % kKinds == 2 ? component - 1 : -1;
}

// Largest variance of a logarithm: that of a component that only the prior determines.
constexpr double kMostVariance = 0.5;

/// The most likely logarithm a priori of a component whose variance is expected to be that of the
/// model: the variances of the model are expectations, exp(s^2 / 2) times the most likely ones.
constexpr double kMostLikely = -0.5 * kMostVariance;

/// Difference of a logarithm from its most likely value a priori.
double fromExpected(const Vector& logarithms, int component) {
  const int followed = followedBy(component);
  return logarithms[component] - (followed < 0 ? kMostLikely : logarithms[followed]);
}

/// -2 ln of the prior is 2 ln(1 + x^2) for a difference x: Cauchy of scale 1, so that components
/// may vanish for systems that are far more accurate than their data sheet.
double priorDeviance(const Vector& logarithms) {
  double sum = 0.0;
  for (int k = 0; k < kComponents; ++k)
    sum += 2.0 * std::log1p(std::pow(fromExpected(logarithms, k), 2));
  return sum;
}

/// Adds the derivatives of priorDeviance(); the curvature is that of the parabola that touches it.
void addPrior(const Vector& logarithms, Vector& gradient, Matrix& curvature) {
  for (int k = 0; k < kComponents; ++k) {
    const double x = fromExpected(logarithms, k), weight = 4.0 / (1.0 + x * x);
    gradient[k] += weight * x;
    curvature(k, k) += weight;
    const int followed = followedBy(k);
    if (followed < 0) continue;
    gradient[followed] -= weight * x;
    curvature(followed, followed) += weight;
    curvature(k, followed) -= weight;
    curvature(followed, k) -= weight;
  }
}

/// \param known a value that is already known: a larger one has no derivatives
Objective objectiveAt(const Vector& logarithms, const Adjustment& adjustment,
                      const std::vector<SystemParameter>& estimate,
                      double known = std::numeric_limits<double>::infinity()) {
  constexpr double kLeastCurvature = 0.01;
  const double of_prior = priorDeviance(logarithms);
  const RestrictedLikelihood likelihood =
      adjustment.restrictedLikelihood(levelsOf(logarithms), estimate, known - of_prior);
  Objective objective{likelihood.deviance + of_prior, likelihood.gradient, {}};
  if (std::isfinite(known) && !(objective.value < known)) return objective;
  Matrix curvature = likelihood.information;
  // Second derivatives with respect to the logarithm contain the gradient as well. Without its
  // positive values, a component that is far too large decreases in one step.
  curvature.diagonal() += likelihood.gradient.cwiseMin(0.0);
  addPrior(logarithms, objective.gradient, curvature);
  // A component at a limit that would go beyond it stays there.
  const Vector most = highest();
  for (int k = 0; k < kComponents; ++k) {
    const bool beyond =
        objective.gradient[k] > 0.0 ? logarithms[k] <= kLowest : logarithms[k] >= most[k];
    if (!beyond) continue;
    objective.gradient[k] = 0.0;
    curvature.row(k).setZero();
    curvature.col(k).setZero();
  }
  objective.curvature = symmetricEigen(0.5 * (curvature + curvature.transpose()));
  objective.curvature.values = objective.curvature.values.cwiseMax(kLeastCurvature);
  return objective;
}

/// The step to the minimum of the quadratic function within \a radius.
Vector stepOf(const Objective& at, double radius) {
  const Eigen::VectorXd slope = at.curvature.vectors.transpose() * at.gradient;
  const auto stepWith = [&](double damping) -> Eigen::VectorXd {
    return -(slope.array() / (at.curvature.values.array() + damping)).matrix();
  };
  double low = 0.0, high = slope.norm() / radius;  // this damping is enough
  if (stepWith(0.0).norm() > radius) {
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (stepWith(middle).norm() > radius ? low : high) = middle;
    }
    low = high;
  }
  return at.curvature.vectors * stepWith(low);
}

double predictedChange(const Objective& at, const Vector& step) {
  const Eigen::VectorXd along = at.curvature.vectors.transpose() * step;
  return at.gradient.dot(step) + 0.5 * along.cwiseAbs2().dot(at.curvature.values);
}

/// The expectations of the components, whose logarithms have a normal distribution about the
/// minimum: a factor of exp(s^2 / 2). The most likely variance of an error that few strips show is
/// smaller than the expected one, and so would the standard deviations of parameters be that rest
/// on it.
VarianceFactors expectedLevels(const Vector& minimum, const Objective& at) {
  Vector logarithms = minimum;
  for (int k = 0; k < kComponents; ++k) {
    // The objective is -2 ln of the density.
    const double variance =
        2.0 *
        (at.curvature.vectors.row(k).cwiseAbs2() * at.curvature.values.cwiseInverse()).value();
    logarithms[k] += 0.5 * std::min(kMostVariance, variance);
  }
  return levelsOf(logarithms);
}

}  // namespace

EstimatedLevels estimateLevels(Adjustment& adjustment, const std::vector<SystemParameter>& estimate,
                               const VarianceFactors& start, double tolerance) {
  constexpr double kLargestRadius = 4.0;
  constexpr int kMostEvaluations = 40;
  Vector best = logarithmsOf(start);
  Objective at = objectiveAt(best, adjustment, estimate);
  double radius = kLargestRadius;
  for (int i = 1; i < kMostEvaluations && std::isfinite(at.value); ++i) {
    const Vector next = (best + stepOf(at, radius)).cwiseMax(kLowest).cwiseMin(highest());
    const Vector step = next - best;
    const double predicted = predictedChange(at, step);
    if (predicted > -tolerance) break;
    const Objective there = objectiveAt(next, adjustment, estimate, at.value);
    const double ratio = (there.value - at.value) / predicted;
    if (!(ratio > 0.25)) radius = 0.5 * step.norm();
    if (ratio > 0.75) radius = std::min(kLargestRadius, 2.0 * radius);
    if (!(ratio > 0.0)) continue;
    best = next;
    at = there;
  }
  const EstimatedLevels estimated{levelsOf(best), expectedLevels(best, at)};
  adjustment.setVarianceFactors(estimated.expected);
  return estimated;
}

}  // namespace pcl_als
