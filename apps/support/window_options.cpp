// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "window_options.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/point_files.h>

namespace pcl_als::app {

std::vector<double> numbersOf(const CommandLine& line, const std::string& option, char separator,
                              std::size_t count, double largest) {
  std::vector<double> numbers = numbersIn(line.text(option), separator);
  const bool small = std::all_of(numbers.begin(), numbers.end(),
                                 [&](double number) { return std::abs(number) <= largest; });
  if (numbers.size() == count && small) return numbers;
  std::ostringstream message;
  message << "option -" << option << ": '" << line.text(option) << "' is not " << count
          << " numbers separated by '" << separator << "', at most " << largest;
  throw UsageError(message.str());
}

Eigen::AlignedBox2d rectangleOf(const CommandLine& line, const std::string& option) {
  const std::vector<double> edges = numbersOf(line, option, ',', 4, kFarthest);
  if (!(edges[0] < edges[2] && edges[1] < edges[3])) {
    throw UsageError("option -" + option + ": XMIN,YMIN,XMAX,YMAX needs the smaller values first");
  }
  return {Eigen::Vector2d(edges[0], edges[1]), Eigen::Vector2d(edges[2], edges[3])};
}

std::vector<std::filesystem::path> pointFiles(const CommandLine& line, const std::string& option) {
  if (!line.has(option)) return {};
  const std::string value = line.text(option);
  std::error_code error;
  const std::vector<std::string> files =
      std::filesystem::is_directory(value, error) ? pointFilesIn(value) : splitList(value);
  return {files.begin(), files.end()};
}

Option& addWindowOptions(CommandLine& line) {
  const OptionGroup group(line, Group::inputs);
  Option& bounds = line.addText(
      "bounds",
      "XMIN,YMIN,XMAX,YMAX, m: use the points in this rectangle only, with its edges; of COPC "
      "files only this part is read");
  line.addNumber("resolution",
                 "of COPC files: read the octree up to the level whose points are so far apart, in "
                 "place of all points",
                 {}, {1e-6, 1e6, "m"});
  line.addFlag(
      "keep_readable",
      "read what is intact of damaged or truncated LAS and LAZ files, and report how much");
  return bounds;
}

PointWindow windowOf(const CommandLine& line) {
  PointWindow window;
  if (line.has("bounds")) window.bounds = rectangleOf(line, "bounds");
  window.keep_readable = line.has("keep_readable");
  if (line.has("channels")) window.channel_field = line.text("channels");
  if (line.has("resolution")) window.resolution = line.number("resolution");
  return window;
}

}  // namespace pcl_als::app
