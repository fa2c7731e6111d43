// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/calibration/noise_model.h>
#include <pcl_als/calibration/parameter_choice.h>
#include <pcl_als/calibration/shared_errors.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

/** \brief A surface that strips are compared with and that is held fixed: the points of another
 * survey (airborne, mobile, terrestrial) or the cells of a height raster.
 *
 * Its points are those of surfaces as isSurfacePoint() defines them, in the CRS of the block.
 */
struct ReferenceSurface {
  std::string name;  ///< in messages and results, such as the file
  /// Standard deviation along the normal, metres, > 0: of a point, independent of others, and of
  /// the surface in an area of 50 m as a whole.
  double std = 0.02;
  /// A priori standard deviation of a height error that all its points share (datum, geoid),
  /// metres; 0: there is none.
  double offset = 0.0;
};

/// All settings of a calibration. The defaults suit post-processed survey flights of
/// 500-3000 m height.
struct CalibrationSettings {
  std::vector<SystemParameter> estimate;  ///< empty: all that the data determine
  /// Of a trajectory that was reconstructed from the points: the standard deviation of its heights,
  /// metres. The standard deviations of the parameters include it, and nothing advises to examine a
  /// trajectory that nobody gave.
  std::optional<double> reconstructed_height_std;
  /// Systems with parameters of their own; strips that no group names are of the first one. Empty:
  /// one system. UsageError from the engine for a strip that does not exist or is in two groups.
  std::vector<StripGroup> systems;
  OwnUnknowns own;  ///< what systems have of their own
  /// Strips that are held fixed, by id or pass: of an earlier delivery that the block joins. They
  /// have no biases; their errors are those of their own trajectories, which have the a priori
  /// variances of the other strips, and one that all of them share. They are not corrected for
  /// either. UsageError from the engine for a strip that does not exist.
  std::vector<std::string> fixed;
  double fixed_sigma = 0.02;  ///< metres, of the error that fixed strips share, each axis
  NoiseModel noise;
  SharedErrorModel shared_errors;
  DeterminationLimits limits;
  SurfaceCriterion patches;
  SurveyMap::Selection selection;
  std::size_t candidates = 100'000;   ///< candidate points of all areas together
  std::size_t pair_budget = 0;        ///< pairs that are adjusted (PairSelection); 0: all
  double max_normal_distance = 2.0;   ///< metres, at the start; shrinks with the misfit
  double control_sigma = 0.02;        ///< metres, for control points whose file gives none
  double minimum_overlap = 2000.0;    ///< m^2, least overlap of a pair of strips
  std::size_t minimum_points = 1000;  ///< strips with fewer are left out
  /// Without attitude in the trajectory: recover pitch and crab from the points (AttitudeRecovery);
  /// false: a vertical system aligned with the flight line, as in the paper.
  bool recover_attitude = true;
  /// Look for further error sources (ErrorSource) and estimate those that the data support.
  bool diagnose = true;
  double resolution = 0.001;  ///< metres, step of the coordinates in the files
  /// Iterations after the coarse stage, which has at most 12; twice as many with a pair_budget,
  /// because most of these are of few pairs.
  int max_iterations = 20;
  /// Metres: the iteration has converged when no point moves by more, or no parameter changes by
  /// more than 1/20 of its standard deviation.
  double convergence = 2e-4;
  /// Continue, with warnings, where the trajectory or its attitude cannot belong to the points.
  bool force = false;
  int threads = 0;
};

}  // namespace pcl_als
