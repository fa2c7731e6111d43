// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/raster.h>

namespace pcl_als {

/// A map with its title.
struct TitledMap {
  std::string caption;
  std::filesystem::path raster;
};

/// Maps with a common legend: the same code means the same class in all of them.
struct ClassMaps {
  std::vector<CodeMeaning> legend;
  std::vector<CodeRaster> maps;
};

/** \brief Reads maps of classes and gives classes of the same name the same code and colour.
 *
 * Rasters with a longer side are reduced, see readCodeRaster(). InputError for a map without names
 * of classes.
 */
ClassMaps readClassMaps(const std::vector<TitledMap>& maps, int largest_side);

/// InputError unless the file is a map with names of classes.
void requireClassMap(const std::filesystem::path& path);

/// Okabe and Ito's, for classes that have no colour of their own.
const std::vector<std::array<std::uint8_t, 3>>& spareColours();

}  // namespace pcl_als
