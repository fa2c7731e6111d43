// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstdint>
#include <type_traits>

#include <Eigen/Core>

namespace pcl_als {

/// Whether a point type has the field gps_time.
template <typename PointT, typename = void>
struct HasGpsTime : std::false_type {};
template <typename PointT>
struct HasGpsTime<PointT, std::void_t<decltype(PointT::gps_time)>> : std::true_type {};

/// Whether it has both return_number and number_of_returns.
template <typename PointT, typename = void>
struct HasReturns : std::false_type {};
template <typename PointT>
struct HasReturns<PointT,
                  std::void_t<decltype(PointT::return_number), decltype(PointT::number_of_returns)>>
    : std::true_type {};

template <typename PointT, typename = void>
struct HasClassification : std::false_type {};
template <typename PointT>
struct HasClassification<PointT, std::void_t<decltype(PointT::classification)>> : std::true_type {};

template <typename PointT, typename = void>
struct HasFlags : std::false_type {};
template <typename PointT>
struct HasFlags<PointT, std::void_t<decltype(PointT::flags)>> : std::true_type {};

template <typename PointT, typename = void>
struct HasUserData : std::false_type {};
template <typename PointT>
struct HasUserData<PointT, std::void_t<decltype(PointT::user_data)>> : std::true_type {};

template <typename PointT, typename = void>
struct HasIntensity : std::false_type {};
template <typename PointT>
struct HasIntensity<PointT, std::void_t<decltype(PointT::intensity)>> : std::true_type {};

template <typename PointT, typename = void>
struct HasSourceId : std::false_type {};
template <typename PointT>
struct HasSourceId<PointT, std::void_t<decltype(PointT::point_source_id)>> : std::true_type {};

template <typename PointT, typename = void>
struct HasScanAngle : std::false_type {};
template <typename PointT>
struct HasScanAngle<PointT, std::void_t<decltype(PointT::scan_angle)>> : std::true_type {};

/** \brief The fields of a point of any type, with PointLidar's defaults where the type lacks one.
 *
 * Fields are found by their names in PointLidar and have its units: gps_time (seconds),
 * return_number and number_of_returns (both or none; 1), classification (ASPRS code; 0), flags
 * (bits of PointFlag; 0), user_data (0), intensity (0), scan_angle (degrees; 0), point_source_id
 * (0).
 */
template <typename PointT>
struct PointFields {
  const PointT& point;

  bool isFinite() const {
    return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
  }
  Eigen::Vector3f position() const { return {point.x, point.y, point.z}; }
  double gpsTime() const {
    if constexpr (HasGpsTime<PointT>::value)
      return static_cast<double>(point.gps_time);
    else
      return 0.0;
  }
  std::uint8_t returnNumber() const {
    if constexpr (HasReturns<PointT>::value)
      return static_cast<std::uint8_t>(point.return_number);
    else
      return 1;
  }
  std::uint8_t numberOfReturns() const {
    if constexpr (HasReturns<PointT>::value)
      return static_cast<std::uint8_t>(point.number_of_returns);
    else
      return 1;
  }
  std::uint8_t classification() const {
    if constexpr (HasClassification<PointT>::value)
      return static_cast<std::uint8_t>(point.classification);
    else
      return 0;
  }
  std::uint8_t flags() const {
    if constexpr (HasFlags<PointT>::value)
      return static_cast<std::uint8_t>(point.flags);
    else
      return 0;
  }
  std::uint8_t userData() const {
    if constexpr (HasUserData<PointT>::value)
      return static_cast<std::uint8_t>(point.user_data);
    else
      return 0;
  }
  float intensity() const {
    if constexpr (HasIntensity<PointT>::value)
      return static_cast<float>(point.intensity);
    else
      return 0.0F;
  }
  std::uint16_t sourceId() const {
    if constexpr (HasSourceId<PointT>::value)
      return static_cast<std::uint16_t>(point.point_source_id);
    else
      return 0;
  }
  float scanAngle() const {
    if constexpr (HasScanAngle<PointT>::value)
      return static_cast<float>(point.scan_angle);
    else
      return 0.0F;
  }
};

}  // namespace pcl_als
