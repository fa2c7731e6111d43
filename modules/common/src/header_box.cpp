// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>

#include <pcl_als/common/header_box.h>

namespace pcl_als {
namespace {

Eigen::Array3d toleranceOf(const PointFileInfo& info) {
  return 1.01 * info.resolution.array();
}

std::string cornerText(const Eigen::Vector3d& corner) {
  char text[128];
  // %.3f of 1e300 has 300 digits.
  const bool huge = !(corner.cwiseAbs().maxCoeff() < 1e15);
  std::snprintf(text, sizeof text, huge ? "(%g %g %g)" : "(%.3f %.3f %.3f)", corner.x(), corner.y(),
                corner.z());
  return text;
}

}  // namespace

Eigen::AlignedBox3d boxOf(const PointChunk& chunk, std::size_t from, std::size_t to) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = from; i < to; ++i)
    box.extend(Eigen::Vector3d(chunk.x[i], chunk.y[i], chunk.z[i]));
  return box;
}

bool headerBoxContains(const PointFileInfo& info, const Eigen::AlignedBox3d& points) {
  if (points.isEmpty()) return true;
  const Eigen::Array3d allowed = toleranceOf(info);
  // Comparisons with NaN are false.
  return (points.min().array() >= info.minimum.array() - allowed).all() &&
         (points.max().array() <= info.maximum.array() + allowed).all();
}

bool headerBoxIsRight(const PointFileInfo& info, const Eigen::AlignedBox3d& points) {
  if (points.isEmpty()) return true;
  const Eigen::Array3d allowed = toleranceOf(info);
  return ((points.min() - info.minimum).array().abs() <= allowed).all() &&
         ((points.max() - info.maximum).array().abs() <= allowed).all();
}

std::string headerBoxRemark(const PointFileInfo& info, const Eigen::AlignedBox3d& points) {
  if (headerBoxIsRight(info, points)) return {};
  return "the header's bounding box is wrong: it says " + cornerText(info.minimum) + " to " +
         cornerText(info.maximum) + ", the points reach from " + cornerText(points.min()) + " to " +
         cornerText(points.max());
}

}  // namespace pcl_als
