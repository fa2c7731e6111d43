// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#ifndef PCL_NO_PRECOMPILE
#define PCL_NO_PRECOMPILE
#endif
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>
#include <pcl/memory.h>
#include <pcl/pcl_macros.h>
#include <pcl/register_point_struct.h>
#include <pcl/type_traits.h>

#include <pcl_als/common/lidar_return.h>

namespace pcl_als {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"  // an unnamed struct, as in all of PCL's points

/** \brief A LiDAR return: 48 bytes, relative to a LocalFrame.
 *
 * Registered with PCL, so PCD files and PCL's filters keep every field (see below for what
 * pcl::VoxelGrid does with the fields that have no mean, such as gps_time).
 */
struct EIGEN_ALIGN16 PointLidar {
  // What PCL_ADD_POINT4D adds. It stands in <pcl/point_types.h>, whose many other point types would
  // cost every source a second of compilation: include that where one of them is used.
  union EIGEN_ALIGN16 {
    float data[4];
    struct {
      float x, y, z;  ///< metres from the LocalFrame's origin
    };
  };
  /// Seconds of the GPS week or adjusted standard GPS time, as in the source file.
  double gps_time = 0.0;
  float intensity = 0.0F;  ///< digital number of the source file
  /// Degrees, with the sign of the source file; not used in the estimation of parameters.
  float scan_angle = 0.0F;
  std::uint16_t point_source_id = 0;  ///< flight line (strip) number
  std::uint8_t return_number = 1;     ///< 1 … number_of_returns
  std::uint8_t number_of_returns = 1;
  std::uint8_t classification = 0;  ///< ASPRS class code
  std::uint8_t flags = 0;           ///< bits of PointFlag
  std::uint8_t user_data = 0;       ///< as in the file; some systems store the scanner channel here

  PointLidar() { x = y = z = 0.0F, data[3] = 1.0F; }
  PointLidar(float px, float py, float pz) { x = px, y = py, z = pz, data[3] = 1.0F; }

  auto getVector3fMap() { return Eigen::Map<Eigen::Vector3f>(data); }
  auto getVector3fMap() const { return Eigen::Map<const Eigen::Vector3f>(data); }
  auto getVector4fMap() { return Eigen::Map<Eigen::Vector4f, Eigen::Aligned>(data); }
  auto getVector4fMap() const { return Eigen::Map<const Eigen::Vector4f, Eigen::Aligned>(data); }
  auto getArray3fMap() { return Eigen::Map<Eigen::Array3f>(data); }
  auto getArray3fMap() const { return Eigen::Map<const Eigen::Array3f>(data); }
  auto getArray4fMap() { return Eigen::Map<Eigen::Array4f, Eigen::Aligned>(data); }
  auto getArray4fMap() const { return Eigen::Map<const Eigen::Array4f, Eigen::Aligned>(data); }
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

#pragma GCC diagnostic pop

}  // namespace pcl_als

POINT_CLOUD_REGISTER_POINT_STRUCT(
    pcl_als::PointLidar,
    (float, x, x)(float, y, y)(float, z, z)(double, gps_time, gps_time)(float, intensity,
                                                                        intensity)(
        float, scan_angle, scan_angle)(std::uint16_t, point_source_id,
                                       point_source_id)(std::uint8_t, return_number, return_number)(
        std::uint8_t, number_of_returns,
        number_of_returns)(std::uint8_t, classification,
                           classification)(std::uint8_t, flags, flags)(std::uint8_t, user_data,
                                                                       user_data))

// pcl::VoxelGrid and related filters merge points through pcl::CentroidPoint, which knows how to
// average a few fields and resets all others. A strip's time, return or source id has no mean
// (points of two passes may share a voxel), so a merged PointLidar takes position and intensity as
// means and every other field, bit for bit, from its first point.

namespace pcl {

// Declared, not included: PCL's headers that use it bring the template and copyPoint().
template <typename PointT>
class CentroidPoint;
template <typename PointInT, typename PointOutT>
void copyPoint(const PointInT& in, PointOutT& out);

template <>
class CentroidPoint<pcl_als::PointLidar> {
 public:
  void add(const pcl_als::PointLidar& point) {
    if (count_ == 0) first_ = point;
    sum_ += Eigen::Vector4d(point.x, point.y, point.z, point.intensity);
    ++count_;
  }

  template <typename PointOutT>
  void get(PointOutT& out) const {
    if (count_ == 0) return;
    const Eigen::Vector4f mean = (sum_ / static_cast<double>(count_)).template cast<float>();
    pcl_als::PointLidar merged = first_;
    merged.x = mean[0], merged.y = mean[1], merged.z = mean[2], merged.intensity = mean[3];
    pcl::copyPoint(merged, out);
  }

  std::size_t getSize() const { return count_; }

 private:
  pcl_als::PointLidar first_;
  Eigen::Vector4d sum_ = Eigen::Vector4d::Zero();
  std::size_t count_ = 0;
};

}  // namespace pcl
