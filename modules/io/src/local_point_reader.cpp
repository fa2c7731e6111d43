// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/crs/crs.h>
#include <pcl_als/io/local_point_reader.h>
#include <pcl_als/io/new_las_file.h>

namespace pcl_als {

bool LocalPointReader::read(PointChunk& chunk) {
  // A block may hold invalid points only; the end is where the points end.
  bool more = readLocal(chunk);
  while (more && chunk.size() == 0) more = readLocal(chunk);
  for (double& x : chunk.x) x += origin_.x();
  for (double& y : chunk.y) y += origin_.y();
  for (double& z : chunk.z) z += origin_.z();
  return more;
}

void LocalPointReader::survey(const Eigen::Vector3d& origin, bool has_times, double relative_step) {
  origin_ = origin;
  info_.crs_kind = describeCrs(info_.crs).kind;
  info_.point_count = 0;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
  double earliest = HUGE_VAL, latest = -HUGE_VAL;
  PointChunk chunk;
  while (readLocal(chunk)) {
    info_.point_count += chunk.size();
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const Eigen::Vector3d point(chunk.x[i], chunk.y[i], chunk.z[i]);
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
      earliest = std::min(earliest, chunk.gps_time[i]);
      latest = std::max(latest, chunk.gps_time[i]);
    }
  }
  if (info_.point_count == 0) low = high = Eigen::Vector3d::Zero();
  info_.minimum = low + origin;
  info_.maximum = high + origin;
  const double largest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  info_.resolution.setConstant(std::max(1e-6, largest * relative_step));
  if (has_times) info_.time_kind = probableTimeKind(earliest, latest);
  rewind();
}

}  // namespace pcl_als
