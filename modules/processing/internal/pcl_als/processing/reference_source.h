// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>

#include <pcl_als/calibration/survey_calibration.h>

namespace pcl_als {

/// The points of a point file (.las, .laz, .pcd). InputError for a file that cannot be read.
ReferenceSource referencePoints(const std::filesystem::path& path);

/** \brief The cells of the first band of a GeoTIFF as points at their centres.
 *
 * Heights count in the unit that the band states, else in that of the vertical axis of the CRS,
 * else in metres. InputError for what RasterReader refuses, and for cells of more than 10 m. Target
 * pcl_als::processing_raster.
 */
ReferenceSource referenceRaster(const std::filesystem::path& path);

/** \brief A reference surface from "FILE[:STD[:OFFSET]]", metres: referenceRaster() of .tif and
 * .tiff, referencePoints() of others.
 *
 * STD and OFFSET are those of ReferenceSurface. UsageError for a standard deviation that is not
 * positive. Target pcl_als::processing_raster.
 */
ReferenceSource openReference(const std::string& text);

}  // namespace pcl_als
