// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// One of the six errors of a trajectory at a time.
struct TrajectoryAxis {
  std::string_view name;
  std::string_view unit;                ///< of files and reports: "m", "arcsec"
  double internal_per_unit;             ///< m or rad
  std::string_view positive, negative;  ///< what the trajectory is with an error of this sign
};

/// In the order of TrajectoryErrorKnot: east, north, up, pitch, roll, heading. The angles are
/// rotations about the axes of the body, as those of the boresight: a positive one of the heading
/// is anticlockwise, unlike headings from north.
inline constexpr std::array<TrajectoryAxis, 6> kTrajectoryAxes{{
    {"east", "m", 1.0, "too far east", "too far west"},
    {"north", "m", 1.0, "too far north", "too far south"},
    {"up", "m", 1.0, "too high", "too low"},
    {"pitch", "arcsec", kRadiansPerArcsec, "its pitch too large", "its pitch too small"},
    {"roll", "arcsec", kRadiansPerArcsec, "its roll too large", "its roll too small"},
    {"heading", "arcsec", kRadiansPerArcsec, "its heading too small", "its heading too large"},
}};

/// What may have caused a large trajectory correction.
struct CorrectionCause {
  std::string name;      ///< one word for programs: "strip_start"
  std::string evidence;  ///< a sentence without its full stop
};

/** \brief A part of a strip in which the estimated error of its trajectory is larger than
 * trajectory errors ordinarily are.
 *
 * The value is the one that is largest in the interval, assumed - true as in TrajectoryErrorKnot: a
 * trajectory that is 0.27 m too high has up +0.27 m. The interval ends where the error falls to
 * half of it.
 */
struct LargeCorrection {
  std::string strip;
  double from = 0.0, to = 0.0;    ///< seconds, on the trajectory's clock
  double time = 0.0;              ///< of the value, seconds
  std::size_t axis = 0;           ///< of kTrajectoryAxes
  double value = 0.0, std = 0.0;  ///< metres or radians
  /// Standard deviation of an ordinary error in this axis, metres or radians: the prior one, or
  /// that of the rest of the block where it is larger.
  double ordinary = 0.0;
  double on_ground = 0.0;  ///< metres: what it moves a point at the edge of the swath by
  /// East and north of the trajectory at the ends of the interval, metres, ground frame.
  Eigen::Vector2d begin = Eigen::Vector2d::Zero(), end = Eigen::Vector2d::Zero();
  /// Most probable first; empty: none was found in the data.
  std::vector<CorrectionCause> causes;

  const TrajectoryAxis& axisInfo() const { return kTrajectoryAxes[axis]; }
  double ratio() const { return ordinary > 0.0 ? value / ordinary : 0.0; }  ///< with its sign
};

/// "401803 to 401809 s"; with a decimal where the interval is shorter than 3 s.
std::string intervalText(const LargeCorrection& correction);
/// "up +0.27 +- 0.03 m (too high)"
std::string sizeText(const LargeCorrection& correction);
/// The evidence for its causes, or "no cause found in the data".
std::string causeText(const LargeCorrection& correction);
/// "strip 4, 401803 to 401809 s: up +0.27 +- 0.03 m (too high), 13.4 times …; probable cause: …"
std::string describe(const LargeCorrection& correction);

}  // namespace pcl_als
