// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/adjustment/robust_iteration.h>

namespace pcl_als {

const char* RobustOutcome::reason() const {
  if (!solved()) return "the equations are singular";
  return converged() ? "" : "the adjustment did not converge";
}

RobustFit fitRobustly(std::size_t observations, const RobustSettings& settings,
                      const WeightedSolution& solve) {
  RobustFit fit;
  const auto n = static_cast<Eigen::Index>(observations);
  fit.weights = Eigen::VectorXd::Ones(n);
  fit.residuals = Eigen::VectorXd::Zero(n);
  int pass = 0;
  const auto solution = [&]() -> std::optional<double> {
    const std::optional<double> square = solve(fit.weights, fit.residuals);
    if (!square) return std::nullopt;
    const double* const first = fit.residuals.data();
    if (++pass <= kScalePasses)
      fit.scale = std::max(settings.scale({first, first + n}), settings.least_scale);
    return std::sqrt(std::max(0.0, *square) / static_cast<double>(n)) / fit.scale;
  };
  const auto weigh = [&] {
    fit.weights = fit.residuals.unaryExpr(
        [&](double residual) { return huberWeight(residual, fit.scale, settings.huber); });
  };
  const RobustOutcome outcome = reweight(settings.most_passes, kConvergedChange, solution, weigh);
  static_cast<RobustOutcome&>(fit) = outcome;
  return fit;
}

}  // namespace pcl_als
