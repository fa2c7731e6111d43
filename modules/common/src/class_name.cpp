// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cstddef>

#include <pcl_als/common/class_name.h>

namespace pcl_als {

std::string className(int code) {
  static constexpr std::array kNames = {"never classified",
                                        "unclassified",
                                        "ground",
                                        "low vegetation",
                                        "medium vegetation",
                                        "high vegetation",
                                        "building",
                                        "low point (noise)",
                                        "model key point",
                                        "water",
                                        "rail",
                                        "road surface",
                                        "overlap",
                                        "wire guard",
                                        "wire conductor",
                                        "transmission tower",
                                        "wire connector",
                                        "bridge deck",
                                        "high noise",
                                        "overhead structure",
                                        "ignored ground",
                                        "snow",
                                        "temporal exclusion"};
  constexpr int kCivilStructure = 26;              // reserved by the standard, used in AHN
  const auto at = static_cast<std::size_t>(code);  // negative codes become large
  if (code == kCivilStructure) return "26 civil structure";
  return std::to_string(code) + (at < kNames.size() ? std::string(" ") + kNames[at] : "");
}

}  // namespace pcl_als
