// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

#include "block_solution.h"
#include "parameter_choice.h"
#include "shared_errors.h"

namespace pcl_als {

/// Movement of ground points by an iteration, metres.
struct IterationMovement {
  double largest = 0.0;     ///< of a ground point that was observed
  double effect = 0.0;      ///< upper bound: the sum of the effects of all parameters and systems
  double of_systems = 0.0;  ///< of the differences between systems
};

/** \brief The phases of the iteration and its convergence.
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
class IterationControl {
 public:
  enum class Phase {
    initial,
    coarse,
    refinement,
    variance_components,
    selection,
    final_refinement,
    converged
  };
  explicit IterationControl(const CalibrationSettings& settings) : settings_(settings) {}

  bool isConverged() const { return phase_ == Phase::converged; }
  bool isFirst() const { return phase_ == Phase::initial; }
  bool isCoarse() const { return phase_ == Phase::initial || phase_ == Phase::coarse; }
  const std::vector<CalibrationIteration>& iterations() const { return iterations_; }

  /// Whether another iteration follows. Where the limit is reached and the parameters are chosen
  /// automatically, the one that changes most is excluded and the iteration continues.
  bool continues(std::size_t observations, ChoiceRules& rules, const BlockSolution& solution);

  /// What the next iteration does.
  struct Step {
    bool ends_coarse = false;  ///< pairs are formed with the effects of error sources
    bool all_pairs = false;    ///< all candidates are paired
    bool components = false;   ///< variance components are estimated
  };
  /// \param complete whether all candidates are paired
  Step next(bool complete);

  /// Where the search for variance components begins, and its tolerance, see estimateLevels().
  const VarianceFactors& componentsStart() const { return components_.most_likely; }
  double componentsTolerance() const;
  /// Records components, which were \a before.
  void recordComponents(const VarianceFactors& before, const EstimatedLevels& estimated);

  /// Records an iteration that began with the biases \a before.
  void record(const SystemVector& before, const IterationMovement& movement, const PairSet& pairs,
              const BlockSolution& solution);
  /// Lets the iteration continue after a change of the error sources that are estimated.
  void continueWithSources();

  /// The reason for which the iteration did not converge, for the verdict.
  std::string reasonNotConverged(const BlockSolution& solution) const;

 private:
  /// The variance components estimated so far.
  struct VarianceComponents {
    int estimates = 0;
    bool open = false;            ///< whether the current iteration estimates them
    bool unchanged = false;       ///< whether the last estimation did not change them
    VarianceFactors most_likely;  ///< of the last estimation

    bool complete() const {
      constexpr int kMostEstimates = 8;
      return unchanged || estimates >= kMostEstimates;
    }
  };

  /// The parameter with the largest change relative to its standard deviation in the last
  /// iterations.
  SystemParameter mostChangingParameter(const std::vector<SystemParameter>& estimate) const;
  void recordUpdates(const SystemVector& before, const BlockSolution& solution);

  CalibrationSettings settings_;
  Phase phase_ = Phase::initial;
  std::size_t coarse_iterations_ = 0;
  std::vector<CalibrationIteration> iterations_;
  VarianceComponents components_;
  double movement_ = 0.0;  ///< of the last iteration, metres
  bool small_ = false;     ///< whether it changed no parameter by a tenth of its standard deviation
  /// Largest recent update of every parameter over its standard deviation.
  SystemVector recent_updates_ = SystemVector::Zero();
};

}  // namespace pcl_als
