// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/bias_prior.h>
#include <pcl_als/common/error_source.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

struct ScanGeometry;

/** \brief Random errors of one return, without systematic effects.
 *
 * The covariance of a ground point is built in the frame of its pulse: range noise along the beam,
 * pointing noise times range across it, the contribution of the footprint where the surface is not
 * perpendicular to the beam, and the short-term noise of the trajectory in all directions. Errors
 * that the points of a strip share (slow trajectory errors) belong to SharedErrorModel.
 */
struct NoiseModel {
  double range = 0.02;  ///< metres, standard deviation along the beam
  double angle =
      10.0 * kRadiansPerArcsec;  ///< radians, pointing (encoder and attitude jitter), each axis
  double position = 0.005;       ///< metres, short-term trajectory noise, each axis
  double beam_divergence =
      0.3e-3;  ///< radians, full angle at 1/e^2; the return comes from anywhere in the footprint

  /// Throws UsageError naming the value that is not finite or negative, or if all are zero.
  void validate() const;

  /// Covariance of a point (m^2, ground frame: east, north, up).
  Eigen::Matrix3d pointCovariance(const ScanGeometry& geometry) const;
  /// Standard deviation of the place within the footprint that a return comes from, rad.
  double footprint() const { return 0.25 * beam_divergence; }
  /// The part of it across the beam: pointing and footprint.
  Eigen::Matrix3d pointingCovariance(const ScanGeometry& geometry) const;
};

/** \brief Errors that observations share and that do not average out over the points of a strip.
 *
 * Trajectory: each of six errors of a strip (east, north, up; pitch, roll, heading about the flight
 * line) has the given standard deviation and is the sum of three independent components: a
 * constant, a smooth component (a cubic B-spline with independent coefficients, a quarter of the
 * correlation time apart; its autocorrelation is close to a Gaussian function) and a first-order
 * Gauss-Markov process with correlation exp(-|dt| / correlation_time). Strips are independent.
 * Defaults: post-processed survey-grade GNSS/INS. The variance of a Gauss-Markov process alone
 * would be estimated mainly from changes within seconds, and be too small where errors are smooth.
 *
 * Local: the remaining errors of a strip between the knots, and those of the surface, are one shift
 * of the strip (east, north, up) in every area, independent from area to area.
 *
 * Error sources (ErrorSource) are common to all points, and each may be absent. slope_ranging: a
 * pulse that hits a surface at incidence theta returns stretched over d = range * divergence *
 * tan(theta), and the recorded time shifts with it, by an unknown share of d. range_scale: also
 * where it is absent, the refractive index, which changes by 1 ppm with a degree or 3 hPa, is the
 * mean over a column of air that is measured at its ends only.
 */
struct SharedErrorModel {
  double position = 0.02;                       ///< metres, each axis
  double roll_pitch = 8.0 * kRadiansPerArcsec;  ///< radians
  double heading = 16.0 * kRadiansPerArcsec;    ///< radians
  double correlation_time = 20.0;               ///< seconds
  double constant_share = 0.2;                  ///< of the variance: the constant
  double smooth_share = 0.4;                    ///< of the variance: the smooth component
  double knot_spacing = 1.0;                    ///< seconds, between knots of the linear splines
                                                ///< used for the trajectory
  double local = 0.01;                          ///< metres, each axis

  /// Prior of the value of an error source: normal, mean zero.
  struct SourcePrior {
    double std;               ///< where it is present
    double absent;            ///< probability that it is absent, [0, 1)
    double std_absent = 0.0;  ///< where it is absent
  };
  /// An error source is determined where its standard deviation is less than this share of the
  /// prior's.
  static constexpr double kDetermined = 0.25;
  /// The same of an estimate that differs from zero: it is not determined where its standard
  /// deviation is large and it may be zero. An error that is larger than expected increases the
  /// variance components, and with them its own standard deviation, until it is estimated.
  static bool isDetermined(double value, double std, double prior_std);
  std::array<SourcePrior, kErrorSourceCount> sources{{
      {0.1, 0.5},                       // slope_ranging
      {2e-4, 0.9, 3e-6},                // range_scale
      {5e-3, 0.9},                      // time_offset
      {30.0 * kRadiansPerArcsec, 0.9},  // mirror_torsion
      {30.0 * kRadiansPerArcsec, 0.9},  // encoder_cubic
      {0.01, 0.9},                      // intensity_ranging
      {30.0 * kRadiansPerArcsec, 0.9},  // encoder_quadratic
      {5e-4, 0.9},                      // deflection_scale
      {0.5, 0.5},                       // height_offset; absent as often as a range bias
      {0.5, 0.9},                       // east_offset
      {0.5, 0.9},                       // north_offset
  }};

  BiasPrior biases;  ///< what is known of the system parameters

  void validate() const;  ///< UsageError naming a value that is not positive and finite

  /// The model of a post-processed GNSS/INS of a grade, by data sheets of typical systems: "survey"
  /// (0.02 m, 9" roll and pitch, 18" heading), "tactical" (0.03 m, 54", 126"), "mems" (0.04 m, 90",
  /// 288"). UsageError for another word.
  static SharedErrorModel ofGrade(const std::string& grade);
};

/** \brief Standard deviation above which a parameter counts as not determined by the data.
 *
 * Estimates with a larger standard deviation are no improvement on a newly mounted system. Below
 * the limits, estimating a parameter is better than holding it: parameters correlated with it
 * (pitch with lever_arm_y) are correct only together with it, and a parameter held at a wrong value
 * resembles trajectory errors.
 */
struct DeterminationLimits {
  double lever_arm = 0.08;                       ///< metres
  double roll_pitch = 60.0 * kRadiansPerArcsec;  ///< radians
  double heading = 180.0 * kRadiansPerArcsec;    ///< radians
  double range = 0.10;                           ///< metres
  double scan_angle_scale = 3e-4;                ///< unitless
  /// Metres: an estimate within two standard deviations of zero, one of which moves points at the
  /// edge of the swath by more, is called not determined. As the limit of lever arms, and the RMSDz
  /// that the USGS Lidar Base Specification allows at QL1 and QL2.
  double on_points = 0.08;

  /// The limits for a flying height (metres above ground): those of angles and of the scale are
  /// larger below 275 m, where 60 arcsec move points by less than a lever arm's limit does.
  DeterminationLimits atHeight(double height) const;
  double of(SystemParameter p) const;
  /// Standard deviation of a parameter that is not estimated, which the uncertainty of the others
  /// includes: 5 cm for lever arms, which can be surveyed; twice the limit for the others.
  double whenHeld(SystemParameter p) const;
};

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
  PerSystemParameters own;  ///< what systems have of their own
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
  AreaSelection selection;
  std::size_t candidates = 100'000;   ///< candidate points of all areas together
  std::size_t pair_budget = 0;        ///< pairs that are adjusted (PairSelection); 0: all
  double max_normal_distance = 2.0;   ///< metres, at the start; shrinks with the misfit
  double control_sigma = 0.02;        ///< metres, for control points whose file gives none
  double minimum_overlap = 2000.0;    ///< m^2, least overlap of a pair of strips
  std::size_t minimum_points = 1000;  ///< strips with fewer are excluded
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
