// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pcl_als/io/las_file.h>

namespace pcl_als::detail {

inline constexpr std::uint16_t kWktRecord = 2112, kGeoKeyRecord = 34735;

/// The CRS of a file's WKT or GeoTIFF records: WKT or "EPSG:n"; empty when there is none.
std::string readLasCrs(const LasFile& file);

/** \brief The record that carries \a crs in a new file: WKT as it is; an EPSG code as WKT through
 * PROJ where the build has it, else as GeoTIFF keys. Empty crs: no record.
 *
 * \param wkt_wanted formats 6-10 ask for WKT
 */
std::vector<LasVlr> lasCrsRecords(const std::string& crs, bool wkt_wanted);

}  // namespace pcl_als::detail
