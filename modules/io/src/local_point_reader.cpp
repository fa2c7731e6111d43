// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/crs/crs.h>
#include <pcl_als/io/local_point_reader.h>

namespace pcl_als {
namespace {

// Seconds of the week may run on past its end; as adjusted standard time these were September 2011.
constexpr double kLastWeekSecond = 2.0 * 604800.0;

}  // namespace

bool LocalPointReader::read(PointChunk& chunk) {
  // A block may hold invalid points only; the end is where the points end.
  bool more = readLocal(chunk);
  while (more && chunk.size() == 0) more = readLocal(chunk);
  for (double& x : chunk.x) x += origin_.x();
  for (double& y : chunk.y) y += origin_.y();
  for (double& z : chunk.z) z += origin_.z();
  return more;
}

void LocalPointReader::survey(const Eigen::Vector3d& origin, bool has_times) {
  origin_ = origin;
  info_.crs_kind = describeCrs(info_.crs).kind;
  info_.point_count = 0;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
  bool in_week = true;
  PointChunk chunk;
  while (readLocal(chunk)) {
    info_.point_count += chunk.size();
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const Eigen::Vector3d point(chunk.x[i], chunk.y[i], chunk.z[i]);
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
      in_week = in_week && chunk.gps_time[i] >= 0.0 && chunk.gps_time[i] <= kLastWeekSecond;
    }
  }
  if (info_.point_count == 0) low = high = Eigen::Vector3d::Zero();
  info_.minimum = low + origin;
  info_.maximum = high + origin;
  const double largest = low.cwiseAbs().cwiseMax(high.cwiseAbs()).maxCoeff();
  info_.resolution.setConstant(std::max(1e-6, largest * std::ldexp(1.0, -23)));
  if (has_times) info_.time_kind = in_week ? TimeKind::week_seconds : TimeKind::adjusted_standard;
  rewind();
}

}  // namespace pcl_als
