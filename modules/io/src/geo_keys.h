// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_als::detail {

/** \brief The EPSG code of GeoTIFF keys as "EPSG:n"; empty where they do not tell one.
 *
 * Besides a code, UTM zones on WGS 84 that are spelled out as user-defined (projection 16001-16060
 * or 16101-16160 with the ellipsoid's axes) are recognised, as some writers leave them.
 *
 * \param directory payload of LASF_Projection 34735, \param doubles of 34736 (may be empty)
 */
std::string epsgOfGeoKeys(const std::vector<std::byte>& directory,
                          const std::vector<std::byte>& doubles);

/// The key directory of an EPSG code up to 32766.
std::vector<std::byte> geoKeysOfEpsg(unsigned code);

}  // namespace pcl_als::detail
