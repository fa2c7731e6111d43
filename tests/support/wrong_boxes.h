// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "las_bytes.h"

namespace pcl_als::test {

/// Position of the bounding box in a LAS header: largest and least x, then y, then z.
inline constexpr std::size_t kBoxAt = 179;

/// A file whose header states the box of other points than its own.
struct WrongBox {
  std::string name, bytes;
};

/// What wrong writers leave in the header of a file of LasBytes.
inline std::vector<WrongBox> wrongBoxes(const LasBytes& las) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  const std::string right = las.str();
  std::array<double, 6> b{};
  std::memcpy(&b, &right[kBoxAt], sizeof b);
  const double half_x = 0.5 * (b[0] + b[1]), half_y = 0.5 * (b[2] + b[3]);
  const std::vector<std::pair<std::string, std::array<double, 6>>> boxes = {
      {"zero", {}},
      {"half", {half_x, b[1], b[2], half_y, b[4], b[5]}},
      {"inverted", {b[1], b[0], b[3], b[2], b[5], b[4]}},
      {"nan", {kNaN, kNaN, kNaN, kNaN, kNaN, kNaN}},
      {"huge", {1e300, -1e300, 1e300, -1e300, 1e300, -1e300}},
      {"wide", {b[0] + 1e5, b[1], b[2] + 1e5, b[3], b[4], b[5]}},
      {"swapped", {b[2], b[3], b[0], b[1], b[4], b[5]}}};
  std::vector<WrongBox> files;
  for (const auto& [name, box] : boxes) {
    std::string bytes = right;
    std::memcpy(&bytes[kBoxAt], &box, sizeof box);
    files.push_back({name, bytes});
  }
  return files;
}

}  // namespace pcl_als::test
