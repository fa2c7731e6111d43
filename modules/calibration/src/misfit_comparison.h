// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/common/calibration_verdict.h>

#include "pair_observation.h"

namespace pcl_als {

/** \brief Compares the distances of the same points from the other strip's surface before and after
 * a calibration (MisfitChange).
 *
 * Each set of pairs is formed in its own geometry (to a centimetre), from all candidates and with
 * the same threshold: a point counts where it has an acceptable patch of the same strip in both.
 * Pairs that exist in one geometry only would favour that geometry.
 *
 * With t = min(d, limit)^2 of every point, areas g as clusters and N points, the mean change of t
 * is c = sum_g D_g / N with D_g the sum of changes in an area, and its variance is G / (G - 1)
 * sum_g (D_g - n_g c)^2 / N^2. The limit is 4.5 times the larger of the two robust standard
 * deviations (about zero), which limits the influence of vegetation and moved objects.
 */
class MisfitComparison {
 public:
  /// \param delivered all pairs found in the data as delivered, by area
  explicit MisfitComparison(const std::vector<AreaObservations>& delivered);

  /// \param calibrated all pairs formed after the calibration with \a biases
  MisfitChange change(const std::vector<AreaObservations>& calibrated,
                      const SystemVector& biases) const;

 private:
  struct Distance {
    int a = 0, b = 0;  ///< surfaces, PairObservation::surfaceA()
    std::int32_t point = -1;
    float before = 0.0F;  ///< metres

    bool operator<(const Distance& other) const;
  };
  std::vector<std::vector<Distance>> delivered_;  ///< by area, sorted
};

}  // namespace pcl_als
