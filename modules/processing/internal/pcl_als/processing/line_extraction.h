// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/photogrammetry/roof_lines.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {

struct LineExtractionOptions {
  RoofLineSettings settings;
  StripChoice strips;
  double same_distance = 1.5;  ///< metres: lines of different strips that are the same roof line
  /// Standard deviations of strips where too few lines are seen in several to estimate them.
  LineErrors assumed{0.02, 0.02, 0};
};

/// Lines of a survey, ground frame.
struct ExtractedLines {
  std::vector<ObjectLine> lines;
  LineErrors errors;
  std::string crs;
  struct Strip {
    std::string name;
    std::uint64_t points = 0;  ///< on surfaces
    std::size_t lines = 0;
  };
  std::vector<Strip> strips;
};

/** \brief Finds roof lines in the strips of files and combines them.
 *
 * One strip is in memory at a time: 12 bytes for each of its surface points (last returns, no
 * vegetation, no noise) and a TIN for each thread. InputError for files that cannot be used
 * together and where no strip has points.
 */
ExtractedLines extractLines(const std::vector<std::filesystem::path>& files,
                            const LineExtractionOptions& options,
                            const ProgressCallback& progress = {});

/// Lines by kind and number of strips, and the errors of strips, as text of a few lines.
std::string describe(const ExtractedLines& found);

}  // namespace pcl_als
