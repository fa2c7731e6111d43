// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The iteration of SystemCalibrationEngine: its phases and its convergence.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <pcl_als/calibration/system_calibration_engine.h>

#include "calibration_state.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

constexpr double kNegligible = 0.05;  // standard deviations: a smaller update is negligible
constexpr double kSmall = 0.1;        // standard deviations: a smaller update ends a phase
constexpr int kMostReductions = 3;    // parameters left out because the iteration does not converge
constexpr int kAfterReduction = 10;   // iterations

/// Calls \a visit with observations of the whole block, of which these are enough for its extent.
template <class Visit>
void visitSome(const std::vector<AreaObservations>& observations, const Visit& visit) {
  constexpr std::size_t kEnough = 20'000;
  std::size_t count = 0, first = 0;
  for (const AreaObservations& area : observations) count += area.size();
  const std::size_t every = std::max<std::size_t>(1, count / kEnough);
  for (const AreaObservations& area : observations) {
    for (; first < area.size(); first += every) visit(area[first]);
    first -= area.size();
  }
}

/// Upper bound of the movement of a ground point by a change of the biases, metres: the sum of the
/// effects of all parameters.
double largestEffect(const std::vector<AreaObservations>& observations,
                     const SystemVector& change) {
  double x = 0.0, z = 0.0;
  visitSome(observations, [&](const PairObservation& o) {
    x = std::max(x, o.lateral);
    z = std::max(z, o.height);
  });
  ScanGeometry geometry;
  geometry.x = x;
  geometry.z = -z;
  geometry.beta = -std::atan2(x, z);
  return (designBlock(geometry).cwiseAbs() * change.cwiseAbs()).maxCoeff();
}

/// Movement of a ground point by a change of the biases, metres: the largest of the points that
/// were observed, on either side of the flight line. Changes that compensate each other move no
/// point.
double largestMovement(const std::vector<AreaObservations>& observations,
                       const SystemVector& change) {
  double largest = 0.0;
  visitSome(observations, [&](const PairObservation& o) {
    for (const double x : {o.lateral, -o.lateral}) {
      ScanGeometry geometry;
      geometry.x = x;
      geometry.z = -o.height;
      geometry.beta = -std::atan2(x, o.height);
      largest = std::max(largest, (designBlock(geometry) * change).norm());
    }
  });
  return largest;
}

/// Change of the distances by a change of the error sources, metres.
double largestEffectOfSources(const std::vector<AreaObservations>& observations,
                              const ErrorSourceVector& change) {
  double largest = 0.0;
  if (change.isZero(0.0)) return largest;
  for (const AreaObservations& area : observations)
    for (const PairObservation& o : area) largest = std::max(largest, std::abs(o.sources * change));
  return largest;
}

/// The same of a change of the differences between systems.
double largestEffect(const std::vector<AreaObservations>& observations,
                     const std::vector<SystemUnknowns>& before,
                     const std::vector<SystemUnknowns>& after) {
  double largest = 0.0;
  for (std::size_t i = 1; i < after.size(); ++i) {
    const SystemUnknowns change = before.empty() ? after[i] : SystemUnknowns(after[i] - before[i]);
    largest =
        std::max(largest, largestMovement(observations, change.head<kSystemParameterCount>()) +
                              change.tail<3>().norm());
  }
  return largest;
}

}  // namespace

bool SystemCalibrationEngine::isUpdateWithin(const State& state, const SystemVector& before,
                                             double deviations) {
  const AdjustmentSolution& solution = state.choice.solution;
  return std::all_of(state.choice.estimate.begin(), state.choice.estimate.end(),
                     [&](SystemParameter p) {
                       const int i = indexOf(p);
                       return std::abs(solution.biases[i] - before[i]) <
                              deviations * std::sqrt(solution.covariance(i, i));
                     });
}

void SystemCalibrationEngine::recordUpdate(State& state, const SystemVector& before) {
  constexpr double kMemory = 0.7;
  const AdjustmentSolution& solution = state.choice.solution;
  state.update.movement = largestMovement(state.observations, solution.biases - before);
  state.update.small = isUpdateWithin(state, before, kSmall);
  for (const SystemParameter p : state.choice.estimate) {
    const int i = indexOf(p);
    const double std = std::sqrt(solution.covariance(i, i));
    const double update = std > 0.0 ? std::abs(solution.biases[i] - before[i]) / std : 0.0;
    state.recent_updates[i] = std::max(kMemory * state.recent_updates[i], update);
  }
}

SystemParameter SystemCalibrationEngine::mostChangingParameter(const State& state) {
  return *std::max_element(state.choice.estimate.begin(), state.choice.estimate.end(),
                           [&](SystemParameter a, SystemParameter b) {
                             return state.recent_updates[indexOf(a)] <
                                    state.recent_updates[indexOf(b)];
                           });
}

bool SystemCalibrationEngine::mayContinue(State& state, const CalibrationResult& result) const {
  if (result.converged || state.observationCount() == 0) return false;
  const int done = static_cast<int>(result.iterations.size()) - state.coarse_iterations;
  const int most = (settings_.pair_budget > 0 ? 2 : 1) * settings_.max_iterations;
  const int reductions = static_cast<int>(state.excluded.size());
  if (done < most + reductions * kAfterReduction) return true;
  if (!settings_.estimate.empty() || reductions == kMostReductions ||
      state.choice.estimate.size() < 2) {
    return false;
  }
  const SystemParameter p = mostChangingParameter(state);
  const double std = std::sqrt(state.choice.solution.covariance(indexOf(p), indexOf(p)));
  state.excluded[p] = "the adjustment does not converge with it: it still changed by " +
                      inUnit(p, state.recent_updates[indexOf(p)] * std) + " after " +
                      std::to_string(result.iterations.size()) + " iterations";
  state.recent_updates.setZero();
  return true;
}

void SystemCalibrationEngine::leaveCoarse(State& state) {
  state.phase = State::Phase::refinement;
  if (settings_.diagnose) considerSources();
  formAllPairs(state);  // with the effects of the sources
}

void SystemCalibrationEngine::openVarianceComponents(State& state, std::size_t done) {
  // A selection represents all pairs at the biases for which it was made. Pairs are therefore
  // selected when the geometry has converged for the first time, and again at the end. Variance
  // components are estimated with all pairs only.
  if (state.components.estimates == 0) pairAllCandidates(state);
  if (!state.all()) return;
  if (state.phase == State::Phase::refinement) state.phase = State::Phase::variance_components;
  ++state.components.estimates;
  state.components.last = done + 1;
}

void SystemCalibrationEngine::openIteration(State& state, std::size_t done) {
  constexpr std::size_t kCoarseAtMost = 12, kFewest = 4;
  // Combinations that the data hardly determine change with every new set of pairs, without effect
  // on the points or by a small part of their standard deviations. Neither delays the next phase.
  const bool small = done > 0 && (state.phase == State::Phase::selection ||
                                  state.update.movement < State::kSmallMovement ||
                                  (state.update.small && done >= kFewest));
  if (state.isCoarse() && (small || done >= kCoarseAtMost)) leaveCoarse(state);
  if (state.phase == State::Phase::variance_components) state.phase = State::Phase::refinement;
  if (state.phase == State::Phase::selection) pairAllCandidates(state);
  if (state.isCoarse()) {
    ++state.coarse_iterations;
  } else if (small && !state.components.complete()) {
    // The variance components are estimated after the geometry has converged, because remaining
    // biases resemble errors of the trajectory; the iteration ends when they no longer change.
    openVarianceComponents(state, done);
  }
}

void SystemCalibrationEngine::closeSelection(State& state) const {
  if (state.phase != State::Phase::selection) return;
  state.phase =
      state.components.complete() ? State::Phase::final_refinement : State::Phase::refinement;
}

void SystemCalibrationEngine::closeConverged(State& state) const {
  const bool select = settings_.pair_budget > 0 && state.phase != State::Phase::final_refinement;
  state.phase = select ? State::Phase::selection : State::Phase::converged;
}

void SystemCalibrationEngine::iterate(State& state, CalibrationResult& result) {
  const SystemVector before = state.choice.solution.biases;
  const std::vector<SystemUnknowns> differences = state.differences;
  const ErrorSourceVector sources = sourcesOf(state);
  const std::size_t done = result.iterations.size();
  openIteration(state, done);
  const bool components_open = state.components.last == done + 1;
  adjust(state, components_open);
  closeSelection(state);
  if (settings_.pair_budget > 0 && state.all()) selectPairs(state);
  const SystemVector& biases = state.choice.solution.biases;
  const double of_systems = largestEffect(state.observations, differences, state.differences);
  const double effect = largestEffect(state.observations, biases - before) + of_systems;
  recordUpdate(state, before);
  const double of_sources = largestEffectOfSources(state.observations, sourcesOf(state) - sources);
  state.update.movement = std::max({state.update.movement, of_systems, of_sources});
  state.moved += state.update.movement;
  result.iterations.push_back({state.observationCount(), state.weights.sigma0(), effect});
  if (progress_) progress_(result.iterations.back());
  const bool components_changed = components_open && !state.components.unchanged;
  if (done > 2 && !components_changed && !state.arePairsOutdated() &&
      state.components.estimates > 0 &&
      (effect < settings_.convergence ||
       (of_systems < State::kSmallMovement && isUpdateWithin(state, before, kNegligible)))) {
    closeConverged(state);
  }
  result.converged = state.phase == State::Phase::converged;
  shrinkThreshold(state);
}

std::string SystemCalibrationEngine::reasonNotConverged(const State& state,
                                                        const CalibrationResult& result) const {
  if (result.iterations.empty()) return "no point has a patch in another strip or at control";
  std::ostringstream text;
  text << "the adjustment did not converge in " << result.iterations.size() << " iterations";
  if (!state.choice.estimate.empty()) {
    const SystemParameter p = mostChangingParameter(state);
    text.precision(2);
    text << ": " << infoOf(p).name << " still changes by " << state.recent_updates[indexOf(p)]
         << " standard deviations; estimate fewer parameters";
  }
  if (settings_.pair_budget > 0) text << " or keep more pairs of points";
  return text.str();
}

}  // namespace pcl_als
