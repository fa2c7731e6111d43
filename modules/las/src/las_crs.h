// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pcl_als/crs/crs.h>
#include <pcl_als/las/las_file.h>

namespace pcl_als::detail {

inline constexpr std::uint16_t kWktRecord = 2112, kGeoKeyRecord = 34735;

/// The CRS of a file and the units of its coordinates, from its WKT or GeoTIFF records.
struct LasReference {
  std::string crs;  ///< WKT or "EPSG:n"; empty when there is none
  CrsKind kind = CrsKind::unknown;
  LinearUnits units;
  std::string ignored;  ///< PointFileInfo::crs_ignored
  bool by_wkt = false;  ///< whether the CRS is the text of a record
};

/** \brief Reads the reference of a file, as its global encoding prefers.
 *
 * A unit that GeoTIFF keys state stands above the one that the EPSG code implies
 * (GeoTIFF 1.1, 7.5); the CRS is given with that unit then. Keys without a CRS do not replace the
 * WKT. A CRS in degrees is ignored for coordinates that cannot be degrees, a geocentric one for
 * coordinates that are not at the surface of the Earth, and the other record is used where it fits;
 * coordinates within the range of degrees with steps of a micrometre at most, a thousandth of the
 * step of the heights, are degrees where no CRS says otherwise.
 */
LasReference readLasReference(const LasFile& file);

/** \brief The record that carries \a crs in a new file: WKT as it is; an EPSG code as WKT through
 * PROJ where the build has it, else as GeoTIFF keys. Empty crs: no record.
 *
 * \param wkt_wanted formats 6-10 ask for WKT
 */
std::vector<LasVlr> lasCrsRecords(const std::string& crs, bool wkt_wanted);

}  // namespace pcl_als::detail
