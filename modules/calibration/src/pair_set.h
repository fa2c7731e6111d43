// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include "block_calibration.h"

namespace pcl_als {

/// Which pairs are formed.
struct PairRules {
  double threshold = 2.0;  ///< metres, largest normal distance
  /// One of so many candidates is paired. A coarse solution needs a sample only: its errors are
  /// those of the biases it began with, not those of the points.
  std::size_t sampling = 1;
  bool selected = false;  ///< the points that selectPairs() kept, not all candidates
  /// Values of error sources whose effects are taken out of the observations: a selection of pairs
  /// does not represent the effects of sources.
  ErrorSourceVector held_sources = ErrorSourceVector::Zero();

  bool isComplete() const { return !selected && sampling == 1; }
};

/// Whether observations of an area have a weight: of heights and strips, and of targets in plan.
struct AreaUse {
  bool heights = false, plan = false;
};

/// Point-to-patch pairs and control, by area, Eqs. (11), (12).
struct PairSet {
  std::vector<AreaObservations> observations;
  /// Own pairs beyond the threshold, which are no observations.
  std::vector<AreaObservations> far;
  PairRules rules;  ///< by which they were formed
  /// Upper bound of the movement of points since the pairs were formed, metres; infinite: other
  /// points are to be paired.
  double moved = 0.0;

  std::size_t count() const;
  /// Whether pairs are to be formed again. The linear equations of the pairs hold for any biases;
  /// what a movement changes are triangles that are exchanged for neighbours of nearly the same
  /// plane. With edges of 0.5 m and bends of 0.1 rad a movement of a centimetre exchanges two of a
  /// hundred, and changes their distances by at most a millimetre, of either sign.
  bool isOutdated() const {
    constexpr double kNegligibleMovement = 0.01;  // metres
    return moved > kNegligibleMovement;
  }
  /// By area, which observations have one of these weights.
  std::vector<AreaUse> used(const std::vector<std::vector<double>>& weights) const;
};

/// Corrects the points and forms the pairs of all areas. Collective.
PairSet formPairs(AreaSample& sample, const Corrections& corrections, const PairRules& rules);

/// Adds the pairs up to the largest distance to the observations, and forms the control anew with
/// it; or forms all pairs anew where these are outdated. Collective.
void addFarPairs(AreaSample& sample, const Corrections& corrections, PairSet& pairs);

/// The pairs of a control area; a target is searched for within the largest distance.
AreaObservations matchControl(const AreaSample& sample, std::size_t area, double threshold);

/// Whether any control point lies on a smooth surface of a strip; strips on surfaces that are held
/// fixed count, too.
bool isControlCovered(const PairSet& pairs, const SurveyBlock& block);
/// A warning where no strip has a smooth surface at any control point.
Warnings warningsOfControl(const PairSet& pairs, const SurveyBlock& block);

/// The scale of the error sources: largest scan angle and median intensity. Collective.
ErrorSourceScale sourceScale(const AreaSample& sample, bool to_control);

}  // namespace pcl_als
