// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <pcl_als/adjustment/robust_weight.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/photogrammetry/bundle_adjustment.h>

#include "bundle_normal.h"
#include "bundle_problem.h"
#include "bundle_result.h"
#include "data_snooping.h"

namespace pcl_als {
namespace {

using namespace photogrammetry;

constexpr int kIterations = 200;  ///< of one solution
/// Scale of the loss of a control line against that of a measurement: one wrong measurement must
/// not outweigh the four coordinates of control.
constexpr double kControlLimit = 4.0;
/// Cauchy's loss of this scale has an efficiency of 95 % for normally distributed errors.
constexpr double kCauchyScale = 2.385;
/// Limit of rejection after a robust solution, where residuals of single observations are larger
/// than those of least squares.
constexpr double kRobustLimit = 1.5 * kRejectionLimit;
constexpr int kRejectionRounds = 40;
constexpr const char* kNoConvergence =
    "the adjustment does not converge: the approximate orientations, the camera, or the unit or "
    "the axes of the image coordinates do not fit the lines";

/// One solution of the block by Ceres.
class Solution {
 public:
  explicit Solution(BundleProblem& problem) : problem_(problem) {}

  /// \a robust: scale of Cauchy's loss in standard deviations; 0: least squares. Returns whether it
  /// has converged.
  bool solve(double robust);
  int iterations() const { return iterations_; }

 private:
  BundleProblem& problem_;
  int iterations_ = 0;
};

bool Solution::solve(double robust) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::CauchyLoss loss(robust > 0.0 ? robust : 1.0);
  ceres::CauchyLoss control_loss(robust > 0.0 ? kControlLimit * robust : 1.0);
  ceres::Problem ceres_problem(ownership);
  auto* ordering = new ceres::ParameterBlockOrdering;
  for (const Observation& o : problem_.observations) {
    if (!problem_.inUse(o)) continue;
    std::vector<double*> blocks;
    if (o.image != Observation::kNone) blocks.push_back(problem_.images[o.image].data());
    if (o.feature != Observation::kNone)
      blocks.push_back(problem_.features[o.feature].unknown.data());
    if (o.feature != Observation::kNone) ordering->AddElementToGroup(blocks.back(), 0);
    if (o.image != Observation::kNone) ordering->AddElementToGroup(blocks.front(), 1);
    ceres_problem.AddResidualBlock(const_cast<ceres::CostFunction*>(o.cost.get()),
                                   robust <= 0.0 || o.isPrior() ? nullptr
                                   : o.isControl()              ? &control_loss
                                                                : &loss,
                                   blocks);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_SCHUR;
  // Eigen's factorisation: the supernodal one of CHOLMOD has another licence.
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.linear_solver_ordering.reset(ordering);
  options.max_num_iterations = kIterations;
  options.function_tolerance = robust > 0.0 ? 1e-6 : 1e-10;
  options.parameter_tolerance = robust > 0.0 ? 1e-9 : 1e-14;
  options.gradient_tolerance = 1e-14;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;  // sums in one order
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  iterations_ += static_cast<int>(summary.iterations.size());
  return summary.termination_type == ceres::CONVERGENCE;
}

/// Robust standard deviation of the residuals of observations in use, in units of their own.
double robustScale(const BundleProblem& problem) {
  std::vector<double> residuals;
  for (const Observation& o : problem.observations) {
    if (!problem.inUse(o) || o.isPrior()) continue;
    const Eigen::VectorXd residual = problem.linearised(o).residual;
    residuals.insert(residuals.end(), residual.data(), residual.data() + residual.size());
  }
  return residuals.empty() ? 0.0 : robustSigmaAboutZero(std::move(residuals));
}

/// Solutions with Cauchy's loss, whose scale follows the scatter of the residuals; what exceeds the
/// limit of data snooping there is rejected, so that it does not displace others in a least-squares
/// solution.
void solveRobustly(BundleProblem& problem, Solution& solution, Snooping& snooping) {
  double scale = std::max(1.0, robustScale(problem));
  for (int round = 0; round < kRejectionRounds; ++round) {
    solution.solve(kCauchyScale * scale);
    const double next = std::max(1.0, robustScale(problem));
    const bool settled = next > 0.8 * scale && next < 1.25 * scale;
    scale = next;
    if (settled && snooping.reject(problem, BundleNormal(problem), kRobustLimit) == 0) break;
  }
}

std::string tooWeak(const BundleNormal::Weakest& weakest) {
  char text[200];
  std::snprintf(text, sizeof text,
                " is not determined by the lines (standard deviation above %.3g m at the border of "
                "the block): lines of different directions are needed all over the block",
                std::min(weakest.std, 1e6));
  return weakest.name + text;
}

/// Rejects observations and solves again until nothing more is rejected, or until an image has too
/// few measurements left: a solution would be arbitrary.
bool solveWithoutBlunders(BundleProblem& problem, Solution& solution, Snooping& snooping) {
  for (int round = 0; round < kRejectionRounds; ++round) {
    if (!tooFewMeasurements(problem).empty() || !solution.solve(0.0)) return false;
    const BundleNormal normal(problem);
    if (snooping.reject(problem, normal) == 0) return true;
  }
  return true;
}

/// States that most control lines were rejected, which is the reason of all that follows.
std::string contradiction(const BundleProblem& problem) {
  std::size_t lines = 0, used = 0;
  for (const Feature& feature : problem.features) {
    if (feature.line) ++lines;
    if (feature.line && feature.used) ++used;
  }
  if (2 * used >= lines) return {};
  return std::to_string(lines - used) + " of " + std::to_string(lines) +
         " control lines contradict the images: the approximate orientations, the camera, the unit "
         "of the coordinates or the lines are wrong; ";
}

/// States what the block does not determine; true where it determines all.
bool checkDetermined(const BundleProblem& problem, const BundleNormal& normal, double limit,
                     BundleResult& result) {
  const std::string sparse = tooFewMeasurements(problem);
  if (!sparse.empty()) {
    result.status = BundleResult::Status::not_determined;
    result.message =
        contradiction(problem) + sparse + "; others contradict the block and were rejected";
    return false;
  }
  const BundleNormal::Weakest weakest = normal.weakest();
  result.weakest = weakest.name;
  result.weakest_std = weakest.std;
  if (weakest.std < limit) return true;
  result.status = BundleResult::Status::not_determined;
  result.message = contradiction(problem) + tooWeak(weakest);
  return false;
}

}  // namespace

BundleResult adjustBundle(const ImageBlock& block, const BundleSettings& settings) {
  BundleProblem problem(block, settings.formulation);
  BundleResult result;
  const std::string sparse = tooFewMeasurements(problem);
  if (!sparse.empty()) {
    result.status = BundleResult::Status::not_determined;
    result.message = sparse;
    return result;
  }
  Solution solution(problem);
  Snooping snooping;
  if (settings.robust) solveRobustly(problem, solution, snooping);
  bool converged =
      settings.robust ? solveWithoutBlunders(problem, solution, snooping) : solution.solve(0.0);
  std::optional<BundleNormal> normal(std::in_place, problem);
  bool determined = checkDetermined(problem, *normal, settings.determined_std, result);
  bool inverted = determined && normal->invert();
  // With the redundancy numbers of the whole block, which are smaller than those before.
  if (settings.robust && inverted && snooping.reject(problem, *normal) > 0) {
    converged = solveWithoutBlunders(problem, solution, snooping);
    normal.emplace(problem);
    determined = checkDetermined(problem, *normal, settings.determined_std, result);
    inverted = determined && normal->invert();
  }
  result.iterations = solution.iterations();
  if (determined && !inverted) {
    result.status = BundleResult::Status::not_determined;
    result.message =
        contradiction(problem) +
        "the measurements do not connect all images: the normal equations are singular";
  }
  if (!converged && determined) result.message = kNoConvergence;
  if (converged && inverted) result.status = BundleResult::Status::converged;
  describe(problem, *normal, inverted, result);
  snooping.describe(problem, result);
  return result;
}

}  // namespace pcl_als
