// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/classification/surface_rasters.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

constexpr std::uint8_t kGround = 2, kHouse = 6, kLeaves = 5;
const RasterGrid kSurfaceGrid{512000.0, 5403000.0, 1.0, 40, 30, "EPSG:25832"};

SurfaceOptions optionsOf(SurfaceOptions::Interpolation interpolation) {
  SurfaceOptions options;
  options.interpolation = interpolation;
  return options;
}

/// Value of a band at a cell.
float at(const SurfaceResult& result, const char* band, int column, int row) {
  return result.raster.band(band).values[result.raster.grid.index(column, row)];
}

CellCounts countsOf(const std::vector<CellSource>& sources) {
  CellCounts counts;
  for (const CellSource source : sources) counts.add(source);
  return counts;
}

/// An inclined plane, a point in the middle of every \a step-th cell.
double planeAt(double x, double y) {
  return 300.0 + 0.1 * (x - kSurfaceGrid.west) - 0.05 * (y - kSurfaceGrid.north);
}
void addPlane(SurfaceAccumulator& tile, int step, std::uint8_t code = kGround) {
  for (int row = 0; row < kSurfaceGrid.rows; row += step)
    for (int column = 0; column < kSurfaceGrid.columns; column += step) {
      const double x = kSurfaceGrid.centreX(column), y = kSurfaceGrid.centreY(row);
      tile.add({x, y, planeAt(x, y), static_cast<float>(100 + column), 1, 1, code});
    }
}

// Heights of floats near their base are good to 2^-24 of 6 m; slope of the plane: atan of
// sqrt(0.1^2 + 0.05^2) = 6.379 degrees.
TEST(SurfaceRasters, APlaneStaysAPlane) {
  SurfaceAccumulator tile(kSurfaceGrid, {});
  addPlane(tile, 3);
  const SurfaceResult result = tile.compute();
  for (const auto& [column, row] : {std::pair(1, 1), std::pair(20, 14), std::pair(38, 26)}) {
    const double z = planeAt(kSurfaceGrid.centreX(column), kSurfaceGrid.centreY(row));
    EXPECT_NEAR(at(result, "surface", column, row), z, 4e-5);
    EXPECT_NEAR(at(result, "terrain", column, row), z, 4e-5);
    EXPECT_NEAR(at(result, "height", column, row), 0.0, 1e-5);
    EXPECT_NEAR(at(result, "intensity", column, row), 100.0 + column, 1e-3);
    EXPECT_NEAR(at(result, "slope", column, row), 6.379, 1e-3);
    EXPECT_NEAR(at(result, "roughness", column, row), 0.0, 1e-5);
  }
  const CellCounts counts = countsOf(result.surface_source);
  EXPECT_EQ(counts.measured, 14U * 10U);
  EXPECT_EQ(counts.empty, 2U * 40U);  // below the last row of points; columns end with one
  EXPECT_EQ(counts.cells(), kSurfaceGrid.cells());
}

// By hand: highest first return, mean of first returns' intensities, mean of ground heights.
TEST(SurfaceRasters, OneCellByHand) {
  SurfaceAccumulator tile(kSurfaceGrid, {});
  const double x = kSurfaceGrid.centreX(5), y = kSurfaceGrid.centreY(5);
  EXPECT_TRUE(tile.add({x, y, 310.0, 40.0F, 1, 2, kLeaves}));
  EXPECT_TRUE(tile.add({x + 0.2, y, 300.5, 10.0F, 2, 2, kGround}));
  EXPECT_TRUE(tile.add({x - 0.2, y, 300.25, 20.0F, 1, 1, kGround}));
  EXPECT_FALSE(tile.add({x, y, 900.0, 1.0F, 1, 1, 18}));
  EXPECT_FALSE(tile.add({kSurfaceGrid.west - 0.01, y, 300.0, 1.0F, 1, 1, kGround}));
  const SurfaceResult result = tile.compute();
  EXPECT_EQ(at(result, "surface", 5, 5), 310.0F);
  EXPECT_EQ(at(result, "terrain", 5, 5), 300.375F);
  EXPECT_EQ(at(result, "height", 5, 5), 9.625F);
  EXPECT_EQ(at(result, "intensity", 5, 5), 30.0F);
  EXPECT_EQ(at(result, "multiple_returns", 5, 5), 0.5F);
  EXPECT_EQ(at(result, "height_range", 5, 5), 9.75F);
  EXPECT_EQ(at(result, "density", 5, 5), 2.0F);
  EXPECT_TRUE(std::isnan(at(result, "surface", 6, 5)));
  EXPECT_TRUE(std::isnan(at(result, "slope", 5, 5)));
}

// By hand: a pulse of three echoes at 310, 304 and 301 m and a pulse of one at 301 m, of which the
// second echo has no width. Mean 304 m, squares of the differences 36 + 0 + 9 + 9.
TEST(SurfaceRasters, EchoesOfOneCellByHand) {
  SurfaceAccumulator tile(kSurfaceGrid, {});
  const double x = kSurfaceGrid.centreX(5), y = kSurfaceGrid.centreY(5);
  tile.add({x, y, 310.0, 40.0F, 1, 3, kLeaves, 5.5F});
  tile.add({x, y, 304.0, 20.0F, 2, 3, kLeaves});
  tile.add({x, y, 301.0, 10.0F, 3, 3, kGround, 4.5F});
  tile.add({x, y, 301.0, 60.0F, 1, 1, kGround, 4.1F});
  tile.add({kSurfaceGrid.centreX(8), y, 301.0, 60.0F, 1, 1, kGround});
  const SurfaceResult result = tile.compute();
  EXPECT_EQ(at(result, "echoes_per_pulse", 5, 5), 2.0F);
  EXPECT_NEAR(at(result, "height_std", 5, 5), std::sqrt(54.0 / 4.0), 1e-5);
  EXPECT_NEAR(at(result, "echo_width", 5, 5), 4.7, 1e-5);
  EXPECT_EQ(at(result, "echoes_per_pulse", 8, 5), 1.0F);
  EXPECT_EQ(at(result, "height_std", 8, 5), 0.0F);
  EXPECT_TRUE(std::isnan(at(result, "echo_width", 8, 5)));
  EXPECT_TRUE(std::isnan(at(result, "echoes_per_pulse", 6, 5)));
}

// Cells without returns have the values of their neighbours, linearly.
TEST(SurfaceRasters, EchoesAreInterpolated) {
  SurfaceAccumulator tile(kSurfaceGrid, {});
  for (int row = 0; row < kSurfaceGrid.rows; row += 3)
    for (int column = 0; column < kSurfaceGrid.columns; column += 3)
      tile.add({kSurfaceGrid.centreX(column), kSurfaceGrid.centreY(row), 300.0, 1.0F, 1,
                static_cast<std::uint8_t>(1 + row / 3), kGround,
                static_cast<float>(4.0 + 0.1 * column)});
  const SurfaceResult result = tile.compute();
  EXPECT_NEAR(at(result, "echo_width", 10, 13), 5.0, 1e-5);
  EXPECT_NEAR(at(result, "echoes_per_pulse", 10, 13), 1.0 + 13.0 / 3.0, 1e-5);
  EXPECT_EQ(at(result, "height_std", 10, 13), 0.0F);
}

// Of a 3 x 3 window around a spike of 9 m among zeros the plane is level at 1 m, the residuals are
// 8 m once and -1 m eight times: RMS sqrt(72 / 9).
TEST(SurfaceRasters, RoughnessOfASpikeByHand) {
  SurfaceAccumulator tile(kSurfaceGrid, {});
  for (int row = 0; row < 9; ++row)
    for (int column = 0; column < 9; ++column)
      tile.add({kSurfaceGrid.centreX(column), kSurfaceGrid.centreY(row),
                100.0 + (row == 4 && column == 4 ? 9.0 : 0.0), 1.0F, 1, 1, kGround});
  const SurfaceResult result = tile.compute();
  EXPECT_NEAR(at(result, "roughness", 4, 4), std::sqrt(8.0), 1e-5);
  EXPECT_NEAR(at(result, "slope", 4, 4), 0.0, 1e-5);
}

// Four neighbours of an empty cell at distance 1 m with heights 1 to 4, four at sqrt(2) with 0:
// (1 + 2 + 3 + 4) / (4 + 4 / 2).
TEST(SurfaceRasters, InverseDistanceByHand) {
  SurfaceAccumulator tile(kSurfaceGrid, optionsOf(SurfaceOptions::Interpolation::inverse_distance));
  const int offsets[8][3] = {{1, 0, 1}, {-1, 0, 2}, {0, 1, 3},  {0, -1, 4},
                             {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  for (const auto& o : offsets)
    tile.add({kSurfaceGrid.centreX(10 + o[0]), kSurfaceGrid.centreY(10 + o[1]), 50.0 + o[2], 1.0F,
              1, 1, kGround});
  const SurfaceResult result = tile.compute();
  EXPECT_NEAR(at(result, "surface", 10, 10), 50.0 + 10.0 / 6.0, 1e-5);
  // 6 m from the nearest point is within reach, farther is not.
  EXPECT_FALSE(std::isnan(at(result, "surface", 17, 10)));
  EXPECT_TRUE(std::isnan(at(result, "surface", 18, 10)));
}

// A hole wider than the largest gap stays one; the terrain, whose gaps may be larger, is closed.
TEST(SurfaceRasters, WideHolesStayAndAreCounted) {
  for (const auto interpolation :
       {SurfaceOptions::Interpolation::tin, SurfaceOptions::Interpolation::inverse_distance}) {
    SurfaceAccumulator tile(kSurfaceGrid, optionsOf(interpolation));
    for (int row = 0; row < kSurfaceGrid.rows; ++row)
      for (int column = 0; column < kSurfaceGrid.columns; ++column)
        if (std::abs(column - 20) > 8 || std::abs(row - 15) > 8)
          tile.add({kSurfaceGrid.centreX(column), kSurfaceGrid.centreY(row), 300.0, 1.0F, 1, 1,
                    kGround});
    const SurfaceResult result = tile.compute();
    EXPECT_TRUE(std::isnan(at(result, "surface", 20, 15)));
    EXPECT_EQ(at(result, "terrain", 20, 15), 300.0F);
    EXPECT_TRUE(std::isnan(at(result, "height", 20, 15)));
    EXPECT_GT(countsOf(result.surface_source).empty, 20U);
    EXPECT_EQ(countsOf(result.terrain_source).empty, 0U);
  }
}

/// A field of scattered points with houses and a few trees.
std::vector<SurfaceReturn> village(const RasterGrid& grid, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<SurfaceReturn> points;
  const double width = grid.columns * grid.cell, depth = grid.rows * grid.cell;
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    const double u = width * unit(random), v = depth * unit(random);
    const double ground = 300.0 + 0.03 * u + 2.0 * std::sin(v / 30.0);
    const bool house = std::fmod(u, 40.0) < 12.0 && std::fmod(v, 30.0) < 10.0;
    const double z = (house ? ground + 6.0 : ground) + 0.02 * (unit(random) - 0.5);
    points.push_back({grid.west + u, grid.north - v, z, static_cast<float>(100 * unit(random)), 1,
                      1, house ? kHouse : kGround});
  }
  return points;
}

SurfaceResult resultOf(const RasterGrid& grid, const std::vector<SurfaceReturn>& points,
                       const SurfaceOptions& options) {
  SurfaceAccumulator tile(grid, options);
  for (const SurfaceReturn& point : points) tile.add(point);
  return tile.compute();
}

// Floats about each tile's own base height: 1e-4 m.
TEST(SurfaceRasters, TilesGiveWhatTheWholeGives) {
  const RasterGrid grid{512000.0, 5403000.0, 1.0, 300, 200, ""};
  const std::vector<SurfaceReturn> points = village(grid, 3);
  SurfaceOptions options;
  options.terrain_gap = 12.0;
  const SurfaceResult whole = resultOf(grid, points, options);
  std::size_t different = 0, tiles = 0;
  for (const RasterTile& tile : tilesOf(grid, 128, options.margin(grid.cell))) {
    const SurfaceResult part = resultOf(tile.padded, points, options);
    ++tiles;
    for (const std::string& name : SurfaceAccumulator::bandNames())
      for (int row = 0; row < tile.window.rows; ++row)
        for (int column = 0; column < tile.window.columns; ++column) {
          const float a =
              at(whole, name.c_str(), tile.window.column + column, tile.window.row + row);
          const float b = at(part, name.c_str(), tile.margin + column, tile.margin + row);
          different += !(std::abs(a - b) <= 2e-3F || (std::isnan(a) && std::isnan(b)));
        }
  }
  EXPECT_EQ(tiles, 6U);
  EXPECT_EQ(different, 0U);
}

// The same with the ground filter, in tiles whose edges are not multiples of its cells of 1 m (two
// of the raster's); west and north are odd numbers of cells.
TEST(SurfaceRasters, TilesDoNotShowInFilteredTerrain) {
  const RasterGrid grid{512000.5, 5403000.5, 0.5, 420, 300, ""};
  std::vector<SurfaceReturn> points = village(grid, 6);
  for (SurfaceReturn& point : points) point.classification = 0;
  SurfaceOptions options;
  options.ground = SurfaceOptions::Ground::filtered;
  options.largest_object = 15.0;
  options.terrain_gap = 8.0;
  const SurfaceResult whole = resultOf(grid, points, options);
  std::size_t different = 0, tiles = 0;
  for (const RasterTile& tile : tilesOf(grid, 141, options.margin(grid.cell))) {
    const SurfaceResult part = resultOf(tile.padded, points, options);
    ++tiles;
    for (int row = 0; row < tile.window.rows; ++row)
      for (int column = 0; column < tile.window.columns; ++column) {
        const float a = at(whole, "terrain", tile.window.column + column, tile.window.row + row);
        const float b = at(part, "terrain", tile.margin + column, tile.margin + row);
        different += !(std::abs(a - b) <= 1e-4F || (std::isnan(a) && std::isnan(b)));
      }
  }
  EXPECT_EQ(tiles, 9U);
  EXPECT_EQ(different, 0U);
}

// Houses of 12 m x 10 m and 6 m height go, ground stays: heights within 0.3 m (the filter's first
// step) of the truth in 99 % of the cells.
TEST(SurfaceRasters, TheGroundFilterFindsTheTerrainUnderHouses) {
  const RasterGrid grid{512000.0, 5403000.0, 1.0, 200, 150, ""};
  std::vector<SurfaceReturn> points = village(grid, 4);
  for (SurfaceReturn& point : points) point.classification = 0;
  SurfaceOptions options;
  options.ground = SurfaceOptions::Ground::filtered;
  options.largest_object = 25.0;
  const SurfaceResult result = resultOf(grid, points, options);
  std::size_t known = 0, wrong = 0, wrong_surface = 0;
  for (int row = 20; row < 130; ++row)
    for (int column = 20; column < 180; ++column) {
      const double truth = 300.0 + 0.03 * (column + 0.5) + 2.0 * std::sin((row + 0.5) / 30.0);
      const float terrain = at(result, "terrain", column, row);
      known += !std::isnan(terrain);
      wrong += std::abs(terrain - truth) > 0.3;
      wrong_surface += std::abs(at(result, "surface", column, row) - truth) > 0.3;
    }
  EXPECT_EQ(known, 110U * 160U);
  EXPECT_LT(wrong, 176U);
  EXPECT_GT(wrong_surface, 1500U);  // there are houses to remove
}

TEST(SurfaceRasters, EmptyAndAlmostEmptyTiles) {
  SurfaceAccumulator none(kSurfaceGrid, {});
  EXPECT_EQ(countsOf(none.compute().surface_source).empty, kSurfaceGrid.cells());
  SurfaceAccumulator line(kSurfaceGrid, {});  // collinear: no triangles
  for (int i = 0; i < 5; ++i)
    line.add({kSurfaceGrid.centreX(3 * i), kSurfaceGrid.centreY(4), 1.0, 1.0F, 1, 1, kGround});
  EXPECT_EQ(countsOf(line.compute().surface_source).measured, 5U);
}

TEST(SurfaceRasters, RefusesImpossibleOptions) {
  SurfaceOptions options;
  options.surface_gap = -1.0;
  EXPECT_THROW(SurfaceAccumulator(kSurfaceGrid, options), UsageError);
  options = SurfaceOptions();
  options.ground_classes.clear();
  EXPECT_THROW(SurfaceAccumulator(kSurfaceGrid, options), UsageError);
}

}  // namespace
}  // namespace pcl_als
