// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <string_view>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Errors of a LiDAR system beyond the eight system parameters, common to all its points.
 *
 * Each has one value (assumed - true) that moves a point by the value times an effect:
 *
 * - slope_ranging: share of the stretch of a pulse on a slope; along the pulse.
 * - range_scale: scale of ranges - 1; the range along the pulse.
 * - time_offset: time of the points - time of the trajectory, seconds; the velocity dX/dt.
 * - mirror_torsion: scan angle error while the mirror turns to the left, radians; to the right it
 *   has the other sign; dX/d(scan angle) times the sign of the scan.
 * - encoder_cubic: scan angle error at the edge of the swath, radians; dX/d(scan angle) P3(angle /
 *   largest).
 * - intensity_ranging: range error of e times the intensity, metres; ln(I / I0) along the pulse.
 * - encoder_quadratic: scan angle error at the edge of the swath, radians; dX/d(scan angle)
 * P2(angle / largest).
 * - deflection_scale: scale of the angle between pulse and axis - 1, of conical and rosette
 *   scanners; that angle times the derivative of X with respect to it. These scanners have no
 *   mirror angle, and no error of its encoder.
 * - height_offset, east_offset, north_offset: offset of the coordinates of the block (points and
 *   trajectory alike), metres; a unit vector. Control and surfaces that are held fixed show it.
 *
 * P2 and P3 are the Legendre polynomials (3 u^2 - 1) / 2 and (5 u^3 - 3 u) / 2, orthogonal to a
 * boresight roll and to a scan angle scale. The scan angle is positive to the left, as in Habib et
 * al. 2011, Eq. (2).
 */
enum class ErrorSource {
  slope_ranging,
  range_scale,
  time_offset,
  mirror_torsion,
  encoder_cubic,
  intensity_ranging,
  encoder_quadratic,
  deflection_scale,
  height_offset,
  east_offset,
  north_offset,
};

inline constexpr int kErrorSourceCount = 11;
using ErrorSourceRow = Eigen::Matrix<double, 1, kErrorSourceCount>;
using ErrorSourceVector = Eigen::Matrix<double, kErrorSourceCount, 1>;
using ErrorSourceMatrix = Eigen::Matrix<double, kErrorSourceCount, kErrorSourceCount>;

constexpr int indexOf(ErrorSource source) {
  return static_cast<int>(source);
}

/// Name, interface unit and factor of one source: interface value = internal value /
/// internal_per_unit.
struct ErrorSourceInfo {
  ErrorSource source;
  std::string_view name;   ///< as in calibration.json
  std::string_view title;  ///< for people
  std::string_view unit;   ///< "ms", "arcsec", "m", "ppm" or "1"
  double internal_per_unit;
  std::string_view hint;  ///< what to do about it
};

/// All, in order.
const std::array<ErrorSourceInfo, kErrorSourceCount>& errorSources();
inline const ErrorSourceInfo& infoOf(ErrorSource source) {
  return errorSources()[static_cast<std::size_t>(indexOf(source))];
}

/// Whether a source is an offset of the coordinates, which the correction of a trajectory contains.
inline bool isOffset(ErrorSource source) {
  return indexOf(source) >= indexOf(ErrorSource::height_offset);
}

/// The offset of the coordinates of a block: east, north, up, metres.
inline Eigen::Vector3d blockOffset(const ErrorSourceVector& values) {
  return {values[indexOf(ErrorSource::east_offset)], values[indexOf(ErrorSource::north_offset)],
          values[indexOf(ErrorSource::height_offset)]};
}

/// What the correction of points for the sources needs besides their values.
struct ErrorSourceScale {
  double largest_angle = 0.0;     ///< radians, the largest scan angle; 0: unknown
  double median_intensity = 0.0;  ///< digital number I0; 0: unknown
  /// Whether the pulses are deflected about an axis (conical and rosette scanners) and not by the
  /// angle of a mirror.
  bool about_axis = false;
  /// Whether heights or positions on the ground are known (control, surfaces that are held fixed).
  bool to_control = false;

  /// Whether a scanner of this kind can have the error, and the data can show it.
  bool concerns(ErrorSource source) const {
    if (isOffset(source)) return to_control;
    const bool of_mirror = source == ErrorSource::mirror_torsion ||
                           source == ErrorSource::encoder_cubic ||
                           source == ErrorSource::encoder_quadratic;
    return about_axis ? !of_mirror : source != ErrorSource::deflection_scale;
  }
};

/// One entry of the diagnosis of a calibration: a possible cause of a misfit.
struct ErrorFinding {
  std::string source;        ///< name of the source or of the system parameter
  std::string title;         ///< for people
  std::string unit;          ///< of value and std
  double probability = 0.0;  ///< that the error is present, given the data
  double value = 0.0;        ///< assumed - true, where it is present
  double std = 0.0;          ///< standard deviation of value
  double effect = 0.0;       ///< metres, on the ground at the edge of the highest swath
  bool determined = false;   ///< whether the data can tell presence from absence
  bool corrected = false;    ///< whether the correction of points removes it
  std::string evidence, hint;
};

}  // namespace pcl_als
