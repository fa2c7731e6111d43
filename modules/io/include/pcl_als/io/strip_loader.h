// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/strip.h>
#include <pcl_als/io/point_window.h>
#include <pcl_als/las/las_extra.h>

namespace pcl_als {

/** \brief A field of points besides those of PointLidar.
 *
 * The fields of LAS records are called red, green, blue and nir (16 bits each). A field of another
 * name or type is stored as extra bytes.
 */
struct PointColumn {
  LasExtraField field;         ///< name, description and type; scale and offset in files
  std::vector<double> values;  ///< one per point, raw * scale + offset
};

/// A strip with further fields of its points.
struct StripWithColumns : Strip<PointLidar> {
  std::vector<PointColumn> columns;
};

/** \brief Reads whole point files (.las, .laz, .pcd) and sorts their points into strips.
 *
 * Strips are separated and named by StripNaming and returned in its order; points keep their order
 * in the files. A strip that extends further than LocalFrame::kMaximumExtent from its centre is
 * divided by a grid of 5 km into parts with the same id, each relative to the centre of its square.
 * Coordinates are in metres, whatever the unit of the files. Memory: 48 bytes per point. Files are
 * read twice.
 *
 * UsageError without any file. InputError if a file cannot be read, if files declare different
 * kinds of GPS time, or if their CRS do not agree (commonReference()).
 * \code
 * for (const pcl_als::Strip<>& strip : pcl_als::loadStrips({"strip1.las", "strip2.laz"}))
 *   std::cout << strip.id << ": " << strip.cloud->size() << " points\n";
 * \endcode
 */
std::vector<Strip<PointLidar>> loadStrips(const std::vector<std::filesystem::path>& files);

/// Which points are loaded, and which of their fields.
struct StripLoading {
  PointWindow window;                ///< points outside are excluded
  bool all_columns = false;          ///< load every PointColumn that the files have
  std::vector<std::string> columns;  ///< load these; InputError for one that no file has
};

/** \brief Reads point files as above, with colours, near infrared, user data and extra bytes of
 * .las and .laz files (8 bytes per value), and on request only a part of the files.
 *
 * A field that some files lack is NaN in their points if its type is a floating-point type, else 0.
 * Extra bytes of undocumented type are omitted; arrays of two and three values are NAME[0], NAME[1]
 * and NAME[2]. InputError if the window contains no point.
 */
std::vector<StripWithColumns> loadStrips(const std::vector<std::filesystem::path>& files,
                                         const StripLoading& loading);

}  // namespace pcl_als
