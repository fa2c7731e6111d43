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

/// Why a text cannot name a class in the files of this library, e.g. "has a comma, …"; empty when
/// it can: UTF-8 without control characters, quotes, commas and semicolons, at most 100 bytes.
std::string classNameFault(std::string_view name);

/** \brief Reads training or check sites.
 *
 * CSV x,y,class (columns found by name), or GeoJSON (.geojson, .json): features with a property
 * "class" and a Point, MultiPoint, Polygon or MultiPolygon in the ground frame. InputError names
 * file and line or feature; also for a GeoJSON in degrees, which is to be reprojected first, and
 * for a name with classNameFault().
 *
 * \param unit that the file's coordinates count in; sites are in metres
 */
std::vector<ClassSite> readClassSites(const std::filesystem::path& path,
                                      const LengthUnit& unit = {});

/// A confusion matrix as its file has it, classes in the order of the header.
struct CountTable {
  std::vector<std::string> classes;
  std::vector<std::vector<std::int64_t>> counts;  ///< [classified][reference]
};

/// Reads CSV: the header names the reference classes, the first column the classified ones.
/// InputError unless both have the same names and all counts are whole and not negative.
CountTable readCountTable(const std::filesystem::path& path);

/// Whether a CSV is a list of checked points: it has columns "reference" and "classified".
bool holdsCheckedSites(const std::filesystem::path& path);
/// CSV x,y,reference,classified.
std::vector<CheckedSite> readCheckedSites(const std::filesystem::path& path);
void writeCheckedSites(const std::filesystem::path& path, const std::vector<CheckedSite>& sites);

}  // namespace pcl_als
