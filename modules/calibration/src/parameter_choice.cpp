// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "parameter_choice.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/parameter_text.h>

namespace pcl_als {
namespace {

using P = SystemParameter;

/// The order in which parameters that cannot be separated are excluded.
constexpr std::array<P, kSystemParameterCount> kDropOrder{
    P::lever_arm_z, P::lever_arm_y,       P::lever_arm_x,     P::scan_angle_scale,
    P::range_bias,  P::boresight_heading, P::boresight_pitch, P::boresight_roll};

constexpr double kInseparable = 0.9;  // correlation above which two parameters cannot be separated
constexpr double kComponentOfDirection =
    0.3;  // component of a unit vector: the parameter takes part in a weak direction

std::string codeName(P p) {
  return std::string(infoOf(p).name);
}

P firstToDrop(const std::vector<P>& candidates) {
  return *std::find_first_of(kDropOrder.begin(), kDropOrder.end(), candidates.begin(),
                             candidates.end());
}

std::string listed(const std::vector<P>& parameters, P except) {
  std::string text;
  for (const P p : parameters) {
    if (p == except) continue;
    text += (text.empty() ? "" : ", ") + codeName(p);
  }
  return text;
}

/// The parameters with components in the weakest direction of a normal matrix with unit diagonal.
std::vector<P> weakestDirection(const SystemMatrix& normal, const std::vector<P>& estimate) {
  std::vector<P> dead;
  for (const P p : estimate) {
    if (!(normal(indexOf(p), indexOf(p)) > 0.0)) dead.push_back(p);
  }
  if (!dead.empty()) return dead;
  Eigen::MatrixXd scaled(estimate.size(), estimate.size());
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    for (std::size_t j = 0; j < estimate.size(); ++j) {
      const int a = indexOf(estimate[i]), b = indexOf(estimate[j]);
      scaled(i, j) = normal(a, b) / std::sqrt(normal(a, a) * normal(b, b));
    }
  }
  const Eigen::VectorXd weakest = symmetricEigen(scaled).vectors.col(0);
  std::vector<P> taking_part;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    if (std::abs(weakest[i]) >= kComponentOfDirection) taking_part.push_back(estimate[i]);
  }
  return taking_part;
}

double correlation(const SystemMatrix& covariance, P a, P b) {
  const int i = indexOf(a), j = indexOf(b);
  return covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
}

/// The parameters of a solution whose standard deviations are too large, of which one is excluded;
/// no candidates where there are none.
std::vector<P> tooUncertain(const AdjustmentSolution& solution, const std::vector<P>& estimate,
                            const DeterminationLimits& limits, double factor) {
  std::vector<P> candidates;
  for (const P p : estimate) {
    const double limit = factor * limits.of(p);
    if (std::sqrt(solution.covariance(indexOf(p), indexOf(p))) <= limit) continue;
    candidates.push_back(p);
    for (const P other : estimate) {
      if (other != p && std::abs(correlation(solution.covariance, p, other)) > kInseparable)
        candidates.push_back(other);
    }
  }
  return candidates;
}

/// The parameter other than \a p with the strongest correlation; \a p itself where it is alone.
P mostCorrelated(const SystemMatrix& covariance, const std::vector<P>& estimate, P p) {
  P partner = p;
  double strongest = 0.0;
  for (const P other : estimate) {
    if (other == p || std::abs(correlation(covariance, p, other)) <= strongest) continue;
    strongest = std::abs(correlation(covariance, p, other));
    partner = other;
  }
  return partner;
}

std::string uncertainReason(const AdjustmentSolution& solution, const std::vector<P>& estimate,
                            P dropped, const DeterminationLimits& limits, double factor) {
  const SystemMatrix& covariance = solution.covariance;
  const auto std_of = [&](P p) { return std::sqrt(covariance(indexOf(p), indexOf(p))); };
  const auto too_large = [&](P p) { return std_of(p) > factor * limits.of(p); };
  // The one that is excluded may be well determined and make another one uncertain.
  P uncertain = dropped;
  for (const P p : estimate) {
    if (!too_large(dropped) && too_large(p) &&
        std::abs(correlation(covariance, dropped, p)) > kInseparable)
      uncertain = p;
  }
  const P partner =
      uncertain == dropped ? mostCorrelated(covariance, estimate, dropped) : uncertain;
  std::ostringstream coefficient;
  coefficient.precision(2);
  coefficient << std::fixed << "correlation " << correlation(covariance, dropped, partner);
  const std::string size = "would be " + inUnit(uncertain, std_of(uncertain)) +
                           ", more than the limit of " +
                           inUnit(uncertain, factor * limits.of(uncertain));
  if (uncertain != dropped)
    return "it cannot be separated from " + codeName(uncertain) + " (" + coefficient.str() +
           "), whose standard deviation " + size;
  if (std::abs(correlation(covariance, dropped, partner)) < 0.5 || partner == dropped)
    return "its standard deviation " + size;
  return "its standard deviation " + size + " (" + coefficient.str() + " with " +
         codeName(partner) + ")";
}

/// Adds to the covariance of the others the effect of a parameter that is held and known with the
/// standard deviation sigma only.
void consider(const Adjustment& adjustment, P held, double sigma, ParameterChoice& choice) {
  const std::vector<P>& estimate = choice.estimate;
  const SystemMatrix normal = adjustment.normalOf(estimate);
  const auto size = static_cast<Eigen::Index>(estimate.size());
  Eigen::MatrixXd own(size, size);
  Eigen::VectorXd coupling(size), scale(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int row = indexOf(estimate[static_cast<std::size_t>(i)]);
    coupling[i] = normal(row, indexOf(held));
    scale[i] = 1.0 / std::sqrt(normal(row, row));
    for (Eigen::Index j = 0; j < size; ++j)
      own(i, j) = normal(row, indexOf(estimate[static_cast<std::size_t>(j)]));
  }
  const Eigen::MatrixXd scaled = scale.asDiagonal() * own * scale.asDiagonal();
  const Eigen::VectorXd effect =
      scale.asDiagonal() * solveSymmetric(scaled, scale.asDiagonal() * coupling);
  SystemVector shift = SystemVector::Zero();
  for (Eigen::Index i = 0; i < size; ++i)
    shift[indexOf(estimate[static_cast<std::size_t>(i)])] = effect[i] * sigma;
  choice.solution.covariance += shift * shift.transpose();
  choice.solution.of_flight += shift * shift.transpose();
  HeldParameters& record = choice.held;
  record.parameters.push_back(held);
  record.std.push_back(sigma);
  record.effect.conservativeResize(size, static_cast<Eigen::Index>(record.std.size()));
  record.effect.rightCols<1>() = -effect;  // N x = h - (coupling) v
}

/// Parameters of \a wanted that are not estimated, and those that are \a unknown.
void considerOthers(const Adjustment& adjustment, const std::vector<P>& wanted,
                    const std::vector<P>& unknown, const DeterminationLimits& limits,
                    ParameterChoice& choice) {
  for (const P p : wanted) {
    if (choice.status[indexOf(p)] == ParameterStatus::estimated) continue;
    consider(adjustment, p, limits.whenHeld(p), choice);
  }
  for (const P p : unknown) consider(adjustment, p, limits.whenHeld(p), choice);
}

}  // namespace

double DeterminationLimits::of(SystemParameter p) const {
  switch (p) {
    case P::lever_arm_x:
    case P::lever_arm_y:
    case P::lever_arm_z:
      return lever_arm;
    case P::boresight_pitch:
    case P::boresight_roll:
      return roll_pitch;
    case P::boresight_heading:
      return heading;
    case P::range_bias:
      return range;
    case P::scan_angle_scale:
      return scan_angle_scale;
  }
  return 0.0;
}

DeterminationLimits DeterminationLimits::atHeight(double height) const {
  DeterminationLimits limits = *this;
  if (!(height > 0.0)) return limits;
  const double factor = std::max(1.0, lever_arm / (roll_pitch * height));
  limits.roll_pitch *= factor;
  limits.heading *= factor;
  limits.scan_angle_scale *= factor;
  return limits;
}

double DeterminationLimits::whenHeld(SystemParameter p) const {
  const bool is_lever_arm = indexOf(p) <= indexOf(P::lever_arm_z);
  return is_lever_arm ? 0.05 : 2.0 * of(p);
}

ParameterChoice chooseParameters(const Adjustment& adjustment,
                                 const std::vector<SystemParameter>& wanted,
                                 const SystemVector& held, const DeterminationLimits& limits,
                                 double limit_factor, const std::vector<SystemParameter>& unknown) {
  ParameterChoice choice;
  choice.estimate = wanted;
  choice.status.fill(ParameterStatus::fixed);
  for (const P p : wanted) choice.status[indexOf(p)] = ParameterStatus::estimated;
  while (!choice.estimate.empty()) {
    choice.solution = adjustment.solve(choice.estimate, held);
    const std::vector<P> candidates =
        choice.solution.solved
            ? tooUncertain(choice.solution, choice.estimate, limits, limit_factor)
            : weakestDirection(adjustment.normalOf(choice.estimate), choice.estimate);
    if (candidates.empty()) {
      considerOthers(adjustment, wanted, unknown, limits, choice);
      return choice;
    }
    const P dropped = firstToDrop(candidates);
    std::string& reason = choice.reason[indexOf(dropped)];
    if (choice.solution.solved) {
      reason = uncertainReason(choice.solution, choice.estimate, dropped, limits, limit_factor);
    } else {
      const std::string others = listed(candidates, dropped);
      reason = others.empty() ? "the observations do not depend on it"
                              : "cannot be separated from " + others;
    }
    choice.status[indexOf(dropped)] = ParameterStatus::not_estimable;
    choice.estimate.erase(std::find(choice.estimate.begin(), choice.estimate.end(), dropped));
  }
  choice.solution = adjustment.unsolved(held);
  return choice;
}

std::vector<P> automaticParameters(bool with_control, const SharedErrorModel& model) {
  std::vector<P> parameters;
  for (const SystemParameterInfo& info : systemParameters()) {
    const bool known = model.biases.of(info.parameter);
    if (info.parameter == P::lever_arm_z && !known) continue;
    if (info.parameter == P::range_bias && !with_control && !known) continue;
    parameters.push_back(info.parameter);
  }
  return parameters;
}

void reportParameters(const ParameterChoice& choice, const std::vector<SystemParameter>& requested,
                      CalibrationResult& result) {
  const AdjustmentSolution& solution = choice.solution;
  for (const SystemParameterInfo& info : systemParameters()) {
    const int i = indexOf(info.parameter);
    ParameterEstimate& parameter = result.parameters[i];
    parameter.status = choice.status[i];
    parameter.reason = choice.reason[i];
    if (parameter.status == ParameterStatus::estimated) {
      parameter.bias = solution.biases[i];
      parameter.std = std::sqrt(solution.covariance(i, i));
      parameter.std_formal = std::sqrt(solution.formal(i, i));
      continue;
    }
    if (parameter.status == ParameterStatus::not_estimable) {
      result.warnings.push_back(std::string(info.name) + " is not determined: " + parameter.reason);
      if (!requested.empty()) result.converged = false;
    } else if (!requested.empty()) {
      parameter.reason = "not asked for";
    } else if (info.parameter == SystemParameter::range_bias) {
      parameter.status = ParameterStatus::not_estimable;
      parameter.reason = "needs control: strips alone hardly determine it";
    } else {
      parameter.reason = "not separable from range_bias, and never determined by strips alone";
    }
  }
  result.correlation_order = choice.estimate;
  result.held_parameters = choice.held;
  const auto size = static_cast<Eigen::Index>(choice.estimate.size());
  result.correlation.resize(size, size);
  for (Eigen::Index r = 0; r < size; ++r) {
    for (Eigen::Index c = 0; c < size; ++c) {
      const int i = indexOf(choice.estimate[static_cast<std::size_t>(r)]);
      const int j = indexOf(choice.estimate[static_cast<std::size_t>(c)]);
      result.correlation(r, c) = solution.covariance(i, j) /
                                 std::sqrt(solution.covariance(i, i) * solution.covariance(j, j));
    }
  }
  if (choice.estimate.empty()) {
    result.converged = false;
    result.warnings.push_back("no parameter can be determined from this block");
  }
}

}  // namespace pcl_als
