// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/raster.h>

namespace pcl_als {

/// A table of a GeoPackage.
struct GeoTable {
  std::string name;
  /// Lines of values, of two columns at least, behind a line of names. A column whose values are
  /// all numbers is one of numbers.
  std::string csv;
  /// One for each line: the cells that are not 0 are its area. Empty: the columns x and y are its
  /// place, metres; a line without a place has none in the file.
  std::vector<CodeRaster> areas = {};
};

/** \brief Writes a GeoPackage (OGC 12-128), which geographic information systems read.
 *
 * Geometries are in the unit of the CRS, columns as they are. Tables without lines are not written.
 * The file is built in memory and written through AtomicFile.
 * \param crs WKT or "EPSG:…"; empty: unknown
 * InputError naming the file for a CRS that PROJ does not know, for a build without GDAL, and where
 * the file cannot be written; UsageError for another number of areas than lines.
 */
void writeGeoPackage(const std::filesystem::path& path, const std::vector<GeoTable>& tables,
                     const std::string& crs);

}  // namespace pcl_als
