// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pcl_als/classification/surface_rasters.h>

#include "command_line.h"

namespace pcl_als::app {

/// The options of pcl_als_classify.
CommandLine declareClassify();

/// UsageError naming the option, for each of them.
SurfaceOptions surfaceOptionsOf(const CommandLine& line);
/// The raster over the files' box, or over that of -bounds.
RasterGrid gridOf(const CommandLine& line, double min_x, double min_y, double max_x, double max_y,
                  const std::string& crs);

}  // namespace pcl_als::app
