// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <system_error>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/point_files.h>

namespace pcl_als {

namespace fs = std::filesystem;

bool isPointExtension(const std::string& extension) {
  return extension == ".las" || extension == ".laz" || extension == ".pcd" || extension == ".ply" ||
         extension == ".xyz";
}

bool isPointFile(const fs::path& file) {
  return isPointExtension(lowerExtension(file));
}

std::vector<std::string> pointFilesIn(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end;
       entry.increment(failed)) {
    std::error_code unknown;
    if (isPointFile(entry->path()) && entry->is_regular_file(unknown))
      files.push_back(entry->path().string());
  }
  if (failed) throw InputError(folder.string() + ": cannot be read: " + failed.message());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace pcl_als
