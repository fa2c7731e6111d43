// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als::simulation {

/// Position (metres) and attitude (radians: roll right wing down, pitch nose up, heading clockwise
/// from grid north) of the IMU body frame (right-forward-up).
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double roll = 0.0, pitch = 0.0, heading = 0.0;
};

/// ground_from_body = Rz(-heading) Rx(pitch) Ry(roll), 3x3.
Eigen::Matrix3d groundFromBody(double roll, double pitch, double heading);

/// Direction of a pulse in the frame of its mirror (right-forward-up), radians.
struct BeamAngles {
  BeamAngles(double a = 0.0, double b = 0.0) : across(a), along(b) {}

  double across = 0.0;  ///< about the flight direction, positive to the left of flight
  double along = 0.0;   ///< forward, out of the plane of x and z
};

/** \brief The chain from measurements to a ground point, with full rotation matrices.
 *
 * Habib et al. 2011, Eq. (1): X = X_0 + R (P + B C u), R = groundFromBody,
 * B = Rz(dkappa) Rx(domega) Ry(dphi) the boresight rotation, P the lever arm (body frame, metres),
 * C the orientation of the mirror in the laser unit (identity for a single channel) and
 * u = (r + dr) (-sin(S e) cos(a), sin(a), -cos(S e) cos(a)), with r the measured range (metres), e
 * the angle across and a the angle along of BeamAngles. To first order B is
 * [[1,-dkappa,dphi],[dkappa,1,-domega],[-dphi,domega,1]].
 */
class LidarSystem {
 public:
  /// \param parameters in internal units (m, rad); scan_angle_scale is S - 1
  /// \param laser_from_channel C, 3x3
  explicit LidarSystem(const SystemVector& parameters,
                       const Eigen::Matrix3d& laser_from_channel = Eigen::Matrix3d::Identity());

  /// Position of the laser at emission, ground frame.
  Eigen::Vector3d firingPoint(const Eigen::Vector3d& position,
                              const Eigen::Matrix3d& ground_from_body) const {
    return position + ground_from_body * lever_arm_;
  }
  /// Unit vector of the pulse, ground frame.
  Eigen::Vector3d direction(const Eigen::Matrix3d& ground_from_body, const BeamAngles& beam) const;
  /// Unit vector in the frame of the mirror, without a scale.
  static Eigen::Vector3d laserDirection(const BeamAngles& beam);
  /// Measurements of the instrument for a target at a distance.
  double measuredRange(double distance) const { return distance - range_bias_; }
  double distance(double measured_range) const { return measured_range + range_bias_; }

  Eigen::Vector3d groundPoint(const Pose& pose, const BeamAngles& beam,
                              double measured_range) const;

 private:
  Eigen::Vector3d lever_arm_;
  Eigen::Matrix3d body_from_laser_;
  double range_bias_, scale_;
};

}  // namespace pcl_als::simulation
