// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include <pcl_als/calibration/pair_observation.h>

namespace pcl_als {

/** \brief Weights of pairs from what a solution leaves of them.
 *
 * The noise model gives the ratios of the variances of pairs; their scale is estimated from the
 * data: one factor for the part of the variance that comes from pointing, common to all (the most
 * likely of a few: smaller pointing noise than stated is visible on slopes), and one for the
 * scatter of each pair of strips (robust). Huber to 1.5 standard deviations, none beyond 4.5.
 */
class PairWeights {
 public:
  /// Strips of an observation, smaller first; all control together, for a strip alone sees few
  /// points.
  using Group = std::pair<int, int>;
  static Group groupOf(const PairObservation& observation);

  /// Finds how noisy pairs are. \param residuals by area and observation, metres
  void findScales(const std::vector<AreaObservations>& observations,
                  const std::vector<std::vector<double>>& residuals, int threads = 0);

  /// Weighs by the scales found last.
  /// \param reject whether residuals may be called outliers: not while they are full of what is
  /// sought
  void update(const std::vector<AreaObservations>& observations,
              const std::vector<std::vector<double>>& residuals, bool reject);

  /// Robust weight times the model's variance over the scatter found, over what the pair shares
  /// with others, for Adjustment::accumulate.
  const std::vector<std::vector<double>>& weights() const { return weights_; }
  double pointingFactor() const { return pointing_; }  ///< of the pointing's variance
  double sigma0() const { return sigma0_; }            ///< against the noise model as given
  std::size_t kept() const { return kept_; }           ///< with a weight

 private:
  struct Values;  // residual, variance and pointing's part, by group

  std::map<Group, double> scales_;
  std::vector<std::vector<double>> weights_;
  double pointing_ = 1.0, sigma0_ = 0.0;
  std::size_t kept_ = 0;
};

}  // namespace pcl_als
