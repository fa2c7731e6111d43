// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <string_view>

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als::simulation {

/** \brief Pattern in which a scanner deflects its pulses.
 *
 * The angles are those of LidarSystem: `across` is the angle of the mirror, positive to the left of
 * flight, `along` the deflection forward out of its plane. All rates are constant.
 */
enum class ScannerType {
  oscillating,  ///< mirror: from edge to edge and back (zig-zag on the ground)
  polygon,      ///< rotating polygon: every sweep to the right (parallel lines)
  conical,      ///< Palmer scanner: a cone of half the field of view about the vertical, clockwise
                ///< as seen from above
  rosette,      ///< Risley prisms: two equal deflections that rotate in opposite directions
  dual,         ///< two polygons, the planes of which look forward (channel 0) and back (1)
  cross,        ///< two polygons, the planes of which are turned counter-clockwise about the
                ///< vertical, as seen from above (channel 0), and clockwise (1)
  multi,        ///< beams in a fan along the flight (channel 0 looks back most) that spin about the
                ///< flight direction; pulses are simulated within the field of view only
};

std::string_view nameOf(ScannerType type);

/// The laser unit.
struct ScannerOptions {
  ScannerType type = ScannerType::oscillating;
  int channels = 1;  ///< dual, cross: 2; multi: 2 … 64; others: 1
  /// Radians: of dual from the vertical, of cross from the normal of the flight, of multi from the
  /// vertical to the outermost beams.
  double channel_angle = 0.0;
  double field_of_view = 40.0 * kRadiansPerDegree;  ///< full angle, radians, (0, 90 degrees]
  double divergence = 0.33e-3;        ///< full angle between the 1/e^2 points of the beam, radians
  int max_returns = 5;                ///< per pulse, 1 … 15
  double return_separation = 1.5;     ///< metres: closer echoes are merged
  double detection_threshold = 0.05;  ///< share of the pulse's energy of the weakest return
  double gain = 10000.0;  ///< digital number of a full-footprint target of reflectance 1, normal to
                          ///< the beam, at 1000 m in vacuum
  double range_exponent = 2.0;      ///< signal falls with range to this power
  double incidence_exponent = 1.0;  ///< of surfaces (not leaves): 1 Lambertian

  /// Sets type, channels and channel_angle: "dual" (10 degrees), "cross" (14), "multi" (16
  /// channels, 15 degrees), "multi:32", … UsageError listing the names for any other.
  void setType(std::string_view name);

  /// Rotation from the frame of a channel's mirror to that of the laser unit, 3x3.
  Eigen::Matrix3d laserFromChannel(int channel) const;
  /// Whether a mirror angle is measured: all but conical and rosette.
  bool hasMirrorAngle() const {
    return type != ScannerType::conical && type != ScannerType::rosette;
  }
};

}  // namespace pcl_als::simulation
