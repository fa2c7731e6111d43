// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "picture_options.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>

#include "output_check.h"

namespace pcl_als::app {
namespace {

/// The numbers of a text, separated by one character each; empty where it has another form.
std::vector<double> parsed(const std::string& text, char separator) {
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    const auto number = decimalNumber(part);
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

}  // namespace

void addSizeOption(CommandLine& line) {
  line.add<std::string>("size", "size of the picture, pixels", "1600x1000");
}

PictureSize sizeOf(const CommandLine& line) {
  const std::vector<double> size = parsed(line.text("size"), 'x');
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

std::vector<double> numbersOf(const CommandLine& line, const char* option, char separator,
                              std::size_t count, double largest) {
  std::vector<double> numbers = parsed(line.text(option), separator);
  const bool small = std::all_of(numbers.begin(), numbers.end(),
                                 [&](double number) { return std::abs(number) <= largest; });
  if (numbers.size() == count && small) return numbers;
  std::ostringstream message;
  message << "option -" << option << ": '" << line.text(option) << "' is not " << count
          << " numbers separated by '" << separator << "', at most " << largest;
  throw UsageError(message.str());
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
