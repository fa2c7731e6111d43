// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kRadiansPerDegree = kPi / 180.0;
inline constexpr double kRadiansPerArcsec = kPi / 648000.0;

/// The eight system parameters in the column order of the design block A of Habib et al. 2011, Eq.
/// (8).
enum class SystemParameter {
  lever_arm_x,        ///< dX, metres, body frame (x right)
  lever_arm_y,        ///< dY, metres, body frame (y forward)
  lever_arm_z,        ///< dZ, metres, body frame (z up)
  boresight_pitch,    ///< domega, radians in the library, arc-seconds in files and options
  boresight_roll,     ///< dphi, as boresight_pitch
  boresight_heading,  ///< dkappa, as boresight_pitch
  range_bias,         ///< dr, metres
  scan_angle_scale,   ///< dS, unitless: bias of the scale factor S, whose nominal value is 1
};

inline constexpr int kSystemParameterCount = 8;

/// Biases (assumed - true) or standard deviations of the eight, in internal units (m, rad, 1),
/// indexed by SystemParameter.
using SystemVector = Eigen::Matrix<double, kSystemParameterCount, 1>;
using SystemMatrix = Eigen::Matrix<double, kSystemParameterCount, kSystemParameterCount>;

/// Name, interface unit and factor of one parameter: interface value = internal value /
/// internal_per_unit.
struct SystemParameterInfo {
  SystemParameter parameter;
  std::string_view name;  ///< as in calibration.json and -estimate
  std::string_view unit;  ///< "m", "arcsec" or "1"
  double internal_per_unit;
};

/// The eight parameters, in the order of SystemParameter.
const std::array<SystemParameterInfo, kSystemParameterCount>& systemParameters();

inline int indexOf(SystemParameter p) {
  return static_cast<int>(p);
}
inline const SystemParameterInfo& infoOf(SystemParameter p) {
  return systemParameters()[indexOf(p)];
}

/// Size from which on a bias is refused as implausible, internal units: 100 m for lever arm and
/// range bias, 0.1 rad for boresight angles, 0.1 for the scale.
double largestBias(SystemParameter p);

/// The reason for which a bias in internal units is refused ("1e+06 m is not between -100 and 100
/// m"); empty if it is accepted.
std::string refusedBias(SystemParameter p, double bias);

/// The parameter of that name; empty when there is none.
std::optional<SystemParameter> systemParameterNamed(std::string_view name);

/// Unit normals of the planes in which a scanner with several scan planes (fore and aft, crossing
/// lines) deflects its pulses, in the body frame (right-forward-up), pointing forward. Empty: one
/// plane, across the body.
using ScanPlanes = std::vector<Eigen::Vector3d>;

/// The normal of the plane that is nearest to a pulse, a vector of any length in the body frame.
/// For a pulse in the intersection of planes, all of them give the same scan angle.
inline Eigen::Vector3d scanPlaneOf(const ScanPlanes& planes, const Eigen::Vector3d& in_body) {
  Eigen::Vector3d nearest = Eigen::Vector3d::UnitY();
  double least = -1.0;
  for (const Eigen::Vector3d& normal : planes) {
    const double off = std::abs(normal.dot(in_body));
    if (least >= 0.0 && off >= least) continue;
    least = off;
    nearest = normal;
  }
  return nearest;
}

}  // namespace pcl_als
