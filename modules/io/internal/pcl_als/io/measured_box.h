// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>

#include <pcl_als/common/point_file_info.h>

namespace pcl_als {

/// Properties of a point file with the box of its points, whatever its header states.
struct MeasuredFile {
  PointFileInfo info;
  std::string
      box_remark;  ///< that the header is wrong, with the name of the file; empty: it is not
};

/// Reads the coordinates of all points once, on several threads (0: all cores). InputError for
/// files that PointReader::open() refuses.
MeasuredFile measureBox(const std::filesystem::path& path, int threads = 0);

}  // namespace pcl_als
