// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "picture_options.h"

namespace pcl_als::app {

const std::vector<std::string>& pictureEndings() {
  static const std::vector<std::string> endings{".png", ".svg", ".pdf"};
  return endings;
}

void addSizeOption(CommandLine& line) {
  line.addText("size", "size of the picture, pixels", "1600x1000").in(Group::output);
}

PictureSize sizeOf(const CommandLine& line) {
  return line.parsed("size", pictureSizeIn);
}

}  // namespace pcl_als::app
