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
 * The covariance of a ground point is the sum of range noise along the beam, pointing noise times
 * range across it, the contribution of the footprint where the surface is not perpendicular to the
 * beam, and the short-term noise of the trajectory in all directions. Errors that are common to the
 * points of a strip (slow trajectory errors) belong to SharedErrorModel.
 */
struct NoiseModel {
  double range = 0.02;  ///< metres, standard deviation along the beam
  /// Radians, standard deviation of the pointing (encoder and attitude jitter), each axis.
  double angle = 10.0 * kRadiansPerArcsec;
  double position = 0.005;  ///< metres, short-term trajectory noise, each axis
  /// Radians, full angle at 1/e^2; the return may come from anywhere in the footprint.
  double beam_divergence = 0.3e-3;

  /// UsageError naming a value that is not finite or is negative, or if all are zero.
  void validate() const;

  /// Covariance of a point (m^2, ground frame: east, north, up).
  Eigen::Matrix3d pointCovariance(const ScanGeometry& geometry) const;
  /// Standard deviation of the position of the reflecting surface within the footprint, rad.
  double footprint() const { return 0.25 * beam_divergence; }
  /// The part of pointCovariance() across the beam: pointing and footprint.
  Eigen::Matrix3d pointingCovariance(const ScanGeometry& geometry) const;
};

/** \brief Correlated errors of the observations, which do not average out over the points of a
 * strip.
 *
 * Trajectory: each of six errors of a strip (east, north, up; pitch, roll, heading about the flight
 * line) has the given standard deviation and is the sum of three independent components: a
 * constant, a smooth component (a cubic B-spline with independent coefficients, a quarter of the
 * correlation time apart; its autocorrelation is close to a Gaussian function) and a first-order
 * Gauss-Markov process with correlation exp(-|dt| / correlation_time). Strips are independent.
 * Defaults: post-processed survey-grade GNSS/INS. The variance of a Gauss-Markov process alone
 * would be estimated mainly from changes within seconds, and be too small for smooth errors.
 *
 * Local: the remaining errors of a strip between the knots and those of the surface are represented
 * by a shift of the strip (east, north, up) in each area, independent from area to area.
 *
 * Error sources (ErrorSource) are common to all points, and each may be absent. slope_ranging: the
 * echo of a surface with the incidence angle theta is stretched over d = range * divergence *
 * tan(theta), and the recorded range changes by an unknown share of d. range_scale: even without
 * this error the scale is uncertain, because the refractive index of the column of air is known
 * from measurements at its ends only (1 ppm per degree or 3 hPa).
 */
struct SharedErrorModel {
  double position = 0.02;                       ///< metres, each axis
  double roll_pitch = 8.0 * kRadiansPerArcsec;  ///< radians
  double heading = 16.0 * kRadiansPerArcsec;    ///< radians
  double correlation_time = 20.0;               ///< seconds
  double constant_share = 0.2;                  ///< share of the constant in the variance
  double smooth_share = 0.4;                    ///< share of the smooth component in the variance
  double knot_spacing = 1.0;  ///< seconds, between the knots of the trajectory errors
  double local = 0.01;        ///< metres, each axis

  /// Prior of the value of an error source: normal, mean zero.
  struct SourcePrior {
    double std;               ///< if the error is present
    double absent;            ///< probability that it is absent, [0, 1)
    double std_absent = 0.0;  ///< if it is absent
  };
  /// An error source is determined if its standard deviation is less than this share of that of the
  /// prior.
  static constexpr double kDetermined = 0.25;
  /// Whether an error source is determined: by kDetermined, or because its value is more than four
  /// standard deviations from zero. The second condition is needed because an error that is larger
  /// than expected increases the variance components, and with them its own standard deviation,
  /// until it is estimated.
  static bool isDetermined(double value, double std, double prior_std);
  /// Priors by ErrorSource, in the internal unit of each source.
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

  BiasPrior biases;  ///< prior of the system parameters

  void validate() const;  ///< UsageError naming a value that is not positive and finite

  /// The model of a post-processed GNSS/INS of a grade, from data sheets of typical systems:
  /// "survey" (0.02 m, 9" roll and pitch, 18" heading), "tactical" (0.03 m, 54", 126"), "mems"
  /// (0.04 m, 90", 288"). UsageError for another grade.
  static SharedErrorModel ofGrade(const std::string& grade);
};

/** \brief Standard deviations above which a parameter counts as not determined by the data.
 *
 * Estimates with a larger standard deviation are no improvement on a newly mounted system. Below
 * the limits, a parameter is estimated rather than held: parameters that are correlated with it
 * (pitch with lever_arm_y) are correct only together with it, and the effect of a parameter that is
 * held at a wrong value resembles trajectory errors.
 */
struct DeterminationLimits {
  double lever_arm = 0.08;                       ///< metres
  double roll_pitch = 60.0 * kRadiansPerArcsec;  ///< radians
  double heading = 180.0 * kRadiansPerArcsec;    ///< radians
  double range = 0.10;                           ///< metres
  double scan_angle_scale = 3e-4;                ///< unitless
  /// Metres. An estimate within two standard deviations of zero is reported as not determined if
  /// one standard deviation moves points at the edge of the swath by more than this. The value is
  /// that of lever arms, and the RMSDz allowed by the USGS Lidar Base Specification for QL1 and
  /// QL2.
  double on_points = 0.08;

  /// The limits for a flying height (metres above ground). Below 275 m those of angles and scale
  /// are larger, because 60 arcsec move points by less than the limit of lever arms there.
  DeterminationLimits atHeight(double height) const;
  double of(SystemParameter p) const;  ///< the limit of a parameter, internal unit
  /// A priori standard deviation of a parameter that is not estimated, which is included in the
  /// uncertainty of the others: 5 cm for lever arms, which can be surveyed; otherwise twice the
  /// limit.
  double whenHeld(SystemParameter p) const;
};

/** \brief A fixed surface with which strips are compared: the points of another survey (airborne,
 * mobile, terrestrial) or the cells of a height raster.
 *
 * Its points are surface points (isSurfacePoint()) in the CRS of the block.
 */
struct ReferenceSurface {
  std::string name;  ///< for messages and results, such as the name of the file
  /// Standard deviation along the normal, metres, > 0. It is used both for single points, which are
  /// independent of each other, and for the surface as a whole in an area of 50 m.
  double std = 0.02;
  /// A priori standard deviation of a height error common to all points (datum, geoid), metres; 0:
  /// no such error.
  double offset = 0.0;
};

/// All settings of a calibration. The defaults suit post-processed flights at 500-3000 m height.
/// calibrateSurvey() throws a UsageError for impossible values.
struct CalibrationSettings {
  std::vector<SystemParameter> estimate;  ///< empty: all that the data determine
  /// Standard deviation of the heights of a trajectory that was reconstructed from the points,
  /// metres; it is included in the standard deviations of the parameters. Warnings then do not
  /// advise examining the trajectory.
  std::optional<double> reconstructed_height_std;
  /// Systems with separate parameters. Strips that are in no group belong to the first system.
  /// Empty: one system. UsageError for a strip that does not exist or is in two groups.
  std::vector<StripGroup> systems;
  PerSystemParameters own;  ///< the parameters that may differ between systems
  /// Ids or passes of strips that are held fixed, such as those of an earlier delivery which the
  /// block joins. They have no biases. Their errors are trajectory errors with the a priori
  /// variances of the other strips, and an error common to all of them; they are not corrected for
  /// either. UsageError for a strip that does not exist.
  std::vector<std::string> fixed;
  double fixed_sigma = 0.02;  ///< metres, common error of the fixed strips, each axis
  NoiseModel noise;
  SharedErrorModel shared_errors;
  DeterminationLimits limits;
  SurfaceCriterion patches;
  AreaSelection selection;
  std::size_t candidates = 100'000;   ///< number of candidate points in all areas together
  std::size_t pair_budget = 0;        ///< number of pairs in the adjustment; 0: all
  double max_normal_distance = 2.0;   ///< metres, initial threshold of pairs; decreases later
  double control_sigma = 0.02;        ///< metres, for control points whose file states none
  double minimum_overlap = 2000.0;    ///< m^2, smallest overlap of a pair of strips
  std::size_t minimum_points = 1000;  ///< strips with fewer are excluded
  /// If the trajectory has no attitude: recover pitch and crab from the points (AttitudeRecovery).
  /// False: the system is assumed to be vertical and aligned with the flight line, as in the paper.
  bool recover_attitude = true;
  /// Examine error sources (ErrorSource) and estimate those that the data support.
  bool diagnose = true;
  double resolution = 0.001;  ///< metres, step of the coordinates in the files
  /// Largest number of iterations after the coarse stage, which has at most 12. With a pair_budget
  /// twice as many, because most of them use few pairs.
  int max_iterations = 20;
  /// Metres. The iteration has converged if no point moves by more, or if no parameter changes by
  /// more than 1/20 of its standard deviation.
  double convergence = 2e-4;
  /// Continue with warnings if the trajectory or its attitude cannot belong to the points.
  bool force = false;
  int threads = 0;  ///< 0: all cores; the result does not depend on it
};

}  // namespace pcl_als
