// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/crs/crs.h>

namespace pcl_als::detail {

/// A unit and the key that states it.
struct StatedUnit {
  LengthUnit unit;
  std::string source;  ///< "GeoTIFF key 3076"
};

/// What GeoTIFF keys say.
struct GeoKeys {
  CrsKind kind = CrsKind::unknown;  ///< by the model type, or by the code that is given
  /// "EPSG:n", or WKT of a system whose projection is user-defined (userDefinedProjection());
  /// empty where the keys define none. UTM zones on WGS 84 that are spelled out have their code.
  std::string crs;
  bool unknown = false;                  ///< whether they define one that is not known
  std::optional<StatedUnit> horizontal;  ///< keys 3076 and 3077; else 2052 and 2053
  std::optional<StatedUnit> vertical;    ///< key 4099; else that of the vertical CRS, key 4096
};

/** \brief Reads a key directory. Codes of units are looked up in PROJ's database; those of metre
 * and foot are known without it.
 *
 * \param directory payload of LASF_Projection 34735, \param doubles of 34736 (may be empty)
 */
GeoKeys readGeoKeys(const std::vector<std::byte>& directory, const std::vector<std::byte>& doubles);

/// The key directory of an EPSG code up to 32766; where its coordinates are lengths other than
/// metres, with the keys of both units.
std::vector<std::byte> geoKeysOfEpsg(unsigned code);

}  // namespace pcl_als::detail
