// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/simulation/lidar_system.h>

namespace pcl_als::simulation {

namespace {

/// Rz(kappa) Rx(omega) Ry(phi).
Eigen::Matrix3d rotation(double omega, double phi, double kappa) {
  const double co = std::cos(omega), so = std::sin(omega);
  const double cp = std::cos(phi), sp = std::sin(phi);
  const double ck = std::cos(kappa), sk = std::sin(kappa);
  Eigen::Matrix3d m;
  m << ck * cp - sk * so * sp, -sk * co, ck * sp + sk * so * cp,  //
      sk * cp + ck * so * sp, ck * co, sk * sp - ck * so * cp,    //
      -co * sp, so, co * cp;
  return m;
}

double valueOf(const SystemVector& parameters, SystemParameter p) {
  return parameters[indexOf(p)];
}

}  // namespace

Eigen::Matrix3d groundFromBody(double roll, double pitch, double heading) {
  return rotation(pitch, roll, -heading);
}

LidarSystem::LidarSystem(const SystemVector& parameters, const Eigen::Matrix3d& laser_from_channel)
    : lever_arm_(parameters.head<3>()),
      body_from_laser_(rotation(valueOf(parameters, SystemParameter::boresight_pitch),
                                valueOf(parameters, SystemParameter::boresight_roll),
                                valueOf(parameters, SystemParameter::boresight_heading)) *
                       laser_from_channel),
      range_bias_(valueOf(parameters, SystemParameter::range_bias)),
      scale_(1.0 + valueOf(parameters, SystemParameter::scan_angle_scale)) {}

Eigen::Vector3d LidarSystem::direction(const Eigen::Matrix3d& ground_from_body,
                                       const BeamAngles& beam) const {
  return ground_from_body * (body_from_laser_ * laserDirection({scale_ * beam.across, beam.along}));
}

Eigen::Vector3d LidarSystem::laserDirection(const BeamAngles& beam) {
  const double in_plane = std::cos(beam.along);
  return {-std::sin(beam.across) * in_plane, std::sin(beam.along),
          -std::cos(beam.across) * in_plane};
}

Eigen::Vector3d LidarSystem::groundPoint(const Pose& pose, const BeamAngles& beam,
                                         double measured_range) const {
  const Eigen::Matrix3d ground_from_body = groundFromBody(pose.roll, pose.pitch, pose.heading);
  return firingPoint(pose.position, ground_from_body) +
         distance(measured_range) * direction(ground_from_body, beam);
}

}  // namespace pcl_als::simulation
