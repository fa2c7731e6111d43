// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/adjustment/robust_weight.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {

/// How an iteration with robust weights has ended.
struct RobustOutcome {
  enum class End { converged, passes_used, singular } end = End::singular;
  int passes = 0;  ///< solutions

  bool solved() const { return end != End::singular; }
  bool converged() const { return end == End::converged; }
  const char* reason() const;  ///< what is wrong, for messages; empty where it has converged
};

/** \brief Iteratively reweighted least squares (Holland and Welsch 1977): the weights of a solution
 * follow from the residuals of the one before.
 *
 * \param limit change of the solution below which it has converged, except the first; 0: all
 *   passes are made
 * \param solve std::optional<double>(): solves with the current weights and returns the change of
 *   the solution, in the unit of the limit; nothing where the equations are singular
 * \param weigh void(): weights from the residuals. It is not called after the last solution, so
 *   that the weights stay those of the solution.
 */
template <typename Solve, typename Weigh>
RobustOutcome reweight(int most_passes, double limit, const Solve& solve, const Weigh& weigh) {
  for (int pass = 1;; ++pass) {
    const std::optional<double> change = solve();
    if (!change) return {RobustOutcome::End::singular, pass};
    if (pass > 1 && *change < limit) return {RobustOutcome::End::converged, pass};
    if (pass >= most_passes) return {RobustOutcome::End::passes_used, pass};
    weigh();
  }
}

/// Of the root mean square change of the fitted values over the scale of the residuals: that of an
/// unknown from n observations is at most sqrt(n) times that of its standard deviation.
inline constexpr double kConvergedChange = 1e-6;
/// Passes in which the scale follows the residuals: with a median that moves with the weights for
/// ever, both may go round in a circle.
inline constexpr int kScalePasses = 10;

struct RobustSettings {
  int most_passes = 60;
  double huber = kHuberLimit;                          ///< residual with full weight, in scales
  double least_scale = 1e-9;                           ///< where most residuals are equal
  double (*scale)(std::vector<double>) = robustSigma;  ///< standard deviation of residuals
};

struct RobustFit : RobustOutcome {
  Eigen::VectorXd weights, residuals;  ///< Huber's weights in the last solution; after it
  double scale = 0.0;                  ///< of the residuals
};

/// Solves with factors on the weights of the observations and sets the residuals, in units of one
/// standard deviation. Returns dx' N dx for its change dx and its normal matrix N, the weighted
/// square of the change of the fitted values; nothing where the equations are singular.
using WeightedSolution = std::function<std::optional<double>(const Eigen::VectorXd& weights,
                                                             Eigen::VectorXd& residuals)>;

/// Huber's estimate with a robust scale, to kConvergedChange.
RobustFit fitRobustly(std::size_t observations, const RobustSettings& settings,
                      const WeightedSolution& solve);

}  // namespace pcl_als
