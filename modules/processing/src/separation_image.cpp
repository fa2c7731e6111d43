// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "separation_image.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/parallel.h>
#include <pcl_als/drawing/canvas.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/checked_block.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/quality/swath_separation.h>

namespace pcl_als {
namespace {

constexpr double kMostCells = 16e6;    // of all strips, 40 bytes each
constexpr double kMostPixels = 400e6;  // of the image, which is written in strips of rows
constexpr double kMostInPng = 64e6;
constexpr int kRows = 512;
constexpr int kOverviewSide = 1400;  // cells

/// Counts cells by what they are, then takes the most.
class OverviewCounts {
 public:
  explicit OverviewCounts(const RasterGrid& grid)
      : step_((std::max(grid.columns, grid.rows) + kOverviewSide - 1) / kOverviewSide) {
    overview_.columns = (grid.columns + step_ - 1) / step_;
    overview_.rows = (grid.rows + step_ - 1) / step_;
    overview_.cell = grid.cell * step_;
    overview_.north_west = {grid.west, grid.north};
    counts_.resize(static_cast<std::size_t>(overview_.columns) *
                   static_cast<std::size_t>(overview_.rows));
  }

  void add(int column, int row, SeparationOverview::Code code) {
    if (code == SeparationOverview::nothing) return;
    const int place = row / step_ * overview_.columns + column / step_;
    ++counts_[static_cast<std::size_t>(place)][code - 1];
  }

  SeparationOverview overview() const {
    SeparationOverview result = overview_;
    for (const auto& counts : counts_) {
      // Where two strips were compared, cells of a single strip are not considered.
      const auto most = std::max_element(counts.begin() + 1, counts.end());
      auto code = static_cast<std::uint8_t>(SeparationOverview::nothing);
      if (*most > 0)
        code = static_cast<std::uint8_t>(most - counts.begin() + 1);
      else if (counts[0] > 0)
        code = SeparationOverview::one_strip;
      result.codes.push_back(code);
    }
    return result;
  }

 private:
  int step_;
  SeparationOverview overview_;
  std::vector<std::array<std::uint32_t, 4>> counts_;
};

SeparationOverview::Code codeOf(const SwathSeparation::Cell& cell, double limit) {
  if (cell.strips < 2)
    return cell.strips == 1 ? SeparationOverview::one_strip : SeparationOverview::nothing;
  switch (separationColour(cell.separation, limit)) {
    case SeparationColour::green:
      return SeparationOverview::within_limit;
    case SeparationColour::yellow:
      return SeparationOverview::within_twice;
    default:
      return SeparationOverview::beyond;
  }
}

struct Outputs {
  RasterWriter colours, metres;
  Image png;
  int step;  ///< of the cells that the PNG shows
  OverviewCounts overview;
};

RasterLayout layoutOf(const RasterGrid& grid, bool colours, double limit) {
  RasterLayout layout;
  layout.grid = grid;
  layout.type = colours ? RasterLayout::Type::byte : RasterLayout::Type::float32;
  layout.bands = colours ? std::vector<std::string>{"red", "green", "blue"}
                         : std::vector<std::string>{"separation_m"};
  layout.metadata["SPECIFICATION"] = kSwathSpecification;
  layout.metadata["GREEN_UP_TO_M"] = std::to_string(limit);
  layout.metadata["YELLOW_UP_TO_M"] = std::to_string(2.0 * limit);
  return layout;
}

/// One band of rows: pixels, separations, and the PNG's share of them.
void writeRows(const std::vector<SwathSeparation::Cell>& cells, const RasterWindow& window,
               const SwathSeparation::Stretch& stretch, SeparationSummary& summary,
               Outputs& outputs) {
  std::array<std::vector<std::uint8_t>, 3> bands;
  for (auto& band : bands) band.resize(cells.size());
  std::vector<float> metres(cells.size(), RasterBand::kNoValue);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const SeparationPixel pixel = separationPixel(cells[i], stretch, summary.limit);
    const std::array<std::uint8_t, 3> rgb{pixel.red, pixel.green, pixel.blue};
    // 0 means no data in each band of the GeoTIFF.
    for (std::size_t k = 0; k < 3; ++k)
      bands[k][i] = pixel.alpha == 0 ? std::uint8_t{0} : std::max<std::uint8_t>(1, rgb[k]);
    const int row = window.row + static_cast<int>(i) / window.columns;
    const int column = static_cast<int>(i) % window.columns;
    if (row % outputs.step == 0 && column % outputs.step == 0)
      outputs.png.at(column / outputs.step, row / outputs.step) = {pixel.red, pixel.green,
                                                                   pixel.blue, pixel.alpha};
    const SeparationOverview::Code code = codeOf(cells[i], summary.limit);
    outputs.overview.add(column, row, code);
    if (cells[i].strips < 2) continue;
    metres[i] = cells[i].separation;
    summary.green += code == SeparationOverview::within_limit ? 1 : 0;
    summary.yellow += code == SeparationOverview::within_twice ? 1 : 0;
    summary.red += code == SeparationOverview::beyond ? 1 : 0;
  }
  for (std::size_t k = 0; k < 3; ++k) outputs.colours.write(k, window, bands[k].data());
  outputs.metres.write(0, window, metres.data());
}

}  // namespace

RasterGrid separationGrid(const Eigen::AlignedBox2d& extent, double covered_area, double cell,
                          const std::string& crs) {
  const double box = extent.sizes().x() * extent.sizes().y();
  while (covered_area > kMostCells * cell * cell || box > kMostPixels * cell * cell) cell *= 2.0;
  return RasterGrid::covering(extent.min().x(), extent.min().y(), extent.max().x(),
                              extent.max().y(), cell, crs);
}

SeparationSummary writeSeparation(const std::filesystem::path& folder, const std::string& stem,
                                  const SwathSeparation& separation, int quality_level,
                                  int threads) {
  const RasterGrid& grid = separation.grid();
  SeparationSummary summary;
  summary.cell = grid.cell;
  summary.limit = qualityLevels()[static_cast<std::size_t>(quality_level)].swath_overlap_rmsdz;
  const std::filesystem::path colours = folder / (stem + ".tif"),
                              metres = folder / (stem + "_metres.tif"),
                              png = folder / (stem + ".png");
  RasterOptions options;
  options.threads = threads;
  Outputs outputs{{colours, layoutOf(grid, true, summary.limit), options},
                  {metres, layoutOf(grid, false, summary.limit), options},
                  Image(),
                  1,
                  OverviewCounts(grid)};
  while (static_cast<double>(grid.cells()) > kMostInPng * outputs.step * outputs.step)
    ++outputs.step;
  outputs.png = Image((grid.columns + outputs.step - 1) / outputs.step,
                      (grid.rows + outputs.step - 1) / outputs.step);
  const SwathSeparation::Stretch stretch = separation.intensityStretch();
  for (int row = 0; row < grid.rows; row += kRows) {
    const int rows = std::min(kRows, grid.rows - row);
    constexpr int kPart = 16;  // rows that one thread takes at a time
    std::vector<std::vector<SwathSeparation::Cell>> parts((rows + kPart - 1) / kPart);
    parallelFor(parts.size(), threads, [&](std::size_t i) {
      const int from = static_cast<int>(i) * kPart;
      parts[i] = separation.rows(row + from, std::min(kPart, rows - from));
    });
    std::vector<SwathSeparation::Cell> cells;
    for (const auto& part : parts) cells.insert(cells.end(), part.begin(), part.end());
    writeRows(cells, {0, row, grid.columns, rows}, stretch, summary, outputs);
  }
  outputs.colours.commit();
  outputs.metres.commit();
  writePng(png, outputs.png);
  summary.overview = outputs.overview.overview();
  summary.files = {colours.filename().string(), metres.filename().string(),
                   png.filename().string()};
  return summary;
}

}  // namespace pcl_als
