// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#ifndef PCL_NO_PRECOMPILE
#define PCL_NO_PRECOMPILE
#endif
#include <cmath>
#include <cstdint>

#include <Eigen/Core>
#include <pcl/memory.h>
#include <pcl/pcl_macros.h>
#include <pcl/register_point_struct.h>
#include <pcl/type_traits.h>

#include <pcl_als/common/point_flag.h>

namespace pcl_als {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpedantic"  // an unnamed struct, as in all of PCL's points

/** \brief A LiDAR return: 48 bytes, relative to a LocalFrame.
 *
 * Registered with PCL, so PCD files and PCL's filters keep every field (see impl/centroid_point.hpp
 * for what pcl::VoxelGrid does with the fields that have no mean, such as gps_time).
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
  double gps_time =
      0.0;  ///< seconds; week seconds or adjusted standard GPS time, as the source file has it
  float intensity = 0.0F;  ///< digital number of the source file
  float scan_angle =
      0.0F;  ///< degrees as recorded in the file, with the file's sign; never used in estimation
  std::uint16_t point_source_id = 0;  ///< flight line (strip) number
  std::uint8_t return_number = 1;     ///< 1 … number_of_returns
  std::uint8_t number_of_returns = 1;
  std::uint8_t classification = 0;  ///< ASPRS class code
  std::uint8_t flags = 0;           ///< bits of PointFlag
  std::uint8_t user_data = 0;       ///< as the file has it; of some systems the scanner channel

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

#include <pcl_als/common/impl/centroid_point.hpp>
