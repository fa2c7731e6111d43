// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>

#include <Eigen/Core>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/quality/checked_points.h>

namespace pcl_als {

/** \brief The course of a strip, from its points alone.
 *
 * Least squares of plan position = p0 + velocity time + across scan_angle: with the second term a
 * strip that is cut obliquely does not appear rotated. Where the file has no scan angles, time
 * alone is used. For a strip that turns, the result is the mean direction. Constant memory.
 */
class StripCourse {
 public:
  void add(const LidarReturn& point);
  std::size_t count() const { return count_; }
  /// Plan unit vector; empty where times do not determine it (no times, or a very short strip).
  std::optional<Eigen::Vector2d> direction() const;

  void put(ByteWriter& out) const { out.plain(*this); }
  void get(ByteReader& in) { in.plain(*this); }

 private:
  std::size_t count_ = 0;
  Eigen::Vector2d reference_ = Eigen::Vector2d::Zero();
  double time_reference_ = 0.0;
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();  ///< 1, time, scan angle
  Eigen::Matrix<double, 3, 2> right_ = Eigen::Matrix<double, 3, 2>::Zero();  ///< with x, y
};

}  // namespace pcl_als
