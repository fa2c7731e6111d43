// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pcl_als {

/// The extensions of point files: ".las, .laz, .pcd, .ply or .xyz".
inline constexpr const char* kPointExtensions = ".las, .laz, .pcd, .ply or .xyz";
/// Whether points are read and written under this extension, one of kPointExtensions.
bool isPointExtension(const std::string& extension);
/// Whether a file is a point file by its name, in upper or lower case.
bool isPointFile(const std::filesystem::path& file);
/// The point files in a folder, without those of folders in it, sorted by name. InputError where
/// the folder cannot be read.
std::vector<std::string> pointFilesIn(const std::filesystem::path& folder);

}  // namespace pcl_als
