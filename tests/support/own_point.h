// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

#include <pcl/point_types.h>

#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/point_types.h>

namespace pcl_als::test {

/// A point type of a user: other layout, other integer types, no more fields than are used.
struct EIGEN_ALIGN16 OwnPoint {
  PCL_ADD_POINT4D;
  std::uint16_t classification = 0;
  std::uint16_t number_of_returns = 1;
  double gps_time = 0.0;
  std::uint16_t return_number = 1;
  float intensity = 0.0F;
  std::uint8_t flags = 0;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

template <typename PointT>
typename pcl::PointCloud<PointT>::ConstPtr cloudOf(const pcl::PointCloud<PointLidar>& points) {
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  cloud->reserve(points.size());
  for (const PointLidar& from : points) {
    PointT to;
    to.x = from.x, to.y = from.y, to.z = from.z;
    to.gps_time = from.gps_time;
    to.return_number = from.return_number;
    to.number_of_returns = from.number_of_returns;
    to.classification = from.classification;
    if constexpr (HasIntensity<PointT>::value) to.intensity = from.intensity;
    if constexpr (HasFlags<PointT>::value) to.flags = from.flags;
    cloud->push_back(to);
  }
  return cloud;
}

}  // namespace pcl_als::test

POINT_CLOUD_REGISTER_POINT_STRUCT(
    pcl_als::test::OwnPoint,
    (float, x, x)(float, y, y)(float, z, z)(std::uint16_t, classification, classification)(
        std::uint16_t, number_of_returns, number_of_returns)(double, gps_time, gps_time)(
        std::uint16_t, return_number, return_number)(float, intensity, intensity)(std::uint8_t,
                                                                                  flags, flags))
