// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "las_bytes.h"

namespace pcl_als::detail {

/// Code of GeoTIFF: the values are given by other keys.
inline constexpr std::uint16_t kUserDefinedKey = 32767;

/// Number of a key, by its name in GeoTIFF 1.1, chapter 7.
namespace geo_key {
inline constexpr std::uint16_t kModelType = 1024;
inline constexpr std::uint16_t kGeographic = 2048, kDatum = 2050, kPrimeMeridian = 2051;
inline constexpr std::uint16_t kGeodeticUnit = 2052, kGeodeticUnitSize = 2053;
inline constexpr std::uint16_t kAngularUnit = 2054, kAngularUnitSize = 2055;
inline constexpr std::uint16_t kEllipsoid = 2056, kSemiMajorAxis = 2057, kSemiMinorAxis = 2058;
inline constexpr std::uint16_t kInverseFlattening = 2059, kPrimeMeridianLongitude = 2061;
inline constexpr std::uint16_t kProjected = 3072, kProjection = 3074, kMethod = 3075;
inline constexpr std::uint16_t kProjectedUnit = 3076, kProjectedUnitSize = 3077;
inline constexpr std::uint16_t kVertical = 4096, kVerticalUnit = 4099;
}  // namespace geo_key

/// A key directory: entries of (key, place, count, value); the value is an index where it lies in
/// another record.
class GeoKeyDirectory {
 public:
  /// \param directory payload of LASF_Projection 34735, \param doubles of 34736; both must exist as
  /// long as this object
  GeoKeyDirectory(const std::vector<std::byte>& directory, const std::vector<std::byte>& doubles)
      : directory_(directory), doubles_(doubles) {}

  /// 0 where the key is absent.
  std::uint16_t code(std::uint16_t key) const { return valueAt(key, 0).value_or(0); }

  std::optional<double> number(std::uint16_t key) const {
    const auto index = valueAt(key, kDoublesRecord);
    if (!index || 8U * *index + 8U > doubles_.size()) return std::nullopt;
    return loadLas<double>(&doubles_[8U * *index]);
  }

 private:
  static constexpr std::uint16_t kDoublesRecord = 34736;

  std::optional<std::uint16_t> valueAt(std::uint16_t key, std::uint16_t place) const {
    for (std::size_t at = 8; at + 8 <= directory_.size(); at += 8)
      if (loadLas<std::uint16_t>(&directory_[at]) == key &&
          loadLas<std::uint16_t>(&directory_[at + 2]) == place)
        return loadLas<std::uint16_t>(&directory_[at + 6]);
    return std::nullopt;
  }

  const std::vector<std::byte>&directory_, &doubles_;
};

}  // namespace pcl_als::detail
