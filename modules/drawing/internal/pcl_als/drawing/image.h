// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/drawing/color.h>

namespace pcl_als {

/// Colours row by row from the upper left corner.
struct Image {
  int width = 0, height = 0;
  std::vector<Color> pixels;

  Image() = default;
  Image(int w, int h, const Color& color = {0, 0, 0, 0})
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), color) {}

  Color& at(int x, int y) { return pixels[index(x, y)]; }
  const Color& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// The bytes of a PNG file: RGB, or RGBA where a pixel is not opaque.
std::vector<std::uint8_t> encodePng(const Image& image);
/// Writes a PNG through AtomicFile; InputError where it cannot be written.
void writePng(const std::filesystem::path& path, const Image& image);

}  // namespace pcl_als
