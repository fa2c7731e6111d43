// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/io/point_window.h>
#include <pcl_als/las/las_version.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {

struct PointConversionOptions {
  PointWindow window;  ///< points outside are excluded
  /// Strips whose points are written, those of the points in the window. With StripChoice::split
  /// one file for each strip.
  StripChoice strips;
  /// "las", "laz", "pcd", "ply" or "xyz" of the files in an output folder; empty: that of each
  /// input, with StripChoice::split of the first one.
  std::string format;
  /// With StripChoice::split: points keep their point source ids. Otherwise points of id 7 keep it
  /// where they are one line, and other lines get the numbers from 1 that no strip has, so that the
  /// files are the strips of a survey by themselves.
  bool keep_ids = false;
  /// Without StripChoice::split: the points of every file are written, with these numbers of their
  /// lines; those between lines get 0. For tiles with wrong ids.
  bool number_lines = false;
  /// Version of LAS files that are written; empty: that of the input, 1.4 from files that are no
  /// LAS. Of LAS files the whole files are converted (convertLasVersion()): no window and no strips
  /// then.
  std::optional<LasVersion> las_version;
  bool ascii_ply = false;  ///< PLY files are text
  int threads = 0;         ///< 0: all cores; the result does not depend on it
};

struct PointConversionResult {
  struct Output {
    std::filesystem::path path;
    std::uint64_t points = 0;
  };
  std::vector<Output> outputs;
  std::vector<ExcludedPoints> excluded;  ///< of strips that were not chosen, and in turns
  std::vector<std::string> remarks;  ///< values that a format does not store, files without points
};

/** \brief Converts point files (kPointExtensions) into each other, or writes parts of them.
 *
 * - LAS and LAZ to LAS or LAZ: the records as they are, in their order, with every other byte of
 *   the file. Of a part, the counts and the bounding box of the header are those of its points.
 *   LAS -> LAZ -> LAS gives the same bytes. Records that describe the compression of the input
 *   (laszip, COPC) are replaced or omitted.
 * - to PCD: the fields of PointLidar, in metres, relative to the centre of the points (PcdWriter).
 * - to PLY and XYZ: the fields of PointLidar with coordinates in metres and double
 * (ExchangeWriter).
 * - LAS and LAZ to another version of LAS (convertLasVersion()).
 * - PCD, PLY and XYZ to LAS or LAZ: point format 6, steps of 0.001 in the unit of the CRS.
 *
 * Points are streamed: memory does not grow with the files, except for compressed PCD.
 *
 * \param output a file for one input and without StripChoice::split; otherwise, or where it exists
 * as a folder, a folder, which is made. Its files are named like the inputs or the strips. Points
 * of one strip in several LAS files are joined where their records can be (stepsBetween()).
 *
 * UsageError for an output that is an input or is COPC, for two outputs of one name, and for strips
 * that the files do not have; InputError for files that cannot be used and where no point is left;
 * Cancelled. Every output appears only when it is complete.
 */
PointConversionResult convertPointFiles(const std::vector<std::filesystem::path>& inputs,
                                        const std::filesystem::path& output,
                                        const PointConversionOptions& options = {},
                                        const ProgressCallback& progress = {});

/// Whether an output is a folder: it exists as one, or its name has no extension. \a folder_needed
/// (several inputs, a file for each strip): any name that is neither that of a file that exists nor
/// ends as those of point files do.
bool isConversionFolder(const std::filesystem::path& output, bool folder_needed);
/// UsageError where an output of a file for each strip is no folder.
void requireStripFolder(const std::filesystem::path& output);
/// The name in an output folder of the file that an input becomes; \a format as in the options.
std::string convertedName(const std::filesystem::path& input, const std::string& format);

}  // namespace pcl_als
