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
 * Fields of LAS records are called red, green, blue and nir (16 bits each);
 * a field of another name or type is stored as extra bytes.
 */
struct PointColumn {
  LasExtraField field;         ///< name, description and type; scale and offset in files
  std::vector<double> values;  ///< one for each point, as raw * scale + offset
};

/// A strip with further fields of its points.
struct StripWithColumns : Strip<PointLidar> {
  std::vector<PointColumn> columns;
};

/** \brief Reads point files (.las, .laz, .pcd) whole and sorts their points into strips.
 *
 * Strips are separated and named by StripNaming and returned in its order; points keep file order.
 * A strip that reaches further than LocalFrame::kMaximumExtent from its centre comes as several
 * parts with the same id, cut by a grid of 5 km, each relative to the centre of its square. Memory:
 * 48 bytes per point. Files are read twice.
 *
 * UsageError without any file. InputError when files declare different kinds of GPS time or CRS
 * that do not agree (commonReference()). Coordinates are in metres, whatever unit the files count
 * in.
 */
std::vector<Strip<PointLidar>> loadStrips(const std::vector<std::filesystem::path>& files);

/// The points and the fields of them that are loaded.
struct StripLoading {
  PointWindow window;                ///< points outside are excluded
  bool all_columns = false;          ///< with every PointColumn that the files have
  std::vector<std::string> columns;  ///< with these; InputError for one that no file has
};

/** \brief The same with colours, near infrared, user data and extra bytes of .las and .laz files,
 * which take 8 bytes per value, and of a part of the files.
 *
 * Points of files that lack a field which others have get NaN where its type is a floating-point
 * one, else 0. Extra bytes of undocumented type are omitted; arrays of two and three values are
 * NAME[0], NAME[1] and NAME[2]. InputError where no point is in the window.
 */
std::vector<StripWithColumns> loadStrips(const std::vector<std::filesystem::path>& files,
                                         const StripLoading& loading);

}  // namespace pcl_als
