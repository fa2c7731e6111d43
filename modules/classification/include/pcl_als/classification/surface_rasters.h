// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/raster.h>

namespace pcl_als {

/// Options of SurfaceAccumulator.
struct SurfaceOptions {
  enum class Interpolation { tin, inverse_distance };
  enum class Ground { classified, filtered };

  Interpolation interpolation = Interpolation::tin;
  /// Limit of the interpolation of empty cells of the surface, metres: largest radius of the circle
  /// through the three cells of a triangle (TIN), or of the circle of cells used (inverse
  /// distance).
  double surface_gap = 6.0;
  double terrain_gap = 30.0;  ///< the same for the terrain, below houses and woods
  /// Ground returns: by ground_classes, or by a morphological filter.
  Ground ground = Ground::classified;
  std::vector<std::uint8_t> ground_classes = groundAndRoads();  ///< ASPRS codes
  double texture_window = 2.5;   ///< side of the square for slope and roughness, metres
  double largest_object = 40.0;  ///< width of the widest building, for Ground::filtered, metres

  static std::vector<std::uint8_t> groundAndRoads();  ///< 2 ground, 9 water, 11 road

  void check() const;  ///< UsageError for impossible values
  /// Width of the margin around a tile on which the values of the tile depend, cells. \a cell:
  /// metres.
  int margin(double cell) const;
};

/// A return with the values that SurfaceAccumulator needs; metres, ground frame.
struct SurfaceReturn {
  double x = 0.0, y = 0.0, z = 0.0;
  float intensity = 0.0F;
  std::uint8_t return_number = 1, number_of_returns = 1, classification = 0;
  /// Full width at half maximum of a decomposed echo, ns; NaN: not recorded.
  float echo_width = std::numeric_limits<float>::quiet_NaN();
};

/// Source of the value of a cell.
enum class CellSource : std::uint8_t { empty, interpolated, measured };

/// Numbers of cells by source.
struct CellCounts {
  std::uint64_t measured = 0, interpolated = 0, empty = 0;
  std::uint64_t cells() const { return measured + interpolated + empty; }
  void add(CellSource source);
  void merge(const CellCounts& other);
};

/// Bands of SurfaceAccumulator, and the source of the values of surface and terrain of each cell
/// (RasterGrid::index()).
struct SurfaceResult {
  Raster raster;
  std::vector<CellSource> surface_source, terrain_source;
};

/** \brief Computes rasters of points: heights, intensity, texture, return statistics.
 *
 * | band | per cell |
 * |---|---|
 * | surface | height of the highest first return, m |
 * | terrain | mean height of the ground returns, m |
 * | height | surface - terrain, m |
 * | intensity | mean of the first returns |
 * | slope | of the plane through the surface within the texture window, degrees |
 * | roughness | RMS distance in height of the surface from that plane, m |
 * | multiple_returns | share of the pulses with more than one return, of the texture window |
 * | height_range | highest first minus lowest last return in the texture window, m |
 * | density | first returns per square metre |
 * | echoes_per_pulse | mean number of returns of the pulses of the first returns |
 * | height_std | standard deviation of the heights of all returns of the cell, m |
 * | echo_width | mean full width at half maximum of the echoes of all returns that have one, ns |
 *
 * Empty cells of surface, terrain, intensity, echoes_per_pulse, height_std and echo_width are
 * interpolated, linearly in the TIN of the cells with returns or by inverse squared distances from
 * the nearest of them. Cells further from any return remain empty. Points of the classes 7 and 18
 * (noise) are excluded.
 *
 * A tile with a margin of SurfaceOptions::margin() cells has the values of the whole block. Memory:
 * 96 bytes per cell, in compute() up to 340 more; none per point.
 * \code
 * pcl_als::SurfaceAccumulator tile(grid, options);
 * for (const pcl_als::SurfaceReturn& point : returns) tile.add(point);
 * const pcl_als::SurfaceResult result = tile.compute();
 * \endcode
 */
class SurfaceAccumulator {
 public:
  /// Names of the bands, in order.
  static const std::vector<std::string>& bandNames();

  /// UsageError for impossible options.
  SurfaceAccumulator(RasterGrid grid, SurfaceOptions options);
  ~SurfaceAccumulator();

  /// Adds a return; false if it is not used, because it lies outside the grid or is noise.
  bool add(const SurfaceReturn& point);
  SurfaceResult compute() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// A tile of a raster, and its grid with the margin.
struct RasterTile {
  RasterWindow window;  ///< within the raster
  RasterGrid padded;
  int margin = 0;  ///< cells around the window in padded
};

/// Divides a raster into tiles of at most \a side cells.
std::vector<RasterTile> tilesOf(const RasterGrid& grid, int side, int margin);

/// UsageError for a name that no band of SurfaceAccumulator has.
void requireBand(const std::string& name);

/// Parses a list of bands "height,intensity". UsageError for a name that SurfaceAccumulator does
/// not have, a repeated name, and an empty list.
std::vector<std::string> bandsIn(const std::string& list);

/// Parses a list of ASPRS class codes "2,9". UsageError for anything that is no code, and for an
/// empty list.
std::vector<std::uint8_t> classCodesIn(const std::string& list);

}  // namespace pcl_als
