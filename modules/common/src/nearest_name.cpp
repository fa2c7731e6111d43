// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cctype>

#include <pcl_als/common/nearest_name.h>

namespace pcl_als {

std::size_t editDistance(const std::string& from, const std::string& to) {
  const std::size_t rows = from.size() + 1, columns = to.size() + 1;
  std::vector<std::size_t> d(rows * columns);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return d[i * columns + j]; };
  for (std::size_t i = 0; i < rows; ++i) at(i, 0) = i;
  for (std::size_t j = 0; j < columns; ++j) at(0, j) = j;
  for (std::size_t i = 1; i < rows; ++i) {
    for (std::size_t j = 1; j < columns; ++j) {
      const std::size_t replace = at(i - 1, j - 1) + (from[i - 1] == to[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replace});
      const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
      if (swapped) at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return d.back();
}

std::string nearestName(const std::string& word, const std::vector<std::string>& names) {
  std::string lower = word;
  for (char& c : lower) {
    c = c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  const std::size_t most = std::max<std::size_t>(1, lower.size() / 3);
  std::size_t nearest = most + 1;
  std::string found;
  for (const std::string& name : names) {
    // The beginning of one name only is as good as a small error.
    const bool begins = lower.size() >= 3 && name.rfind(lower, 0) == 0;
    const std::size_t distance = begins ? 1 : editDistance(lower, name);
    if (distance > nearest) continue;
    // Of "trajectory" and "trajectory_units", the former is meant.
    const bool continued = begins && !found.empty();
    if (distance < nearest || (continued && found.rfind(name, 0) == 0)) {
      found = name;
    } else if (!continued || name.rfind(found, 0) != 0) {
      found.clear();
    }
    nearest = distance;
  }
  return nearest <= most ? found : std::string();
}

}  // namespace pcl_als
