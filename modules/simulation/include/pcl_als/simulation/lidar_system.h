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

/** \brief The chain from measurements to a ground point, with full rotation matrices.
 *
 * Habib et al. 2011, Eq. (1) for one mirror: X = X_0 + R (P + B u), R = groundFromBody,
 * B = Rz(dkappa) Rx(domega) Ry(dphi) the boresight rotation, P the lever arm (body frame, metres),
 * u = (r + dr) (-sin(S e), 0, -cos(S e)), r the measured range (metres) and e the encoder's angle
 * (radians, positive to the left of flight). To first order B is
 * [[1,-dkappa,dphi],[dkappa,1,-domega],[-dphi,domega,1]].
 */
class LidarSystem {
 public:
  /// \param parameters in internal units (m, rad); scan_angle_scale is S - 1
  explicit LidarSystem(const SystemVector& parameters);

  /// Position of the laser at emission, ground frame.
  Eigen::Vector3d firingPoint(const Eigen::Vector3d& position,
                              const Eigen::Matrix3d& ground_from_body) const {
    return position + ground_from_body * lever_arm_;
  }
  /// Unit vector of the pulse, ground frame.
  Eigen::Vector3d direction(const Eigen::Matrix3d& ground_from_body, double encoder_angle) const;
  /// Measurements of the instrument for a target at a distance.
  double measuredRange(double distance) const { return distance - range_bias_; }
  double distance(double measured_range) const { return measured_range + range_bias_; }

  Eigen::Vector3d groundPoint(const Pose& pose, double encoder_angle, double measured_range) const;

 private:
  Eigen::Vector3d lever_arm_;
  Eigen::Matrix3d body_from_laser_;
  double range_bias_, scale_;
};

}  // namespace pcl_als::simulation
