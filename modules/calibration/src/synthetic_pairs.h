// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/calibration/flight_plan.h>
#include <pcl_als/survey/survey_map.h>

#include "pair_observation.h"

namespace pcl_als {

/// The strips of a block and the pairs between them, for a further adjustment.
struct ObservedBlock {
  std::vector<StripGeometry> strips;           ///< by the index that observations use
  std::vector<TimeSpan> spans;                 ///< firing times
  std::vector<AreaObservations> observations;  ///< by area; misclosures are not used
  std::vector<std::vector<double>> weights;    ///< as for Adjustment::accumulate
  std::size_t control_points = 0;
  std::string control_text;  ///< what the strips are compared with; empty: control points

  std::size_t observationCount() const;
};

/** \brief Pairs expected between planned lines: rows from the true geometry, noise of the model,
 * misclosure zero.
 *
 * An observation represents many: its weight is the number of pairs of its kind in its area.
 */
class SyntheticPairs {
 public:
  struct Settings {
    NoiseModel noise;
    SurfaceModel surface;
    AreaSelection selection;           ///< areas, and points used at most
    std::size_t candidates = 100'000;  ///< candidate points of all areas together
    double control_sigma = 0.02;       ///< metres
  };
  explicit SyntheticPairs(const Settings& settings) : settings_(settings) {}

  /// Adds a strip whose times follow all others; returns its index.
  static int addStrip(StripGeometry strip, ObservedBlock& block);
  /// Adds pairs of the strips from \a first on with all strips, in areas of their own.
  void addPairs(int first, ObservedBlock& block) const;
  /// Adds vertical control at a place, for every strip that covers it; false when none does.
  bool addControl(const Eigen::Vector2d& place, ObservedBlock& block) const;
  /// \a count places, distributed over the ground that the strips cover.
  static std::vector<Eigen::Vector2d> spread(std::size_t count,
                                             const std::vector<StripGeometry>& strips);

 private:
  struct Sample;
  class Uses;
  using Places = std::vector<Eigen::Vector2d>;

  Places chooseAreas(int first, const ObservedBlock& block) const;
  std::vector<Sample> samplesOf(const Eigen::Vector2d& corner) const;
  SurfacePoint groundAt(const Eigen::Vector2d& place) const;
  Eigen::Vector2d middleOf(const Eigen::Vector2d& corner) const;  ///< of the area with this corner
  double pointsIn(double density) const;  ///< of an area, on its usable surface
  std::vector<double> pairsPerSample(const std::vector<Sample>& samples, double density,
                                     double candidates) const;
  void addArea(const Eigen::Vector2d& corner, int first, double candidates,
               ObservedBlock& block) const;
  bool observe(const Sample& sample, const StripGeometry* a, const StripGeometry& b,
               PairObservation& observation) const;

  Settings settings_;
};

}  // namespace pcl_als
