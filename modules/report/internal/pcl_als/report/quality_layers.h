// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/drawing/block_map.h>
#include <pcl_als/report/quality_report.h>

namespace pcl_als {

/** \brief Writes a check as GeoPackage (target pcl_als::report_raster).
 *
 * Tables: strips (outlines of the cells with points, and their area), pairs (the cells that both
 * strips cover, with the columns of pairs.csv), offsets and control (places, with the columns of
 * offsets.csv and control.csv).
 * \param coverage of the strips, by the order of \a names
 * \param crs of the points, WKT or "EPSG:…"; empty: unknown
 * Errors as writeGeoPackage().
 */
void writeQualityLayers(const std::filesystem::path& path, const QualityReport& report,
                        const StripCoverage& coverage, const std::vector<std::string>& names,
                        const std::string& crs);

}  // namespace pcl_als
