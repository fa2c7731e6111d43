// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "iteration_control.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <pcl_als/common/parameter_text.h>

namespace pcl_als {
namespace {

constexpr double kNegligible = 0.05;      // standard deviations: a smaller update is negligible
constexpr double kSmall = 0.1;            // standard deviations: a smaller update ends a phase
constexpr double kSmallMovement = 0.005;  // metres, of points by an update
constexpr int kMostReductions = 3;        // parameters excluded because of no convergence
constexpr int kAfterReduction = 10;       // iterations

/// Whether no parameter changed by more than a number of its standard deviations.
bool isUpdateWithin(double deviations, const SystemVector& before, const BlockSolution& solution) {
  const AdjustmentSolution& now = solution.solution();
  return std::all_of(
      solution.choice.estimate.begin(), solution.choice.estimate.end(), [&](SystemParameter p) {
        const int i = indexOf(p);
        return std::abs(now.biases[i] - before[i]) < deviations * std::sqrt(now.covariance(i, i));
      });
}

}  // namespace

SystemParameter IterationControl::mostChangingParameter(
    const std::vector<SystemParameter>& estimate) const {
  return *std::max_element(estimate.begin(), estimate.end(),
                           [&](SystemParameter a, SystemParameter b) {
                             return recent_updates_[indexOf(a)] < recent_updates_[indexOf(b)];
                           });
}

bool IterationControl::continues(std::size_t observations, ChoiceRules& rules,
                                 const BlockSolution& solution) {
  if (isConverged() || observations == 0) return false;
  const int done = static_cast<int>(iterations_.size() - coarse_iterations_);
  const int most = (settings_.pair_budget > 0 ? 2 : 1) * settings_.max_iterations;
  const int reductions = static_cast<int>(rules.excluded.size());
  if (done < most + reductions * kAfterReduction) return true;
  const std::vector<SystemParameter>& estimate = solution.choice.estimate;
  if (!settings_.estimate.empty() || reductions == kMostReductions || estimate.size() < 2)
    return false;
  const SystemParameter p = mostChangingParameter(estimate);
  const double std = std::sqrt(solution.solution().covariance(indexOf(p), indexOf(p)));
  rules.excluded[p] = "the adjustment does not converge with it: it still changed by " +
                      inUnit(p, recent_updates_[indexOf(p)] * std) + " after " +
                      std::to_string(iterations_.size()) + " iterations";
  recent_updates_.setZero();
  return true;
}

IterationControl::Step IterationControl::next(bool complete) {
  constexpr std::size_t kCoarseAtMost = 12, kFewest = 4;
  const std::size_t done = iterations_.size();
  // Combinations that the data hardly determine change with every new set of pairs, without effect
  // on the points or by a small part of their standard deviations. Neither delays the next phase.
  const bool small = done > 0 && (phase_ == Phase::selection || movement_ < kSmallMovement ||
                                  (small_ && done >= kFewest));
  Step step;
  if (isCoarse() && (small || done >= kCoarseAtMost)) {
    phase_ = Phase::refinement;
    step.ends_coarse = step.all_pairs = true;
  }
  if (phase_ == Phase::variance_components) phase_ = Phase::refinement;
  if (phase_ == Phase::selection) step.all_pairs = true;
  if (isCoarse()) {
    ++coarse_iterations_;
  } else if (small && !components_.complete()) {
    // The variance components are estimated after the geometry has converged, because remaining
    // biases resemble errors of the trajectory; the iteration ends when they no longer change.
    // A selection represents all pairs at the biases for which it was made. Pairs are therefore
    // selected when the geometry has converged for the first time, and again at the end. Variance
    // components are estimated with all pairs only.
    if (components_.estimates == 0) step.all_pairs = true;
    step.components = complete || step.all_pairs;
  }
  components_.open = step.components;
  if (step.components) {
    if (phase_ == Phase::refinement) phase_ = Phase::variance_components;
    ++components_.estimates;
  }
  return step;
}

double IterationControl::componentsTolerance() const {
  constexpr double kFirst = 0.05, kLater = 0.02;  // another estimation follows
  return components_.estimates > 1 ? kLater : kFirst;
}

void IterationControl::recordComponents(const VarianceFactors& before,
                                        const EstimatedLevels& estimated) {
  components_.unchanged = estimated.expected.near(before);
  components_.most_likely = estimated.most_likely;
}

void IterationControl::recordUpdates(const SystemVector& before, const BlockSolution& solution) {
  constexpr double kMemory = 0.7;
  small_ = isUpdateWithin(kSmall, before, solution);
  for (const SystemParameter p : solution.choice.estimate) {
    const int i = indexOf(p);
    const double std = std::sqrt(solution.solution().covariance(i, i));
    const double update =
        std > 0.0 ? std::abs(solution.solution().biases[i] - before[i]) / std : 0.0;
    recent_updates_[i] = std::max(kMemory * recent_updates_[i], update);
  }
}

void IterationControl::record(const SystemVector& before, const IterationMovement& movement,
                              const PairSet& pairs, const BlockSolution& solution) {
  constexpr std::size_t kFewest = 3;  // iterations
  if (phase_ == Phase::initial) phase_ = Phase::coarse;
  if (phase_ == Phase::selection)
    phase_ = components_.complete() ? Phase::final_refinement : Phase::refinement;
  recordUpdates(before, solution);
  movement_ = movement.largest;
  iterations_.push_back({pairs.count(), solution.weights.sigma0(), movement.effect});
  if (iterations_.size() <= kFewest || components_.estimates == 0 || pairs.isOutdated() ||
      (components_.open && !components_.unchanged))
    return;
  if (movement.effect < settings_.convergence ||
      (movement.of_systems < kSmallMovement && isUpdateWithin(kNegligible, before, solution))) {
    const bool select = settings_.pair_budget > 0 && phase_ != Phase::final_refinement;
    phase_ = select ? Phase::selection : Phase::converged;
  }
}

void IterationControl::continueWithSources() {
  phase_ = Phase::refinement;
  const VarianceFactors most_likely = components_.most_likely;
  components_ = {};
  components_.most_likely = most_likely;
  coarse_iterations_ = iterations_.size();
}

std::string IterationControl::reasonNotConverged(const BlockSolution& solution) const {
  if (isConverged()) return {};
  if (iterations_.empty()) return "no point has a patch in another strip or at control";
  std::ostringstream text;
  text << "the adjustment did not converge in " << iterations_.size() << " iterations";
  if (!solution.choice.estimate.empty()) {
    const SystemParameter p = mostChangingParameter(solution.choice.estimate);
    text.precision(2);
    text << ": " << infoOf(p).name << " still changes by " << recent_updates_[indexOf(p)]
         << " standard deviations; estimate fewer parameters";
  }
  if (settings_.pair_budget > 0) text << " or keep more pairs of points";
  return text.str();
}

}  // namespace pcl_als
