// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/drawing/canvas.h>

namespace pcl_als {

/// Every text lies in the picture and covers no other.
inline void expectTidy(const Canvas& canvas) {
  const PixelBox all{0.0, 0.0, static_cast<double>(canvas.width()),
                     static_cast<double>(canvas.height())};
  const auto& texts = canvas.texts();
  for (std::size_t i = 0; i < texts.size(); ++i) {
    EXPECT_TRUE(all.contains(texts[i].box)) << "cut off: " << texts[i].text;
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(texts[i].box.overlaps(texts[j].box))
          << "'" << texts[i].text << "' covers '" << texts[j].text << "'";
    }
  }
}

/// Pixels of a colour.
inline int countOf(const Canvas& canvas, const Color& color) {
  const Image image = canvas.image();
  return static_cast<int>(std::count(image.pixels.begin(), image.pixels.end(), color));
}

/// The box of a text that is in a picture once.
inline PixelBox placeOf(const Canvas& canvas, const std::string& text) {
  PixelBox box;
  int found = 0;
  for (const auto& placed : canvas.texts()) {
    if (placed.text != text) continue;
    box = placed.box;
    ++found;
  }
  EXPECT_EQ(found, 1) << text;
  return box;
}

/// A file that is left for people to look at.
inline std::filesystem::path pictureFile(const std::string& name) {
  std::filesystem::create_directories(PCL_ALS_TEST_SCRATCH);
  return std::filesystem::path(PCL_ALS_TEST_SCRATCH) / name;
}

}  // namespace pcl_als
