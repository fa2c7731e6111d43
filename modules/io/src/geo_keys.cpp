// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "geo_keys.h"

#include <cmath>
#include <cstdint>

#include "las_bytes.h"

namespace pcl_als::detail {
namespace {

constexpr std::uint16_t kModelType = 1024, kGeographic = 2048, kEllipsoid = 2056;
constexpr std::uint16_t kSemiMajorAxis = 2057, kInverseFlattening = 2059;
constexpr std::uint16_t kProjected = 3072, kProjection = 3074;
constexpr std::uint16_t kModelProjected = 1, kModelGeographic = 2, kModelGeocentric = 3;
constexpr std::uint16_t kUserDefined = 32767;
constexpr std::uint16_t kDoublesRecord = 34736;
constexpr std::uint16_t kWgs84 = 4326, kWgs84Ellipsoid = 7030;

/// A directory of (key, place, count, value); the value is an index where it lies in a record.
class Directory {
 public:
  Directory(const std::vector<std::byte>& directory, const std::vector<std::byte>& doubles)
      : directory_(directory), doubles_(doubles) {}

  /// 0 where the key is absent.
  std::uint16_t code(std::uint16_t key) const { return valueAt(key, 0); }

  double number(std::uint16_t key) const {
    const std::size_t at = 8U * valueAt(key, kDoublesRecord, 0xFFFF);
    return at + 8 <= doubles_.size() ? loadLas<double>(&doubles_[at]) : 0.0;
  }

 private:
  std::uint16_t valueAt(std::uint16_t key, std::uint16_t place, std::uint16_t absent = 0) const {
    for (std::size_t at = 8; at + 8 <= directory_.size(); at += 8)
      if (loadLas<std::uint16_t>(&directory_[at]) == key &&
          loadLas<std::uint16_t>(&directory_[at + 2]) == place)
        return loadLas<std::uint16_t>(&directory_[at + 6]);
    return absent;
  }

  const std::vector<std::byte>&directory_, &doubles_;
};

bool isWgs84(const Directory& keys) {
  if (keys.code(kGeographic) == kWgs84 || keys.code(kEllipsoid) == kWgs84Ellipsoid) return true;
  // GRS 80 differs by 1.5e-6 in the inverse flattening.
  return std::abs(keys.number(kSemiMajorAxis) - 6378137.0) < 1e-3 &&
         std::abs(keys.number(kInverseFlattening) - 298.257223563) < 1e-7;
}

/// 326zz or 327zz; 0 when it is no UTM zone on WGS 84.
unsigned utmCode(const Directory& keys) {
  const unsigned projection = keys.code(kProjection);
  if (!isWgs84(keys)) return 0;
  if (projection > 16000 && projection <= 16060) return 32600 + (projection - 16000);
  if (projection > 16100 && projection <= 16160) return 32700 + (projection - 16100);
  return 0;
}

}  // namespace

std::string epsgOfGeoKeys(const std::vector<std::byte>& directory,
                          const std::vector<std::byte>& doubles) {
  const Directory keys(directory, doubles);
  if (keys.code(kModelType) == kModelGeocentric) return {};  // the code is that of the datum
  unsigned code = keys.code(kProjected);
  if (code == 0) code = keys.code(kGeographic);
  if (code == kUserDefined) code = utmCode(keys);
  return code == 0 ? std::string() : "EPSG:" + std::to_string(code);
}

std::vector<std::byte> geoKeysOfEpsg(unsigned code) {
  // Codes 4000-4999 are those of geographic systems in GeoTIFF 1.0.
  const bool geographic = code >= 4000 && code < 5000;
  const std::uint16_t model = geographic ? kModelGeographic : kModelProjected;
  const std::uint16_t key = geographic ? kGeographic : kProjected;
  const std::uint16_t numbers[] = {1, 1,     0,   2, kModelType, 0,
                                   1, model, key, 0, 1,          static_cast<std::uint16_t>(code)};
  std::vector<std::byte> bytes;
  for (const std::uint16_t number : numbers) putNumber(bytes, number);
  return bytes;
}

}  // namespace pcl_als::detail
