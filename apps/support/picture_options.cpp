// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "picture_options.h"

#include <cmath>
#include <filesystem>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>

#include "output_check.h"
#include "window_options.h"

namespace pcl_als::app {
void addSizeOption(CommandLine& line) {
  line.add<std::string>("size", "size of the picture, pixels", "1600x1000");
}

PictureSize sizeOf(const CommandLine& line) {
  return line.parsed("size", pictureSizeIn);
}

std::string pictureFile(const CommandLine& line) {
  const std::filesystem::path file = line.text("output");
  if (lowerExtension(file) != ".png" && !std::filesystem::is_directory(file))
    throw UsageError("option -output: '" + file.string() + "' does not end in .png");
  checkWritable(file);
  return file.string();
}

}  // namespace pcl_als::app
