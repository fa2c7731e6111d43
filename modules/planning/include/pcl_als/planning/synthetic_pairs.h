// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/calibration/noise_model.h>
#include <pcl_als/calibration/pair_observation.h>
#include <pcl_als/planning/strip_geometry.h>
#include <pcl_als/survey/survey_map.h>

namespace pcl_als {

/// A place on the ground: height above the mean ground, metres, and upward unit normal.
struct SurfacePoint {
  double height = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

/// The surfaces that pairs are found on, by their slopes; aspects are even.
struct SurfaceModel {
  double ground_slope = 5.0 * kRadiansPerDegree;  ///< RMS slope of open ground; 0: a plane
  double steep_slope = 25.0 * kRadiansPerDegree;  ///< slope of roofs, banks
  double steep_share = 0.0625;                    ///< their share of the usable surface
  double usable = 0.5;                            ///< share of the points on solid, smooth surfaces
  /// Pairs are taken evenly over slopes and aspects, as AreaMatcher does, so that steep surfaces
  /// count for more than their share; false: the shares are those of the pairs.
  bool balanced = true;
  /// The ground, in place of ground_slope; empty outside what is known.
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d&)> terrain;

  void validate() const;  ///< UsageError naming a value that is impossible
};

/// The strips of a block and the pairs between them: what another adjustment of it needs.
struct ObservedBlock {
  std::vector<StripGeometry> strips;           ///< by the index that observations use
  std::vector<TimeSpan> spans;                 ///< firing times
  std::vector<AreaObservations> observations;  ///< by area; misclosures are not used
  std::vector<std::vector<double>> weights;    ///< as for Adjustment::accumulate
  std::size_t control_points = 0;

  std::size_t observationCount() const;
  /// Every k-th observation of an area with k times its weight, misclosures zero, so that at most
  /// about \a count remain: the same information, to be adjusted again and again.
  ObservedBlock thinned(std::size_t count) const;
};

/** \brief Pairs as a calibration would find them between planned lines: rows from the true
 * geometry, noise of the model, misclosure zero.
 *
 * An observation represents many: its weight is the number of pairs of its kind in its area.
 */
class SyntheticPairs {
 public:
  struct Settings {
    NoiseModel noise;
    SurfaceModel surface;
    SurveyMap::Selection selection;    ///< areas, and points used at most
    std::size_t candidates = 100'000;  ///< candidate points, all areas
    double control_sigma = 0.02;       ///< metres
  };
  explicit SyntheticPairs(const Settings& settings) : settings_(settings) {}

  /// A strip that joins a block, its clock after all others'; returns its index.
  static int addStrip(StripGeometry strip, ObservedBlock& block);
  /// Pairs of the strips from \a first on with all strips, in areas of their own.
  void addPairs(int first, ObservedBlock& block) const;
  /// Vertical control at a place, seen by every strip that covers it; false when none does.
  bool addControl(const Eigen::Vector2d& place, ObservedBlock& block) const;
  /// \a count places, spread over what the strips cover.
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
