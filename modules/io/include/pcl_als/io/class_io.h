// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// The reason for which a text is no valid class name in the files of this library, such as "has a
/// comma, …"; empty if it is valid. Class names are UTF-8 without control characters, quotes,
/// commas and semicolons, and have at most 100 bytes.
std::string classNameFault(std::string_view name);

/** \brief Reads training or check sites.
 *
 * CSV x,y,class (columns found by name), or GeoJSON (.geojson, .json): features with a property
 * "class" and a Point, MultiPoint, Polygon or MultiPolygon in the ground frame. InputError names
 * file and line or feature; also for a GeoJSON in degrees, which is to be reprojected first, and
 * for a name with classNameFault().
 *
 * \param unit of the coordinates in the file; those of the result are in metres
 */
std::vector<ClassSite> readClassSites(const std::filesystem::path& path,
                                      const LengthUnit& unit = {});

/// A confusion matrix as read from a file, with the classes in the order of the header.
struct CountTable {
  std::vector<std::string> classes;
  std::vector<std::vector<std::int64_t>> counts;  ///< [classified][reference]
};

/// Reads CSV: the header names the reference classes, the first column the classified ones.
/// InputError unless both have the same 2 to 250 names and all counts are integers from 0 to 10^12.
CountTable readCountTable(const std::filesystem::path& path);

/// Whether a CSV is a list of checked points: it has columns "reference" and "classified".
bool holdsCheckedSites(const std::filesystem::path& path);
/// Reads CSV x,y,reference,classified (x, y in metres; an empty class: not classified). InputError
/// names file, line and column.
std::vector<CheckedSite> readCheckedSites(const std::filesystem::path& path);
/// Writes such a CSV, with coordinates in millimetres.
void writeCheckedSites(const std::filesystem::path& path, const std::vector<CheckedSite>& sites);

}  // namespace pcl_als
