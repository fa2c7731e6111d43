// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "picture_options.h"

namespace pcl_als::app {
void addSizeOption(CommandLine& line) {
  line.addText("size", "size of the picture, pixels", "1600x1000");
}

PictureSize sizeOf(const CommandLine& line) {
  return line.parsed("size", pictureSizeIn);
}

}  // namespace pcl_als::app
