// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <pcl_als/calibration/system_calibration_engine.h>

#include "area_matcher.h"
#include "calibration_report.h"
#include "pair_weights.h"

namespace pcl_als {

/// Corrections of points, by strip.
struct SystemCalibrationEngine::StripCorrections {
  std::vector<BiasEvaluator> of_systems;
  std::vector<AreaMatcher::StripCorrection> strips;
  ErrorSourceVector sources = ErrorSourceVector::Zero();
};

/// Variables of the iteration.
struct SystemCalibrationEngine::State {
  State(SharedErrors& shared, int threads) : errors(shared), adjustment(shared, threads) {}

  std::size_t observationCount() const {
    std::size_t count = 0;
    for (const AreaObservations& area : observations) count += area.size();
    return count;
  }
  long redundancy() const {
    return static_cast<long>(weights.kept()) - static_cast<long>(choice.estimate.size());
  }
  /// Whether the adjustment gave observations of each area a weight.
  std::vector<AreaUse> usedAreas() const {
    std::vector<AreaUse> used(observations.size());
    for (std::size_t area = 0; area < weights.weights().size(); ++area) {
      for (std::size_t i = 0; i < weights.weights()[area].size(); ++i) {
        if (!(weights.weights()[area][i] > 0.0)) continue;
        (observations[area][i].isInPlan() ? used[area].plan : used[area].heights) = true;
      }
    }
    return used;
  }
  /** \brief Phases of the iteration.
   *
   * \verbatim
   * phase                what an iteration does         ends                 next
   * initial              weights, without rejection     with a solution      coarse
   * coarse               all parameters, wide priors    small update, or 12  refinement
   * refinement           parameters that are determined small update         variance_components
   * variance_components  the same, and REML             after one iteration  refinement
   * selection            selects pairs again, of all    after one iteration  final_refinement
   * final_refinement     adjusts the selected pairs     negligible update    converged
   * \endverbatim
   * refinement and variance_components alternate until the components no longer change; then a
   * negligible update ends the refinement: with convergence or, with a pair budget, with the
   * selection. Where the components change with the selection, refinement follows it.
   */
  enum class Phase {
    initial,
    coarse,
    refinement,
    variance_components,
    selection,
    final_refinement,
    converged
  };

  /// Without a first solution residuals contain the effect of the biases, and no outlier is
  /// rejected.
  bool solved() const { return phase != Phase::initial; }
  /// In the coarse stage no parameter is left out, because mismatched pairs make all uncertain.
  bool isCoarse() const { return phase == Phase::initial || phase == Phase::coarse; }
  /// Whether all pairs are adjusted and not a selection.
  bool all() const { return chosen_points == AreaMatcher::Points::candidates; }

  /// The variance components estimated so far.
  struct VarianceComponents {
    int estimates = 0;
    std::size_t last = 0;           ///< iteration of the last estimate, from 1; 0: none
    bool unchanged = false;         ///< whether the last estimation did not change them
    SharedErrorLevels most_likely;  ///< of the last estimation

    bool complete() const {
      constexpr int kMostEstimates = 8;
      return unchanged || estimates >= kMostEstimates;
    }
  };

  SharedErrors& errors;
  Adjustment adjustment;
  ParameterChoice choice;
  std::vector<SystemUnknowns> differences;  ///< of the systems to the first, after each solution
  AdjustmentSolution diagnosed;             ///< the last solution with all error sources
  /// With a pair budget: values of the error sources that all pairs support, taken out of the
  /// observations. A selection of pairs does not represent the effects of sources.
  ErrorSourceVector held_sources = ErrorSourceVector::Zero();
  Phase phase = Phase::initial;
  int coarse_iterations = 0;
  VarianceComponents components;
  /// Last update of the biases.
  struct Update {
    double movement = 0.0;  ///< largest movement of a ground point, metres
    bool small = false;  ///< whether no parameter changed by more than kSmall standard deviations
  } update;
  /// Largest recent update of every parameter over its standard deviation.
  SystemVector recent_updates = SystemVector::Zero();
  /// Parameters left out because the iteration does not converge with them, with the reason.
  std::map<SystemParameter, std::string> excluded;
  AreaMatcher::Points chosen_points = AreaMatcher::Points::candidates;
  /// One of so many candidates is paired. The coarse phase needs a sample only: its errors are
  /// those of the biases it began with, not those of the points.
  std::size_t sampling = 1;
  bool isSampled() const { return sampling > 1; }
  /// Biases and differences between systems of the last correction of the points.
  SystemVector corrected = SystemVector::Zero();
  std::vector<SystemUnknowns> corrected_differences;
  ErrorSourceVector corrected_sources = ErrorSourceVector::Zero();  ///< the same, of all points
  /// Upper bound of the movement of points since the pairs were formed, metres; infinite: other
  /// points are to be paired.
  double moved = 0.0;
  bool weighed = false;  ///< whether the weights are those of these pairs and this solution

  static constexpr double kSmallMovement = 0.005;  ///< metres, of points by an update

  /// Whether pairs are to be formed again. The linear equations of the pairs hold for any biases;
  /// what a movement changes are triangles that are exchanged for neighbours of nearly the same
  /// plane. With edges of 0.5 m and bends of 0.1 rad a movement of a centimetre exchanges two of a
  /// hundred, and changes their distances by at most a millimetre, of either sign.
  bool arePairsOutdated() const {
    constexpr double kNegligibleMovement = 0.01;  // metres
    return moved > kNegligibleMovement;
  }
  double threshold = 0.0;
  std::vector<AreaObservations> observations;
  /// Own pairs beyond the threshold, which are no observations, as formed last.
  std::vector<AreaObservations> far;
  PairWeights weights;
};

}  // namespace pcl_als
