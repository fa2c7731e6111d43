// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {

ScanGeometry scanGeometry(const FlightLine& line, const Eigen::Vector3d& ground_point) {
  const Eigen::Vector3d from_sensor = ground_point - line.position;
  ScanGeometry geometry;
  geometry.cos_kappa = line.cos_kappa;
  geometry.sin_kappa = line.sin_kappa;
  geometry.x = from_sensor.x() * line.cos_kappa + from_sensor.y() * line.sin_kappa;
  geometry.z = from_sensor.z();
  const double range = std::hypot(geometry.x, geometry.z);
  if (range > 0.0) {
    geometry.cos_beta = -geometry.z / range;
    geometry.sin_beta = -geometry.x / range;
  }
  geometry.beta = std::atan2(geometry.sin_beta, geometry.cos_beta);
  return geometry;
}

DesignBlock designBlock(const ScanGeometry& geometry) {
  const double c = geometry.cos_kappa, s = geometry.sin_kappa;
  const double x = geometry.x, z = geometry.z, b = geometry.beta;
  DesignBlock design;
  design.row(0) << c, -s, 0.0, s * z, c * z, -s * x, -c * geometry.sin_beta, c * z * b;
  design.row(1) << s, c, 0.0, -c * z, s * z, c * x, -s * geometry.sin_beta, s * z * b;
  design.row(2) << 0.0, 0.0, 1.0, 0.0, -x, 0.0, -geometry.cos_beta, -x * b;
  return design;
}

}  // namespace pcl_als
