// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/point_file_info.h>

namespace pcl_als {

/// The CRS and units that the point files of one job have in common.
struct PointReference {
  std::string crs;  ///< of the first file that has one; empty when none has
  /// Units that are converted or assumed, corrections that were applied before, one line each.
  std::vector<std::string> remarks;
};

/** \brief Finds what files have in common, and refuses those that do not belong together.
 *
 * Files in different units of length belong together when their CRS are the same in metres.
 * InputError for map coordinates of different systems, for degrees, and for a file that states no
 * unit beside one that is in feet. Systems with EPSG codes are compared by their definitions,
 * others by the coordinates that they give to the middle of the file: two texts may mean one
 * system.
 */
PointReference commonReference(const std::vector<PointFileInfo>& files);
/// The same of files that are opened for it.
PointReference commonReference(const std::vector<std::string>& paths);

/// What is known of the units, for reports: "US survey foot (GeoTIFF key 3076), heights as well
/// (not stated)".
std::string describeUnits(const PointFileInfo& info);

}  // namespace pcl_als
