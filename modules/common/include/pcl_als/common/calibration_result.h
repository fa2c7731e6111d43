// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/bias_prior.h>
#include <pcl_als/common/calibration_verdict.h>
#include <pcl_als/common/error_source.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/large_correction.h>
#include <pcl_als/common/recovered_attitude.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

enum class ParameterStatus { estimated, fixed, not_estimable };

/// One system parameter of a calibration, in internal units (m, rad, 1). bias = assumed - true.
struct ParameterEstimate {
  double bias = 0.0;
  double std = 0.0;         ///< standard deviation including errors that pairs share
  double std_formal = 0.0;  ///< Habib et al. 2011, Eq. (26): only the noise of points
  ParameterStatus status = ParameterStatus::fixed;
  std::string reason;  ///< why it is fixed, not estimable, or not determined; otherwise empty
  /// False for an estimate that tells nothing: it does not differ from zero by two standard
  /// deviations, one of which moves points noticeably (DeterminationLimits::on_points). It is
  /// applied nevertheless, because the others are right only together with it.
  bool determined = true;
  /// Part of its variance that stems from the prior, 0 to 1: (C L C)_ii / C_ii, with the covariance
  /// C of the model and the information L of the prior; the rest is from this flight.
  double prior_share = 0.0;
};

/// What a prior and the observations say of a parameter, internal units.
struct PriorDifference {
  SystemParameter parameter = SystemParameter::boresight_roll;
  double prior = 0.0, prior_std = 0.0;
  double flight = 0.0, flight_std = 0.0;  ///< without what the prior says of this parameter
  double change = 0.0, change_std = 0.0;  ///< flight - prior, given the other parameters
  bool significant = false;               ///< they contradict each other
  bool released = false;                  ///< the prior of it was not used, therefore

  /// The change over its standard deviation, a positive number.
  double size() const { return std::abs(change) / change_std; }
};

/** \brief Parameters that were neither estimated nor known, and whose possible size the covariance
 * of the estimates includes.
 *
 * With the effect F and the standard deviations s, it contains F diag(s^2) F'. A later value v of
 * such a parameter (held at zero) changes the estimates by F v.
 */
struct HeldParameters {
  std::vector<SystemParameter> parameters;
  std::vector<double> std;  ///< internal units
  /// Derivatives of the estimates (rows, CalibrationResult::correlation_order) with respect to the
  /// held values (columns), internal units.
  Eigen::MatrixXd effect;
};

/// One iteration of the adjustment.
struct CalibrationIteration {
  std::size_t correspondences = 0;
  double sigma0 = 0.0;
  double largest_update = 0.0;  ///< largest effect of the update on a ground point, metres
};

/// Fit of one overlapping pair of strips; normal distances of points to patches of the other strip,
/// metres.
struct PairFit {
  std::string a, b;
  std::size_t correspondences = 0;
  double rms_before = 0.0, rms_after = 0.0, mean_before = 0.0, mean_after = 0.0;
  double rms_strips = 0.0, mean_strips = 0.0;  ///< after, with the strip corrections
};

/// Normal distances of all strip pairs (the first strip above the second) in bins, before and
/// after. Distances beyond the edges are counted nowhere; edges are 2.5 times the RMS before.
struct ResidualHistogram {
  std::vector<double> edges;  ///< metres; one more than counts
  std::vector<std::size_t> before, after;
};

/// Fit of one strip to control; vertical differences strip - control, metres.
struct ControlFit {
  std::string strip;
  std::size_t points = 0;
  double mean_before = 0.0, rms_before = 0.0, mean_after = 0.0, rms_after = 0.0;
};

/// One control point: mean distance of the strips above it, metres; a target has three, the
/// others are those of its place in the strips to the east and north of the surveyed one.
struct ControlPointFit {
  std::string id;
  /// Direction of the distances: "height", "normal" of a patch, "east" or "north" of a target.
  std::string component = "height";
  std::size_t strips = 0;  ///< that see it on a smooth surface
  double sigma = 0.0;      ///< metres, as stated
  double before = 0.0, after = 0.0;
  double expected_std = 0.0;  ///< metres, of after: control, points and trajectory
  bool used = true;           ///< false: rejected as an outlier

  bool isInPlan() const { return component == "east" || component == "north"; }
};

/// What a calibration held fixed: strips of an earlier delivery (all of them together), or a
/// reference surface. Nothing of it is estimated or corrected.
struct FixedSurface {
  std::string name;                 ///< "fixed strips", or the file of the surface
  std::vector<std::string> strips;  ///< the fixed strips; empty for a reference surface
  double std = 0.0;                 ///< a priori, of its points and of an area of it, metres
  double offset_prior = 0.0;  ///< a priori standard deviation of a common height error; 0: none
  std::size_t correspondences = 0;  ///< pairs with other strips
  /// Normal distances of other strips above it, metres.
  double mean_before = 0.0, rms_before = 0.0, mean_after = 0.0, rms_after = 0.0;
  /// Its height above the rest of the block (control, trajectory, other surfaces) where its height
  /// is not assumed to be known, metres.
  double offset = 0.0, offset_std = 0.0;
  bool offset_determined = false;  ///< false: only this surface determines the height of the block
};

/// Height of one strip above all others after the calibration, from the means of its pairs.
struct StripOffset {
  std::string strip;
  double offset = 0.0;        ///< metres
  double expected_std = 0.0;  ///< metres, a priori: of the mean trajectory error over the strip
  bool consistent = true;     ///< false: differs significantly from the rest of the block
};

/// Estimated errors of the trajectory of a strip at a time, assumed - true, with their a posteriori
/// standard deviations (NaN: not known).
struct TrajectoryErrorKnot {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double time = 0.0;                                   ///< seconds, on the trajectory's clock
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< east, north, up, metres
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();    ///< pitch, roll, heading as boresight, rad
  Eigen::Vector3d position_std = Eigen::Vector3d::Constant(kUnknown);  ///< metres
  Eigen::Vector3d angles_std = Eigen::Vector3d::Constant(kUnknown);    ///< rad

  bool hasStd() const { return position_std.allFinite() && angles_std.allFinite(); }
};

/// A posteriori correlations of the errors of a strip at a time (east, north, up, pitch, roll,
/// heading).
struct StripErrorCorrelation {
  double time = 0.0;                   ///< seconds, on the trajectory's clock
  Eigen::Matrix<double, 6, 6> errors;  ///< with each other
  /// With the parameters, in the order of CalibrationResult::correlation_order.
  Eigen::Matrix<double, 6, Eigen::Dynamic> parameters;
};

/// The errors of one strip, linear between knots.
struct StripErrors {
  std::string id;
  std::vector<TrajectoryErrorKnot> knots;
  /// At some of the knots, in order of time; empty: not known.
  std::vector<StripErrorCorrelation> correlations;
};

/// Standard deviations of the random errors of points, and of the errors of a trajectory of which
/// nothing else is known; each axis. The defaults are those of the models of a calibration.
struct ErrorLevels {
  double range = 0.02;                      ///< metres, along the pulse
  double angle = 10.0 * kRadiansPerArcsec;  ///< rad, of the direction of the pulse
  /// rad, seen from the sensor: of the place within the footprint that the range belongs to. A
  /// quarter of the beam divergence (full angle at 1/e^2) for a return from anywhere in it.
  double footprint = 0.075e-3;
  double position = 0.005;            ///< metres, short-term errors of the trajectory
  double trajectory_position = 0.02;  ///< metres
  double trajectory_roll_pitch = 8.0 * kRadiansPerArcsec;  ///< rad
  double trajectory_heading = 16.0 * kRadiansPerArcsec;    ///< rad
};

/// An error of the scan angle at a scan angle, radians (positive to the left), with its standard
/// deviation.
struct AngleError {
  double angle = 0.0, error = 0.0, std = 0.0;
};

/// One of several systems of a calibration. Parameters that it shares with the others have the
/// same values in all systems.
struct SystemEstimate {
  StripGroup group;
  std::array<ParameterEstimate, kSystemParameterCount> parameters;  ///< indexed by SystemParameter
  /// Standard deviations of the differences to the first system, which are mostly better determined
  /// than the parameters; zero for shared parameters.
  SystemVector difference_std = SystemVector::Zero();
  /// Of its coordinates, assumed - true, relative to the first system; east, north, up, metres.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(), offset_std = Eigen::Vector3d::Zero();

  SystemUnknowns values() const;
};

/** \brief The content of calibration.json.
 *
 * Part of it belongs to the instrument and applies to all of its flights: system_name, verdict,
 * attitude (its source), scan_planes, parameters, systems, channel_field, sources, source_scale,
 * correlation, prior, held_parameters, line_fit_half_width and error_levels. Part of it belongs to
 * the flight that was calibrated with: day, recovered_attitude, strip_errors, large_corrections and
 * held. The rest reports on the calibration.
 */
struct CalibrationResult {
  std::string system_name;     ///< of the instrument, with its serial number; empty: not known
  std::optional<long> day;     ///< of the flight, days since 1980-01-06; none: not known
  CalibrationVerdict verdict;  ///< whether to apply it
  AttitudeSource attitude = AttitudeSource::none;
  RecoveredAttitude recovered_attitude;  ///< of the strips; where attitude is that of points
  ScanPlanes scan_planes;                ///< of a scanner with several planes
  std::array<ParameterEstimate, kSystemParameterCount> parameters;  ///< indexed by SystemParameter
  /// All systems, where there are several: parameters are those of the first one.
  std::vector<SystemEstimate> systems;
  std::string channel_field;  ///< of files, where strips are divided by the scanner's channel
  /// Values (assumed - true) of the error sources that are corrected; zero for the others.
  ErrorSourceVector sources = ErrorSourceVector::Zero();
  ErrorSourceScale source_scale;
  /// Possible causes of the misfit, those of the system parameters first.
  std::vector<ErrorFinding> diagnosis;
  /// Errors of the scan angle as a function of it, where the data support such a curve; their mean
  /// is zero.
  std::vector<AngleError> scan_angle_curve;
  std::vector<SystemParameter> correlation_order;  ///< the estimated ones
  Eigen::MatrixXd correlation;                     ///< in that order
  BiasPrior prior;                                 ///< that was used; not any(): none
  /// Between the prior and this flight, of the parameters of which both say something.
  std::vector<PriorDifference> prior_differences;
  /// RMS normal distance of all pairs corrected with the values of the prior and, of the other
  /// parameters, with the estimates, metres; NaN without a prior.
  double rms_with_prior = std::numeric_limits<double>::quiet_NaN();
  HeldParameters held_parameters;
  double sigma0 = 0.0;
  long redundancy = 0;
  bool converged = false;
  double line_fit_half_width =
      0.0;  ///< seconds: the trajectory window the design used; apply uses the same
  std::vector<CalibrationIteration> iterations;
  std::vector<PairFit> pairs;
  MisfitChange misfit;  ///< of all pairs together
  ResidualHistogram residuals;
  std::vector<ControlFit> control;
  std::vector<ControlPointFit> control_points;  ///< those that a strip sees
  std::vector<FixedSurface> held;               ///< what was held fixed
  std::vector<StripOffset> strip_offsets;       ///< of the strips that have pairs
  std::vector<StripErrors> strip_errors;        ///< of the strips that were calibrated with
  /// Where strip_errors are largest, by their effect on the ground; only what exceeds the ordinary.
  std::vector<LargeCorrection> large_corrections;
  std::optional<ErrorLevels> error_levels;  ///< as estimated; none: not known
  std::vector<std::string> observability;   ///< what is weakly determined, why, and what would help
  Warnings warnings;
  std::vector<ExcludedPoints> excluded;  ///< points that took no part
  std::vector<std::string> inputs;
  std::string crs;  ///< of the ground frame, WKT or "EPSG:…"; empty: not known

  /// One line: verdict, estimates with standard deviations, sigma0.
  std::string briefReport() const;
  /// Tables for a terminal: parameters, pairs, control, diagnosis, verdict, warnings.
  std::string fullReport() const;

  SystemVector biases() const;
  ParameterEstimate& operator[](SystemParameter p) { return parameters[indexOf(p)]; }
  const ParameterEstimate& operator[](SystemParameter p) const { return parameters[indexOf(p)]; }
};

/// The part of a calibration that belongs to the instrument, as a calibration of its own.
CalibrationResult instrumentOf(const CalibrationResult& calibration);

/// The calibration of one of several systems: its parameters and offset, with the correlations of
/// the first system and, for another one, without any, because they are not stored. \a name may be
/// empty where there are no several systems. UsageError: there is no such system, or a name is
/// needed.
CalibrationResult calibrationOfSystem(const CalibrationResult& calibration,
                                      const std::string& name);

/// Whether a flight between two times (seconds, on the trajectory's clock) is not the one that was
/// calibrated with: no strip with trajectory errors or recovered attitude was measured in it. False
/// for a calibration without any.
bool isOfAnotherFlight(const CalibrationResult& calibration, double from, double to);

std::string_view toString(ParameterStatus status);

}  // namespace pcl_als
