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

/// Distribution of the slopes of surfaces on which pairs are formed; aspects are uniform.
struct SurfaceModel {
  double ground_slope = 5.0 * kRadiansPerDegree;  ///< RMS slope of open ground; 0: a plane
  double steep_slope = 25.0 * kRadiansPerDegree;  ///< slope of roofs, banks
  double steep_share = 0.0625;                    ///< share of these in the usable surface
  double usable = 0.5;                            ///< share of the points on solid, smooth surfaces
  /// Pairs are chosen evenly over slopes and aspects, as by AreaMatcher, so that steep surfaces
  /// have more pairs than their share; false: the shares are those of the pairs.
  bool balanced = true;
  /// Terrain that replaces ground_slope; empty where it is not known.
  std::function<std::optional<SurfacePoint>(const Eigen::Vector2d&)> terrain;

  void validate() const;  ///< UsageError that names an impossible value
};

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
    SurveyMap::Selection selection;    ///< areas, and points used at most
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
