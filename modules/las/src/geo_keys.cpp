// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "geo_keys.h"

#include <cmath>
#include <cstdint>
#include <utility>

#include <pcl_als/crs/crs.h>

#include "geo_key_projection.h"
#include "las_bytes.h"

namespace pcl_als::detail {
namespace {

using namespace geo_key;

constexpr std::uint16_t kModelProjected = 1, kModelGeographic = 2, kModelGeocentric = 3;
constexpr std::uint16_t kWgs84 = 4326, kWgs84Ellipsoid = 7030;
constexpr std::uint16_t kMetre = 9001, kFoot = 9002, kSurveyFoot = 9003;

bool isWgs84(const GeoKeyDirectory& keys) {
  if (keys.code(kGeographic) == kWgs84 || keys.code(kEllipsoid) == kWgs84Ellipsoid) return true;
  // GRS 80 differs by 1.5e-6 in the inverse flattening.
  return std::abs(keys.number(kSemiMajorAxis).value_or(0.0) - 6378137.0) < 1e-3 &&
         std::abs(keys.number(kInverseFlattening).value_or(0.0) - 298.257223563) < 1e-7;
}

/// 326zz or 327zz; 0 when it is no UTM zone on WGS 84.
unsigned utmCode(const GeoKeyDirectory& keys) {
  const unsigned projection = keys.code(kProjection);
  if (!isWgs84(keys)) return 0;
  if (projection > 16000 && projection <= 16060) return 32600 + (projection - 16000);
  if (projection > 16100 && projection <= 16160) return 32700 + (projection - 16100);
  return 0;
}

std::string epsg(unsigned code) {
  return code == 0 || code == kUserDefinedKey ? std::string() : "EPSG:" + std::to_string(code);
}

/// The unit that a key states by code, or \a size_key by its length in metres (0: no such key).
std::optional<StatedUnit> statedUnit(const GeoKeyDirectory& keys, std::uint16_t key,
                                     std::uint16_t size_key) {
  const std::uint16_t code = keys.code(key);
  if (code == 0) return std::nullopt;
  if (code != kUserDefinedKey) {
    const auto unit = unitOfEpsgCode(code);
    if (!unit) return std::nullopt;
    return StatedUnit{*unit, "GeoTIFF key " + std::to_string(key)};
  }
  const double metres = size_key == 0 ? 0.0 : keys.number(size_key).value_or(0.0);
  if (!(std::isfinite(metres) && metres > 0.0)) return std::nullopt;
  return StatedUnit{lengthUnitOf(metres), "GeoTIFF key " + std::to_string(size_key)};
}

std::optional<StatedUnit> verticalUnit(const GeoKeyDirectory& keys) {
  if (auto unit = statedUnit(keys, kVerticalUnit, 0)) return unit;
  // Codes of GeoTIFF 1.0 that stand for a datum only are no CRS to PROJ.
  const std::string crs = epsg(keys.code(kVertical));
  const CrsDescription description = describeCrs(crs);
  if (description.kind != CrsKind::unknown || !description.vertical) return std::nullopt;
  return StatedUnit{*description.vertical, "GeoTIFF key 4096 (" + crs + ")"};
}

CrsKind kindOf(const GeoKeyDirectory& keys) {
  switch (keys.code(kModelType)) {
    case kModelProjected:
      return CrsKind::projected;
    case kModelGeographic:
      return CrsKind::geographic;
    case kModelGeocentric:
      return CrsKind::geocentric;
    default:
      if (keys.code(kProjected) != 0) return CrsKind::projected;
      return keys.code(kGeographic) != 0 ? CrsKind::geographic : CrsKind::unknown;
  }
}

/// Codes 4000-4999 are those of geographic systems in GeoTIFF 1.0.
bool isGeographicCode(unsigned code) {
  return code >= 4000 && code < 5000;
}

std::uint16_t codeOfUnit(const LengthUnit& unit) {
  if (unit.isMetre()) return kMetre;
  for (const std::uint16_t code : {kFoot, kSurveyFoot})
    if (unitOfEpsgCode(code)->metres == unit.metres) return code;
  return 0;
}

}  // namespace

GeoKeys readGeoKeys(const std::vector<std::byte>& directory,
                    const std::vector<std::byte>& doubles) {
  const GeoKeyDirectory keys(directory, doubles);
  GeoKeys found;
  found.kind = kindOf(keys);
  unsigned code = 0;
  if (found.kind == CrsKind::projected) {
    code = keys.code(kProjected);
    if (code == 0 || code == kUserDefinedKey) code = utmCode(keys);
  } else if (found.kind == CrsKind::geographic) {
    code = keys.code(kGeographic);
  } else if (found.kind == CrsKind::geocentric &&
             describeCrs(epsg(keys.code(kGeographic))).kind == CrsKind::geocentric) {
    code = keys.code(kGeographic);  // may be that of the datum's geographic system
  }
  found.crs = epsg(code);
  found.horizontal = statedUnit(keys, kProjectedUnit, kProjectedUnitSize);
  if (!found.horizontal && found.crs.empty())
    found.horizontal = statedUnit(keys, kGeodeticUnit, kGeodeticUnitSize);
  if (found.kind == CrsKind::projected && found.crs.empty())
    found.crs =
        userDefinedProjection(keys, found.horizontal ? found.horizontal->unit : LengthUnit());
  found.unknown = found.crs.empty() && (keys.code(kProjected) != 0 || keys.code(kProjection) != 0);
  found.vertical = verticalUnit(keys);
  return found;
}

std::vector<std::byte> geoKeysOfEpsg(unsigned code) {
  const bool geographic = isGeographicCode(code);
  std::vector<std::pair<std::uint16_t, std::uint16_t>> keys;
  keys.emplace_back(kModelType, geographic ? kModelGeographic : kModelProjected);
  keys.emplace_back(geographic ? kGeographic : kProjected, static_cast<std::uint16_t>(code));
  const CrsDescription description = describeCrs(epsg(code));
  const std::uint16_t unit = description.horizontal ? codeOfUnit(*description.horizontal) : kMetre;
  if (unit != kMetre && unit != 0) {
    keys.emplace_back(kProjectedUnit, unit);
    keys.emplace_back(kVerticalUnit, unit);
  }
  std::vector<std::byte> bytes;
  for (const std::size_t number : {std::size_t{1}, std::size_t{1}, std::size_t{0}, keys.size()})
    putNumber(bytes, static_cast<std::uint16_t>(number));
  for (const auto& [key, value] : keys)
    for (const std::uint16_t number : {key, std::uint16_t{0}, std::uint16_t{1}, value})
      putNumber(bytes, number);
  return bytes;
}

}  // namespace pcl_als::detail
