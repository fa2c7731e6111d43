// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {

Eigen::Vector3d ScanGeometry::beam() const {
  const double length = range();
  return length > 0.0 ? Eigen::Vector3d(rotation * inBody() / length)
                      : Eigen::Vector3d(-rotation.col(2));
}

namespace {

/// Angle of a direction in the plane with this normal, from the lowest direction of the plane.
double angleInPlane(const Eigen::Vector3d& normal, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d lowest = (normal.z() * normal - Eigen::Vector3d::UnitZ()).normalized();
  return std::atan2(direction.dot(normal.cross(lowest)), direction.dot(lowest));
}

}  // namespace

ScanGeometry scanGeometry(const SensorPose& pose, const Eigen::Vector3d& ground_point) {
  const Eigen::Vector3d in_body = pose.rotation.transpose() * (ground_point - pose.position);
  ScanGeometry geometry;
  geometry.rotation = pose.rotation;
  geometry.x = in_body.x();
  geometry.y = pose.has_attitude ? in_body.y() : 0.0;
  geometry.z = in_body.z();
  if (pose.planes != nullptr) {
    geometry.normal = scanPlaneOf(*pose.planes, geometry.inBody());
    geometry.beta = angleInPlane(geometry.normal, geometry.inBody());
  } else if (geometry.x != 0.0 || geometry.z != 0.0) {
    geometry.beta = std::atan2(-geometry.x, -geometry.z);
  }
  return geometry;
}

DesignBlock designBlock(const ScanGeometry& geometry) {
  const double x = geometry.x, y = geometry.y, z = geometry.z;
  const double range = geometry.range();
  DesignBlock in_body = DesignBlock::Zero();
  in_body.leftCols<3>().setIdentity();
  in_body.col(indexOf(SystemParameter::boresight_pitch)) << 0.0, -z, y;
  in_body.col(indexOf(SystemParameter::boresight_roll)) << z, 0.0, -x;
  in_body.col(indexOf(SystemParameter::boresight_heading)) << -y, x, 0.0;
  in_body.col(indexOf(SystemParameter::range_bias)) =
      range > 0.0 ? Eigen::Vector3d(geometry.inBody() / range) : Eigen::Vector3d(0.0, 0.0, -1.0);
  in_body.col(indexOf(SystemParameter::scan_angle_scale)) = geometry.beta * geometry.turned();
  return geometry.rotation * in_body;
}

Eigen::Matrix3d boresightRotation(const SystemVector& biases) {
  const auto about = [&](SystemParameter p, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(biases[indexOf(p)], axis);
  };
  return (about(SystemParameter::boresight_heading, Eigen::Vector3d::UnitZ()) *
          about(SystemParameter::boresight_pitch, Eigen::Vector3d::UnitX()) *
          about(SystemParameter::boresight_roll, Eigen::Vector3d::UnitY()))
      .toRotationMatrix();
}

Eigen::Vector3d corrected(const SensorPose& pose, const Eigen::Vector3d& ground_point,
                          const SystemVector& biases) {
  const ScanGeometry geometry = scanGeometry(pose, ground_point);
  const Eigen::Vector3d biased = geometry.inBody();
  const Eigen::Vector3d beam = boresightRotation(biases).transpose() * (biased - biases.head<3>());
  const double range = beam.norm();
  if (range == 0.0) return ground_point;
  const double scale = 1.0 + biases[indexOf(SystemParameter::scan_angle_scale)];
  const double angle = angleInPlane(geometry.normal, beam);
  const double length = 1.0 - biases[indexOf(SystemParameter::range_bias)] / range;
  const Eigen::Vector3d measured = Eigen::AngleAxisd(angle / scale - angle, geometry.normal) * beam;
  return ground_point - pose.rotation * (biased - length * measured);
}

}  // namespace pcl_als
