// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/reference_source.h>

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestCell = 10.0;  // metres: the cells in which strips are compared at first
constexpr int kRows = 64;              // read at once

/// The cells of a raster that a box covers.
RasterWindow cellsIn(const RasterGrid& grid, const Eigen::AlignedBox2d& box) {
  const auto clamped = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  RasterWindow window;
  window.column = clamped(std::floor((box.min().x() - grid.west) / grid.cell), grid.columns);
  window.row = clamped(std::floor((grid.north - box.max().y()) / grid.cell), grid.rows);
  window.columns =
      clamped(std::ceil((box.max().x() - grid.west) / grid.cell), grid.columns) - window.column;
  window.rows =
      clamped(std::ceil((grid.north - box.min().y()) / grid.cell), grid.rows) - window.row;
  return window;
}

void readCells(const fs::path& path, double unit, const Eigen::AlignedBox2d& box,
               const ReferenceSource::Sink& sink) {
  RasterReader reader(path);
  const RasterGrid& grid = reader.layout().grid;
  RasterWindow part = cellsIn(grid, box);
  if (part.columns <= 0) return;
  std::vector<float> heights;
  std::vector<LidarReturn> points;
  for (const int end = part.row + part.rows; part.row < end; part.row += part.rows) {
    part.rows = std::min(kRows, end - part.row);
    heights.resize(part.cells());
    reader.read(0, part, heights.data());
    points.clear();
    for (std::size_t i = 0; i < heights.size(); ++i) {
      if (!std::isfinite(heights[i])) continue;
      const int column = part.column + static_cast<int>(i) % part.columns;
      const int row = part.row + static_cast<int>(i) / part.columns;
      points.emplace_back();
      points.back().position = {grid.centreX(column), grid.centreY(row),
                                unit * static_cast<double>(heights[i])};
    }
    sink(points.data(), points.size());
  }
}

/// Takes a number after the last colon off a text; none: there is none.
std::optional<double> numberAtEnd(std::string& text) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string::npos || colon == 0) return std::nullopt;
  const std::string_view digits = std::string_view(text).substr(colon + 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (digits.empty() || error != std::errc() || end != digits.data() + digits.size())
    return std::nullopt;
  text.resize(colon);
  return value;
}

}  // namespace

ReferenceSource referenceRaster(const fs::path& path) {
  const RasterReader reader(path);
  ReferenceSource source;
  source.surface.name = path.filename().string();
  source.info = reader.info();
  const double cell = reader.layout().grid.cell;
  if (cell > kLargestCell)
    throw InputError(path.string() + ": cells of " + std::to_string(std::lround(cell)) +
                     " m are too large for a reference surface; 10 m at most");
  const double unit = source.info.units.vertical.metres;
  source.read = [path, unit](const Eigen::AlignedBox2d& box, const ReferenceSource::Sink& sink) {
    readCells(path, unit, box, sink);
  };
  return source;
}

ReferenceSource openReference(const std::string& text) {
  std::string file = text;
  std::vector<double> numbers;  // the last one first
  std::error_code error;
  while (numbers.size() < 2 && !fs::exists(file, error)) {
    const auto number = numberAtEnd(file);
    if (!number) break;
    numbers.push_back(*number);
  }
  const std::string extension = lowerExtension(file);
  const bool raster = extension == ".tif" || extension == ".tiff";
  ReferenceSource source = raster ? referenceRaster(file) : referencePoints(file);
  if (!numbers.empty()) source.surface.std = numbers.back();
  if (numbers.size() > 1) source.surface.offset = numbers.front();
  return source;
}

}  // namespace pcl_als
