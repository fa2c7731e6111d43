// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <pcl_als/classification/surface_rasters.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>

#include "cell_interpolation.h"
#include "ground_filter.h"
#include "surface_texture.h"

namespace pcl_als {
namespace {

constexpr std::uint8_t kLowNoise = 7, kHighNoise = 18;

/// Bands that are interpolated as the surface is, in the order of its samples.
constexpr std::array<const char*, 4> kFilledBands{"intensity", "echoes_per_pulse", "height_std",
                                                  "echo_width"};

void checkLength(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw UsageError(std::string(name) + " " + std::to_string(value) + " m: must be between " +
                   std::to_string(low) + " and " + std::to_string(high));
}

/// Sums of the returns in a cell; heights are relative to the base of the accumulator.
struct Cell {
  float top_z = 0.0F, top_x = 0.0F, top_y = 0.0F;  ///< highest first return; place in the cell
  float low_z = 0.0F, low_x = 0.0F, low_y = 0.0F;  ///< lowest last return
  double intensity = 0.0;
  double ground_z = 0.0, ground_x = 0.0, ground_y = 0.0;  ///< sums
  std::uint32_t firsts = 0, lasts = 0, grounds = 0, multiples = 0;
  std::uint32_t returns = 0, echoes = 0, widths = 0;  ///< echoes: of the pulses of the firsts
  float mean_z = 0.0F, squares_z = 0.0F;  ///< of all returns; squares of distances from the mean
  float width = 0.0F;                     ///< sum

  void addHeight(float z) {
    const float distance = z - mean_z;
    mean_z += distance / static_cast<float>(++returns);
    squares_z += distance * (z - mean_z);
  }
  float meanWidth() const {
    return widths > 0 ? width / static_cast<float>(widths) : RasterBand::kNoValue;
  }
  float heightStd() const {
    return returns > 0 ? std::sqrt(squares_z / static_cast<float>(returns)) : 0.0F;
  }
};

}  // namespace

void CellCounts::add(CellSource source) {
  measured += source == CellSource::measured;
  interpolated += source == CellSource::interpolated;
  empty += source == CellSource::empty;
}

void CellCounts::merge(const CellCounts& other) {
  measured += other.measured;
  interpolated += other.interpolated;
  empty += other.empty;
}

std::vector<std::uint8_t> SurfaceOptions::groundAndRoads() {
  return {2, 9, 11};
}

void SurfaceOptions::check() const {
  checkLength("the largest gap of the surface", surface_gap, 0.0, 1000.0);
  checkLength("the largest gap of the terrain", terrain_gap, 0.0, 1000.0);
  checkLength("the texture window", texture_window, 0.0, 1000.0);
  checkLength("the largest object", largest_object, 1.0, 500.0);
  if (ground == Ground::classified && ground_classes.empty())
    throw UsageError("no class is named as ground");
}

int SurfaceOptions::margin(double cell) const {
  // Twice the radius: see fillByTin(); the texture window comes on top.
  double metres = 2.0 * std::max(surface_gap, terrain_gap);
  if (ground == Ground::filtered) metres += detail::groundFilterReach(cell, largest_object);
  return static_cast<int>(std::ceil(metres / cell)) +
         static_cast<int>(std::ceil(texture_window / cell)) + 2;
}

struct SurfaceAccumulator::State {
  State(RasterGrid where, SurfaceOptions how) : grid(std::move(where)), options(std::move(how)) {
    options.check();
    cells.resize(grid.cells());
    for (const std::uint8_t code : options.ground_classes) ground_class[code] = true;
  }

  int textureRadius() const {
    return std::max(1, static_cast<int>(std::lround(0.5 * options.texture_window / grid.cell)));
  }
  Eigen::Vector2d place(std::size_t index, double x, double y) const {
    const auto column = static_cast<double>(index % static_cast<std::size_t>(grid.columns));
    const auto row = static_cast<double>(index / static_cast<std::size_t>(grid.columns));
    return {(column + 0.5) * grid.cell + x, -(row + 0.5) * grid.cell + y};
  }
  detail::FilledCells fill(const detail::CellSamples& samples, double gap) const {
    return options.interpolation == SurfaceOptions::Interpolation::tin
               ? detail::fillByTin(grid, samples, gap)
               : detail::fillByDistance(grid, samples, gap);
  }
  detail::CellSamples surfaceSamples() const;
  detail::CellSamples classifiedGround() const;
  detail::CellSamples filteredGround() const;
  void addStatistics(Raster& raster) const;

  RasterGrid grid;
  SurfaceOptions options;
  std::vector<Cell> cells;
  bool ground_class[256] = {};
  bool has_base = false;
  double base = 0.0;  ///< metres: floats of heights about it are good to 0.5 mm within 8 km
};

detail::CellSamples SurfaceAccumulator::State::surfaceSamples() const {
  detail::CellSamples samples;
  samples.values.resize(kFilledBands.size() + 1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    if (cell.firsts == 0) continue;
    samples.cell.push_back(i);
    samples.place.push_back(place(i, cell.top_x, cell.top_y));
    samples.values[0].push_back(cell.top_z);
    samples.values[1].push_back(static_cast<float>(cell.intensity / cell.firsts));
    samples.values[2].push_back(static_cast<float>(cell.echoes) / static_cast<float>(cell.firsts));
    samples.values[3].push_back(cell.heightStd());
    samples.values[4].push_back(cell.meanWidth());
  }
  return samples;
}

detail::CellSamples SurfaceAccumulator::State::classifiedGround() const {
  detail::CellSamples samples;
  samples.values.resize(1);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& cell = cells[i];
    if (cell.grounds == 0) continue;
    samples.cell.push_back(i);
    samples.place.push_back(place(i, cell.ground_x / cell.grounds, cell.ground_y / cell.grounds));
    samples.values[0].push_back(static_cast<float>(cell.ground_z / cell.grounds));
  }
  return samples;
}

detail::CellSamples SurfaceAccumulator::State::filteredGround() const {
  std::vector<std::size_t> candidates;
  std::vector<detail::LowestReturn> returns;
  const auto columns = static_cast<std::size_t>(grid.columns);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].lasts == 0) continue;
    candidates.push_back(i);
    returns.push_back(
        {static_cast<int>(i % columns), static_cast<int>(i / columns), cells[i].low_z});
  }
  detail::CellSamples samples;
  samples.values.resize(1);
  for (const std::size_t k : detail::groundReturns(grid, returns, options.largest_object)) {
    const Cell& cell = cells[candidates[k]];
    samples.cell.push_back(candidates[k]);
    samples.place.push_back(place(candidates[k], cell.low_x, cell.low_y));
    samples.values[0].push_back(cell.low_z);
  }
  return samples;
}

/// Share of multiple returns and range of heights in the texture window, density of the cell.
void SurfaceAccumulator::State::addStatistics(Raster& raster) const {
  std::vector<float>& multiple = raster.addBand("multiple_returns").values;
  std::vector<float>& range = raster.addBand("height_range").values;
  std::vector<float>& density = raster.addBand("density").values;
  const int radius = textureRadius();
  const double area = grid.cell * grid.cell;
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      std::uint32_t firsts = 0, multiples = 0, lasts = 0;
      float top = 0.0F, low = 0.0F;
      for (int r = std::max(0, row - radius); r <= std::min(grid.rows - 1, row + radius); ++r) {
        for (int c = std::max(0, column - radius); c <= std::min(grid.columns - 1, column + radius);
             ++c) {
          const Cell& cell = cells[grid.index(c, r)];
          if (cell.firsts > 0) top = firsts == 0 ? cell.top_z : std::max(top, cell.top_z);
          if (cell.lasts > 0) low = lasts == 0 ? cell.low_z : std::min(low, cell.low_z);
          firsts += cell.firsts, multiples += cell.multiples, lasts += cell.lasts;
        }
      }
      const std::size_t i = grid.index(column, row);
      density[i] = static_cast<float>(cells[i].firsts / area);
      if (firsts > 0) multiple[i] = static_cast<float>(multiples) / static_cast<float>(firsts);
      if (firsts > 0 && lasts > 0) range[i] = std::max(0.0F, top - low);
    }
  }
}

const std::vector<std::string>& SurfaceAccumulator::bandNames() {
  static const std::vector<std::string> names{"surface",          "terrain",      "height",
                                              "intensity",        "slope",        "roughness",
                                              "multiple_returns", "height_range", "density",
                                              "echoes_per_pulse", "height_std",   "echo_width"};
  return names;
}

SurfaceAccumulator::SurfaceAccumulator(RasterGrid grid, SurfaceOptions options)
    : state_(std::make_unique<State>(std::move(grid), std::move(options))) {}

SurfaceAccumulator::~SurfaceAccumulator() = default;

bool SurfaceAccumulator::add(const SurfaceReturn& point) {
  State& s = *state_;
  const long long column = s.grid.columnOf(point.x), row = s.grid.rowOf(point.y);
  if (!s.grid.holds(column, row) || point.classification == kLowNoise ||
      point.classification == kHighNoise)
    return false;
  if (!s.has_base) s.base = std::round(point.z), s.has_base = true;
  const int c = static_cast<int>(column), r = static_cast<int>(row);
  Cell& cell = s.cells[s.grid.index(c, r)];
  const auto x = static_cast<float>(point.x - s.grid.centreX(c)),
             y = static_cast<float>(point.y - s.grid.centreY(r)),
             z = static_cast<float>(point.z - s.base);
  if (point.return_number <= 1) {
    if (cell.firsts == 0 || z > cell.top_z) cell.top_z = z, cell.top_x = x, cell.top_y = y;
    ++cell.firsts;
    cell.echoes += std::max<std::uint32_t>(1, point.number_of_returns);
    cell.multiples += point.number_of_returns > 1;
    cell.intensity += static_cast<double>(point.intensity);
  }
  if (point.return_number >= point.number_of_returns) {
    if (cell.lasts == 0 || z < cell.low_z) cell.low_z = z, cell.low_x = x, cell.low_y = y;
    ++cell.lasts;
  }
  cell.addHeight(z);
  if (!std::isnan(point.echo_width)) cell.width += point.echo_width, ++cell.widths;
  if (s.ground_class[point.classification]) {
    ++cell.grounds;
    cell.ground_x += x, cell.ground_y += y, cell.ground_z += z;
  }
  return true;
}

SurfaceResult SurfaceAccumulator::compute() const {
  const State& s = *state_;
  SurfaceResult result;
  Raster& raster = result.raster;
  raster.grid = s.grid;
  raster.bands.reserve(bandNames().size());
  detail::FilledCells surface = s.fill(s.surfaceSamples(), s.options.surface_gap);
  detail::FilledCells terrain =
      s.fill(s.options.ground == SurfaceOptions::Ground::classified ? s.classifiedGround()
                                                                    : s.filteredGround(),
             s.options.terrain_gap);
  std::vector<float> slope, roughness, height(s.grid.cells());
  detail::slopeAndRoughness(s.grid, surface.bands[0], s.textureRadius(), slope, roughness);
  for (std::size_t i = 0; i < height.size(); ++i)
    height[i] = surface.bands[0][i] - terrain.bands[0][i];
  for (std::vector<float>* heights : {&surface.bands[0], &terrain.bands[0]})
    for (float& z : *heights) z = static_cast<float>(static_cast<double>(z) + s.base);
  raster.bands.push_back({"surface", std::move(surface.bands[0])});
  raster.bands.push_back({"terrain", std::move(terrain.bands[0])});
  raster.bands.push_back({"height", std::move(height)});
  raster.bands.push_back({kFilledBands[0], std::move(surface.bands[1])});
  raster.bands.push_back({"slope", std::move(slope)});
  raster.bands.push_back({"roughness", std::move(roughness)});
  s.addStatistics(raster);
  for (std::size_t i = 1; i < kFilledBands.size(); ++i)
    raster.bands.push_back({kFilledBands[i], std::move(surface.bands[i + 1])});
  result.surface_source = std::move(surface.source);
  result.terrain_source = std::move(terrain.source);
  return result;
}

std::vector<RasterTile> tilesOf(const RasterGrid& grid, int side, int margin) {
  if (side < 1) throw UsageError("a tile has at least one cell");
  std::vector<RasterTile> tiles;
  for (int row = 0; row < grid.rows; row += side) {
    for (int column = 0; column < grid.columns; column += side) {
      RasterTile tile;
      tile.window = {column, row, std::min(side, grid.columns - column),
                     std::min(side, grid.rows - row)};
      tile.margin = margin;
      tile.padded = grid;
      tile.padded.west = grid.west + (column - margin) * grid.cell;
      tile.padded.north = grid.north - (row - margin) * grid.cell;
      tile.padded.columns = tile.window.columns + 2 * margin;
      tile.padded.rows = tile.window.rows + 2 * margin;
      tiles.push_back(tile);
    }
  }
  return tiles;
}

void requireBand(const std::string& name) {
  const std::vector<std::string>& known = SurfaceAccumulator::bandNames();
  if (std::find(known.begin(), known.end(), name) == known.end())
    throw UsageError("there is no band '" + name + "'; there are " + joined(known));
}

std::vector<std::string> bandsIn(const std::string& list) {
  std::vector<std::string> bands = splitList(list);
  for (auto band = bands.begin(); band != bands.end(); ++band) {
    requireBand(*band);
    if (std::find(bands.begin(), band, *band) != band)
      throw UsageError("'" + *band + "' appears twice");
  }
  if (bands.empty()) throw UsageError("names no band");
  return bands;
}

std::vector<std::uint8_t> classCodesIn(const std::string& list) {
  std::vector<std::uint8_t> codes;
  for (const std::string& text : splitList(list)) {
    const auto code = valueIn<std::uint8_t>(text);
    if (!code) throw UsageError("'" + text + "' is no class code (0 to 255)");
    codes.push_back(*code);
  }
  if (codes.empty()) throw UsageError("names no class");
  return codes;
}

}  // namespace pcl_als
