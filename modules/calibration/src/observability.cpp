// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "observability.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <limits>
#include <sstream>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "parameter_choice.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

constexpr double kNamed = 0.3;  // component of a unit vector above which a parameter is named
constexpr double kHighCorrelation =
    0.85;  // correlation above which two parameters can hardly be separated
constexpr double kLargestEffect = 1e3;  // metres on the ground: an upper bound of any parameter
// metres: parameters with a larger standard deviation are not observed
constexpr double kNotObserved = 100.0;

std::string name(P p) {
  return std::string(infoOf(p).name);
}

/// Cause of a pair of parameters with the same effect on a ground point at one height.
P twinOf(P p) {
  switch (p) {
    case P::boresight_pitch:
      return P::lever_arm_y;
    case P::lever_arm_y:
      return P::boresight_pitch;
    case P::boresight_roll:
      return P::lever_arm_x;
    case P::range_bias:
      return P::lever_arm_z;
    case P::lever_arm_z:
      return P::range_bias;
    default:
      return p;
  }
}

std::string listed(const std::vector<std::string>& texts) {
  std::string list;
  for (std::size_t i = 0; i < texts.size(); ++i)
    list += (i == 0 ? "" : i + 1 < texts.size() ? ", " : " and ") + texts[i];
  return list;
}

/// A sentence for a surveyor, with the parameters in their units.
std::string describe(const SystemVector& components, double std, const SystemVector& effect) {
  std::vector<int> order;
  for (int i = 0; i < kSystemParameterCount; ++i) {
    if (std::abs(components[i]) >= kNamed) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(-std::abs(components[a]), a) < std::pair(-std::abs(components[b]), b);
  });
  if (order.empty()) return "not observed";
  const bool several = order.size() > 1;
  std::vector<std::string> names, sizes;
  for (const int i : order) {
    const SystemParameterInfo& info = systemParameters()[static_cast<std::size_t>(i)];
    names.emplace_back(info.name);
    if (std::isfinite(std))
      sizes.push_back(inUnit(info.parameter, components[i] * std / effect[i]));
  }
  const std::string subject = listed(names) + (several ? " together" : "");
  if (std::isinf(std))
    return subject + (several ? ", not observed apart from each other" : ", not observed");
  char moved[80];
  std::snprintf(moved, sizeof moved, "%.1f mm on the ground",
                1000.0 * std * std::abs(components[order.front()]));
  return subject + (several ? "; they" : "; it") + " may be wrong by " + listed(sizes) +
         " (one standard deviation), " + (several ? "each up to " : "") + moved;
}

}  // namespace

Observability::Observability(const SystemMatrix& normal, const std::vector<P>& wanted,
                             const SystemVector& effect)
    : normal_(normal), wanted_(wanted), effect_(effect) {}

SystemVector Observability::groundEffect(double height, double half_angle) {
  ScanGeometry geometry;
  geometry.x = height * std::tan(half_angle);
  geometry.z = -height;
  geometry.beta = -half_angle;
  return designBlock(geometry).colwise().norm().transpose();
}

void Observability::weaken(const SystemVector& factor) {
  const SystemVector inverse = factor.cwiseInverse();
  normal_ = (inverse.asDiagonal() * normal_ * inverse.asDiagonal()).eval();
}

Eigen::MatrixXd Observability::scaledNormal() const {
  const auto size = static_cast<Eigen::Index>(wanted_.size());
  Eigen::MatrixXd scaled(size, size);
  for (Eigen::Index r = 0; r < size; ++r) {
    const int i = indexOf(wanted_[static_cast<std::size_t>(r)]);
    for (Eigen::Index c = 0; c < size; ++c) {
      const int j = indexOf(wanted_[static_cast<std::size_t>(c)]);
      scaled(r, c) = normal_(i, j) / (effect_[i] * effect_[j]);
    }
  }
  return scaled;
}

std::vector<ParameterDirection> Observability::directions() const {
  std::vector<ParameterDirection> directions;
  // A matrix that is not finite (overflow of weights) has no directions.
  if (wanted_.empty() || !scaledNormal().allFinite()) return directions;
  const auto eigen = symmetricEigen(scaledNormal());
  for (Eigen::Index k = 0; k < eigen.values.size(); ++k) {
    ParameterDirection direction;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      direction.components[indexOf(wanted_[i])] = eigen.vectors(static_cast<Eigen::Index>(i), k);
    }
    const double value = eigen.values[k];
    const bool observed =
        value > 1.0 / (kNotObserved * kNotObserved) && value > 1e-14 * eigen.values.maxCoeff();
    direction.std = observed ? 1.0 / std::sqrt(value) : std::numeric_limits<double>::infinity();
    direction.text = describe(direction.components, direction.std, effect_);
    directions.push_back(std::move(direction));
  }
  return directions;
}

WeakCombination Observability::single(std::size_t index, double std,
                                      const BlockFacts& facts) const {
  WeakCombination weak;
  const P p = wanted_[index];
  weak.parameters = {p};
  weak.cause = facts.causeOf(weak.parameters);
  weak.text = name(p) + (std > kNotObserved ? ", not observed"
                                            : ", std " + inUnit(p, std / effect_[indexOf(p)]));
  if (!weak.cause.empty()) weak.text += ": " + weak.cause;
  return weak;
}

WeakCombination Observability::pair(std::size_t first, std::size_t second, double correlation,
                                    const BlockFacts& facts) const {
  WeakCombination weak;
  weak.parameters = {wanted_[first], wanted_[second]};
  weak.correlation = correlation;
  weak.cause = facts.causeOf(weak.parameters);
  std::ostringstream text;
  text << name(wanted_[first]) << " with " << name(wanted_[second]);
  if (correlation == 0.0) {
    text << ", neither observed";
  } else {
    text << ", correlation " << std::fixed << std::setprecision(2) << correlation;
  }
  weak.text = text.str() + (weak.cause.empty() ? "" : ": " + weak.cause);
  return weak;
}

/// Rows and columns are the parameters considered, in metres on the ground.
struct Observability::Known {
  Eigen::MatrixXd covariance;
  Eigen::VectorXd std;

  double correlation(std::size_t i, std::size_t j) const {
    const auto r = static_cast<Eigen::Index>(i), c = static_cast<Eigen::Index>(j);
    return covariance(r, c) / (std[r] * std[c]);
  }
  double stdOf(std::size_t i) const { return std[static_cast<Eigen::Index>(i)]; }
};

Observability::Known Observability::known(const SystemVector& prior) const {
  Eigen::MatrixXd normal = scaledNormal();
  // A prior of a kilometre on the ground, which keeps the matrix regular and has no other effect.
  for (Eigen::Index i = 0; i < normal.rows(); ++i) {
    const int at = indexOf(wanted_[static_cast<std::size_t>(i)]);
    normal(i, i) += 1.0 / std::pow(std::min(kLargestEffect, prior[at] * effect_[at]), 2);
  }
  Known known;
  known.covariance = inverseOfSymmetric(normal);
  known.std = known.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  return known;
}

std::size_t Observability::partnerOf(std::size_t i, const Known& known) const {
  std::size_t partner = i;
  double strongest = kHighCorrelation;
  for (std::size_t j = 0; j < wanted_.size(); ++j) {
    if (j == i || std::abs(known.correlation(i, j)) < strongest) continue;
    strongest = std::abs(known.correlation(i, j));
    partner = j;
  }
  if (partner != i || known.stdOf(i) <= kNotObserved) return partner;
  const auto twin = std::find(wanted_.begin(), wanted_.end(), twinOf(wanted_[i]));
  if (twin == wanted_.end()) return i;
  const auto at = static_cast<std::size_t>(twin - wanted_.begin());
  return known.stdOf(at) > kNotObserved ? at : i;
}

SystemVector Observability::deviations(const SystemVector& prior) const {
  SystemVector std = SystemVector::Zero();
  if (wanted_.empty()) return std;
  const Known all = known(prior);
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const int at = indexOf(wanted_[i]);
    std[at] = all.stdOf(i) > kNotObserved ? std::numeric_limits<double>::infinity()
                                          : all.stdOf(i) / effect_[at];
  }
  return std;
}

std::vector<WeakCombination> Observability::combinations(const BlockFacts& facts,
                                                         const DeterminationLimits& limits) const {
  std::vector<WeakCombination> found;
  if (wanted_.empty()) return found;
  const Known all = known(SystemVector::Constant(std::numeric_limits<double>::infinity()));
  std::vector<std::pair<double, std::size_t>> order;  // largest ratio to the limit first
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    order.emplace_back(-all.stdOf(i) / (limits.of(wanted_[i]) * effect_[indexOf(wanted_[i])]), i);
  }
  std::sort(order.begin(), order.end());
  std::vector<bool> told(wanted_.size(), false);
  for (const auto& [beyond, i] : order) {
    const std::size_t partner = partnerOf(i, all);
    if (told[i] || (partner == i && beyond >= -1.0)) continue;
    told[i] = told[partner] = true;
    if (partner == i) {
      found.push_back(single(i, all.stdOf(i), facts));
    } else {
      const bool blind =
          all.stdOf(i) > kNotObserved && std::abs(all.correlation(i, partner)) < kHighCorrelation;
      found.push_back(pair(i, partner, blind ? 0.0 : all.correlation(i, partner), facts));
    }
  }
  return found;
}

}  // namespace pcl_als
