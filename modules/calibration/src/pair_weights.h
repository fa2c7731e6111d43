// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "pair_observation.h"

namespace pcl_als {

/// What the weight of a pair depends on: a copy, because observations are ten times as large.
struct PairResidual {
  /// Strips of an observation, smaller first; all control of one kind together, because a single
  /// strip covers few control points.
  using Group = std::pair<int, int>;
  static Group groupOf(const PairObservation& observation);

  PairResidual(const PairObservation& observation, double of_solution)
      : group(groupOf(observation)),
        residual(of_solution),
        variance(observation.variance),
        pointing(observation.pointing),
        echo(observation.echo),
        variance_inflation(observation.variance_inflation) {}

  Group group;
  double residual;                                      ///< metres
  double variance, pointing, echo, variance_inflation;  ///< as of PairObservation
};

/// Factors of parts of the variance of pairs.
struct VarianceParts {
  double pointing = 1.0;
  double echo = 1.0;  ///< of what echoes state of their ranges

  template <typename Pair>
  double variance(const Pair& pair) const {
    return pair.variance + (pointing - 1.0) * pair.pointing + (echo - 1.0) * pair.echo;
  }
};

/** \brief Weights of pairs from the residuals of a solution.
 *
 * The noise model gives the ratios of the variances of pairs; their scale is estimated from the
 * data: one factor common to all pairs for the part of the variance due to pointing and one for the
 * part that echoes state of their ranges (the most likely of a few values; pointing noise smaller
 * than stated is visible on slopes, a common range noise smaller than stated in the differences
 * between strong and weak echoes), and one factor for the robust scatter of each pair of strips.
 * Huber weights up to 4.5 standard deviations, then zero.
 */
class PairWeights {
 public:
  using Group = PairResidual::Group;
  using Residuals = std::vector<std::vector<PairResidual>>;  ///< by area and observation

  /// Estimates the scales.
  void findScales(const Residuals& residuals, int threads = 0);

  /// Computes weights with the scales estimated last.
  /// \param reject whether outliers are rejected: not while residuals contain the effect of the
  /// biases
  void update(const Residuals& residuals, bool reject, int threads = 0);

  /// Robust weight times the variance of the model over the estimated one, over the noise that the
  /// pair shares with others, for Adjustment::accumulate.
  const std::vector<std::vector<double>>& weights() const { return weights_; }
  const VarianceParts& factors() const { return factors_; }
  /// Standard deviation of the pairs of strips over that of the noise model with these factors: the
  /// root mean square of the pairs of strips; 1 without any.
  double meanScale() const;
  double sigma0() const { return sigma0_; }   ///< over the standard deviations of the noise model
  std::size_t kept() const { return kept_; }  ///< with a weight

 private:
  using Values = std::vector<const PairResidual*>;  // of a group
  /// Of the pairs with a weight.
  struct Kept {
    double squares = 0.0;  ///< of residuals over the standard deviation of the noise model
    std::size_t pairs = 0;
  };

  static VarianceParts mostLikelyFactors(const std::map<Group, Values>& groups, int threads);
  Kept weigh(const std::vector<PairResidual>& residuals, bool reject,
             std::vector<double>& weights) const;

  std::map<Group, double> scales_;
  std::vector<std::vector<double>> weights_;
  VarianceParts factors_;
  double sigma0_ = 0.0;
  std::size_t kept_ = 0;
};

}  // namespace pcl_als
