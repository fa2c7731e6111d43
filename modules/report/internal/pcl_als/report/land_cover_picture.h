// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <vector>

#include <pcl_als/processing/class_maps.h>

namespace pcl_als {

/// Draws maps side by side as a PNG with a legend; in a build without module visualization one
/// picture of their cells, and the legend as NAME_legend.csv beside it.
void drawMaps(const std::filesystem::path& path, const std::vector<TitledMap>& maps);

}  // namespace pcl_als
