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
  const std::vector<double> size = numbersIn(line.text("size"), 'x');
  // Drawing takes some 110 bytes a pixel: larger pictures would end in a lack of memory.
  constexpr double kMostPixels = 40e6;
  if (size.size() == 2 && size[0] >= 200 && size[1] >= 150 && size[0] <= 16384 &&
      size[1] <= 16384 && size[0] * size[1] <= kMostPixels && size[0] == std::floor(size[0]) &&
      size[1] == std::floor(size[1])) {
    return {static_cast<int>(size[0]), static_cast<int>(size[1])};
  }
  throw UsageError(
      "option -size: '" + line.text("size") +
      "' is no WIDTHxHEIGHT from 200x150 to 16384x16384 with 40 million pixels at most");
}

std::string pictureFile(const CommandLine& line) {
  const std::filesystem::path file = line.text("output");
  if (lowerExtension(file) != ".png" && !std::filesystem::is_directory(file))
    throw UsageError("option -output: '" + file.string() + "' does not end in .png");
  checkWritable(file);
  return file.string();
}

std::string namesOf(const std::vector<std::string>& paths) {
  std::string names;
  for (std::size_t i = 0; i < paths.size() && i < 3; ++i) {
    names += (i > 0 ? ", " : "") + std::filesystem::path(paths[i]).filename().string();
  }
  if (paths.size() > 3) names += " and " + std::to_string(paths.size() - 3) + " more";
  return names;
}

}  // namespace pcl_als::app
