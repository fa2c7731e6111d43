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

/// Role of a parameter in a calibration. Its bias is zero unless it was estimated.
enum class ParameterStatus {
  estimated,
  fixed,         ///< not to be estimated, by request or by default
  not_estimable  ///< the data do not determine it
};

/// Estimate of one system parameter in internal units (m, rad, 1). bias = assumed - true.
struct ParameterEstimate {
  double bias = 0.0;
  double std = 0.0;         ///< standard deviation, including correlated errors
  double std_formal = 0.0;  ///< Habib et al. 2011, Eq. (26): only the noise of points
  ParameterStatus status = ParameterStatus::fixed;
  /// Why the parameter is fixed, not estimable or not determined, or a qualification of the
  /// estimate ("relative to system A"); may be empty.
  std::string reason;
  /// False if the estimate differs from zero by less than two standard deviations and one standard
  /// deviation moves points noticeably (DeterminationLimits::on_points). The estimate is applied
  /// nevertheless, because correlated parameters are correct only together with it.
  bool determined = true;
  /// Share of the variance that is due to the prior, 0 to 1: (C L C)_ii / C_ii with the covariance
  /// C of the model and the information matrix L of the prior. The rest is due to this flight.
  double prior_share = 0.0;
};

/// Comparison of the prior of a parameter with its estimate from the observations, internal units.
struct PriorDifference {
  SystemParameter parameter = SystemParameter::boresight_roll;
  double prior = 0.0, prior_std = 0.0;
  double flight = 0.0, flight_std = 0.0;  ///< estimate without the prior of this parameter
  double change = 0.0, change_std = 0.0;  ///< flight - prior, given the other parameters
  bool significant = false;               ///< prior and flight contradict each other
  bool released = false;  ///< the prior of this parameter was not used for that reason

  /// Absolute change in standard deviations.
  double size() const { return std::abs(change) / change_std; }
};

/** \brief Parameters that were held at zero although their values are not known.
 *
 * Their uncertainty is part of the covariance of the estimates: with the effect F and the a priori
 * standard deviations s, that covariance contains F diag(s^2) F'. If the values v of these
 * parameters become known later, the estimates change by F v.
 */
struct HeldParameters {
  std::vector<SystemParameter> parameters;
  std::vector<double> std;  ///< a priori, internal units
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

/// Fit of one overlapping pair of strips: normal distances of points from patches of the other
/// strip before and after the calibration, metres.
struct PairFit {
  std::string a, b;
  std::size_t correspondences = 0;
  double rms_before = 0.0, rms_after = 0.0, mean_before = 0.0, mean_after = 0.0;
  double rms_strips = 0.0, mean_strips = 0.0;  ///< after, including the strip corrections
};

/// Histogram of the normal distances of all strip pairs (first strip minus second), before and
/// after. The bins extend to 2.5 times the RMS before on either side of zero; larger distances are
/// not counted.
struct ResidualHistogram {
  std::vector<double> edges;  ///< metres; one more than counts
  std::vector<std::size_t> before, after;
};

/// Fit of one strip to control: vertical differences strip - control, metres.
struct ControlFit {
  std::string strip;
  std::size_t points = 0;
  double mean_before = 0.0, rms_before = 0.0, mean_after = 0.0, rms_after = 0.0;
};

/// Fit of the strips to one control point: their mean distance above it, metres. A target has
/// three entries; the other two are the offsets of its position in the strips to the east and
/// north of the surveyed position.
struct ControlPointFit {
  std::string id;
  /// Direction of the distances: "height", "normal" of a patch, "east" or "north" of a target.
  std::string component = "height";
  std::size_t strips = 0;  ///< strips that have a smooth surface at the point
  double sigma = 0.0;      ///< metres, standard deviation of the control point
  double before = 0.0, after = 0.0;
  double expected_std = 0.0;  ///< metres, of \a after: errors of control, points and trajectory
  bool used = true;           ///< false: rejected as an outlier

  bool isInPlan() const { return component == "east" || component == "north"; }
};

/// Fit of the block to a surface that was held fixed: the strips of an earlier delivery (all of
/// them together), or a reference surface.
struct FixedSurface {
  std::string name;                 ///< "fixed strips", or the file of the surface
  std::vector<std::string> strips;  ///< the fixed strips; empty for a reference surface
  double std = 0.0;  ///< a priori standard deviation of its points and of its areas, metres
  double offset_prior = 0.0;  ///< a priori standard deviation of a common height error; 0: none
  std::size_t correspondences = 0;  ///< pairs with other strips
  /// Normal distances of other strips above the surface, metres.
  double mean_before = 0.0, rms_before = 0.0, mean_after = 0.0, rms_after = 0.0;
  /// Height of the surface above the rest of the block (control, trajectory, other surfaces), from
  /// an adjustment in which the height of the surface is unknown, metres.
  double offset = 0.0, offset_std = 0.0;
  bool offset_determined = false;  ///< false: only this surface determines the height of the block
};

/// Height of one strip above all others after the calibration, from the means of its pairs.
struct StripOffset {
  std::string strip;
  double offset = 0.0;        ///< metres
  double expected_std = 0.0;  ///< metres, a priori, of the mean trajectory error of the strip
  bool consistent = true;     ///< false: differs significantly from the rest of the block
};

/// Estimated errors of the trajectory of a strip at one time, assumed - true, with their a
/// posteriori standard deviations (NaN: not known).
struct TrajectoryErrorKnot {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  double time = 0.0;                                   ///< seconds, on the trajectory's clock
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< east, north, up, metres
  /// Rotations about the body axes in the order and with the signs of the boresight angles: pitch,
  /// roll, heading, rad.
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_std = Eigen::Vector3d::Constant(kUnknown);  ///< metres
  Eigen::Vector3d angles_std = Eigen::Vector3d::Constant(kUnknown);    ///< rad

  bool hasStd() const { return position_std.allFinite() && angles_std.allFinite(); }
};

/// A posteriori correlations of the six errors of a strip at one time (east, north, up, pitch,
/// roll, heading).
struct StripErrorCorrelation {
  double time = 0.0;                   ///< seconds, on the trajectory's clock
  Eigen::Matrix<double, 6, 6> errors;  ///< between the errors
  /// With the parameters, in the order of CalibrationResult::correlation_order.
  Eigen::Matrix<double, 6, Eigen::Dynamic> parameters;
};

/// Trajectory errors of one strip (strip corrections), linear between the knots.
struct StripErrors {
  std::string id;
  std::vector<TrajectoryErrorKnot> knots;
  /// Correlations at some of the knots, in order of time; empty: not known.
  std::vector<StripErrorCorrelation> correlations;
};

/// Standard deviations, per axis, of the random errors of points and of the errors of a trajectory
/// whose accuracy is not stated. The defaults are those of NoiseModel and SharedErrorModel.
struct ErrorLevels {
  double range = 0.02;                      ///< metres, along the pulse
  double angle = 10.0 * kRadiansPerArcsec;  ///< rad, of the direction of the pulse
  /// rad, as seen from the sensor: position of the reflecting surface within the footprint. For a
  /// return from anywhere in it, a quarter of the beam divergence (full angle at 1/e^2).
  double footprint = 0.075e-3;
  double position = 0.005;            ///< metres, short-term errors of the trajectory
  double trajectory_position = 0.02;  ///< metres
  double trajectory_roll_pitch = 8.0 * kRadiansPerArcsec;  ///< rad
  double trajectory_heading = 16.0 * kRadiansPerArcsec;    ///< rad
};

/// Error of the scan angle at one scan angle (positive to the left) with its standard deviation,
/// radians.
struct AngleError {
  double angle = 0.0, error = 0.0, std = 0.0;
};

/// One of several systems of a calibration. Parameters that are common to the systems have the
/// same values in all of them.
struct SystemEstimate {
  StripGroup group;
  std::array<ParameterEstimate, kSystemParameterCount> parameters;  ///< indexed by SystemParameter
  /// Standard deviations of the differences from the first system, which are usually better
  /// determined than the parameters; zero for common parameters.
  SystemVector difference_std = SystemVector::Zero();
  /// Offset of the coordinates from those of the first system (east, north, up), assumed - true,
  /// metres.
  Eigen::Vector3d offset = Eigen::Vector3d::Zero(), offset_std = Eigen::Vector3d::Zero();

  SystemUnknowns values() const;  ///< the biases and the offset, internal units
};

/** \brief Result of a calibration, the content of calibration.json.
 *
 * One part belongs to the instrument and applies to all of its flights: system_name, verdict,
 * attitude (its source), scan_planes, parameters, systems, channel_field, sources, source_scale,
 * correlation, prior, held_parameters, line_fit_half_width and error_levels. Another part belongs
 * to the calibration flight: day, recovered_attitude, strip_errors, large_corrections and held. The
 * rest reports on the calibration. SystemCorrection applies the result to points.
 * \code
 * const pcl_als::CalibrationResult calibration = pcl_als::readCalibration("calibration.json");
 * const auto& roll = calibration[pcl_als::SystemParameter::boresight_roll];
 * if (calibration.verdict.usable()) use(roll.bias, roll.std);  // radians
 * \endcode
 */
struct CalibrationResult {
  std::string system_name;     ///< name and serial number of the instrument; empty: not known
  std::optional<long> day;     ///< date of the flight, days since 1980-01-06; none: not known
  CalibrationVerdict verdict;  ///< whether the result may be applied
  AttitudeSource attitude = AttitudeSource::none;
  RecoveredAttitude recovered_attitude;  ///< of the strips, if attitude is AttitudeSource::points
  ScanPlanes scan_planes;                ///< of a scanner with several scan planes
  std::array<ParameterEstimate, kSystemParameterCount> parameters;  ///< indexed by SystemParameter
  /// All systems if there are several; \a parameters are those of the first one.
  std::vector<SystemEstimate> systems;
  std::string channel_field;  ///< field of the files that divides strips by scanner channel
  /// Values (assumed - true) of the error sources that are corrected; zero for the others.
  ErrorSourceVector sources = ErrorSourceVector::Zero();
  ErrorSourceScale source_scale;
  /// Possible causes of the misfit, those of the system parameters first.
  std::vector<ErrorFinding> diagnosis;
  /// Errors of the scan angle as a function of the scan angle, if the data support such a curve.
  /// Their mean is zero.
  std::vector<AngleError> scan_angle_curve;
  std::vector<SystemParameter> correlation_order;  ///< the estimated parameters
  Eigen::MatrixXd correlation;                     ///< of the parameters in that order
  BiasPrior prior;                                 ///< the prior that was used; not any(): none
  /// For the parameters that both the prior and this flight determine.
  std::vector<PriorDifference> prior_differences;
  /// RMS normal distance of all pairs after a correction with the means of the prior and, for
  /// parameters without a prior, with the estimates, metres; NaN without a prior.
  double rms_with_prior = std::numeric_limits<double>::quiet_NaN();
  HeldParameters held_parameters;
  double sigma0 = 0.0;  ///< a posteriori standard deviation of unit weight, Eq. (28)
  long redundancy = 0;
  bool converged = false;
  /// Half width of the local line fit of the trajectory (Trajectory::Options), seconds; also used
  /// when the calibration is applied.
  double line_fit_half_width = 0.0;
  std::vector<CalibrationIteration> iterations;
  std::vector<PairFit> pairs;
  MisfitChange misfit;  ///< of all strip pairs together
  ResidualHistogram residuals;
  std::vector<ControlFit> control;
  std::vector<ControlPointFit> control_points;  ///< the points that a strip covers
  std::vector<FixedSurface> held;               ///< surfaces that were held fixed
  std::vector<StripOffset> strip_offsets;       ///< of the strips that have pairs
  std::vector<StripErrors> strip_errors;        ///< strip corrections of the calibration flight
  /// Parts of the strips whose trajectory errors are larger than ordinary, largest effect on the
  /// ground first.
  std::vector<LargeCorrection> large_corrections;
  std::optional<ErrorLevels> error_levels;  ///< as estimated; none: not known
  /// Weakly determined parameters, the causes, and what would help, one line each.
  std::vector<std::string> observability;
  Warnings warnings;
  std::vector<ExcludedPoints> excluded;  ///< points that were not used
  std::vector<std::string> inputs;       ///< the point files
  std::string crs;  ///< of the ground frame, WKT or "EPSG:…"; empty: not known

  /// One line: verdict, estimates with standard deviations, sigma0.
  std::string briefReport() const;
  /// Tables for a terminal: parameters, pairs, control, diagnosis, verdict, warnings.
  std::string fullReport() const;

  SystemVector biases() const;  ///< of all eight parameters, internal units
  ParameterEstimate& operator[](SystemParameter p) { return parameters[indexOf(p)]; }
  const ParameterEstimate& operator[](SystemParameter p) const { return parameters[indexOf(p)]; }
};

/// The part of a calibration that belongs to the instrument, as a calibration of its own.
CalibrationResult instrumentOf(const CalibrationResult& calibration);

/// The calibration of one of several systems: its parameters and offset. Only the correlations of
/// the first system are stored; those of the other systems are taken as zero. \a name may be empty
/// if there is one system only. UsageError if there is no such system or a name is needed.
CalibrationResult calibrationOfSystem(const CalibrationResult& calibration,
                                      const std::string& name);

/// Whether a flight between two times (seconds, on the trajectory's clock) is another one than the
/// calibration flight, because no strip with strip corrections or recovered attitude was measured
/// between them. False for a calibration that has neither.
bool isOfAnotherFlight(const CalibrationResult& calibration, double from, double to);

/// "estimated", "fixed" or "not_estimable".
std::string_view toString(ParameterStatus status);

}  // namespace pcl_als
