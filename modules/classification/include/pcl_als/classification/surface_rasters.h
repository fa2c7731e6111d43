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

/// Options of the rasters of points.
struct SurfaceOptions {
  enum class Interpolation { tin, inverse_distance };
  enum class Ground { classified, filtered };

  Interpolation interpolation = Interpolation::tin;
  /// Empty cells of the surface are interpolated where the circle through the three points around
  /// them has at most this radius (TIN), or from points within it (inverse distance), metres.
  double surface_gap = 6.0;
  double terrain_gap = 30.0;  ///< the same for the terrain, which has houses and woods to bridge
  Ground ground = Ground::classified;
  std::vector<std::uint8_t> ground_classes = groundAndRoads();  ///< ASPRS codes
  double texture_window = 2.5;   ///< side of the square for slope and roughness, metres
  double largest_object = 40.0;  ///< width of the widest building, for Ground::filtered, metres

  static std::vector<std::uint8_t> groundAndRoads();  ///< 2 ground, 9 water, 11 road

  /// UsageError for values that are impossible.
  void check() const;
  /// Number of cells around a tile on which its cells depend.
  int margin(double cell) const;
};

/// A return with the values that rasters need; metres, ground frame.
struct SurfaceReturn {
  double x = 0.0, y = 0.0, z = 0.0;
  float intensity = 0.0F;
  std::uint8_t return_number = 1, number_of_returns = 1, classification = 0;
  /// Full width at half maximum of a decomposed echo, ns; NaN: not recorded.
  float echo_width = std::numeric_limits<float>::quiet_NaN();
};

/// Source of the value of a cell.
enum class CellSource : std::uint8_t { empty, interpolated, measured };

struct CellCounts {
  std::uint64_t measured = 0, interpolated = 0, empty = 0;
  std::uint64_t cells() const { return measured + interpolated + empty; }
  void add(CellSource source);
  void merge(const CellCounts& other);
};

/** \brief Rasters of the points over a grid: heights, intensity, texture, return statistics.
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
 * Cells without returns are interpolated (surface, terrain, intensity, echoes_per_pulse,
 * height_std, echo_width): linearly in the TIN of the
 * cells with returns, or by inverse squared distances from the nearest of them; cells further from
 * any return stay empty. Points of the classes 7 and 18 (noise) are excluded.
 *
 * A tile with SurfaceOptions::margin() cells around it has the values of the whole block. Memory:
 * 96 bytes per cell, in compute() up to 340 more; none per point.
 * \code
 * SurfaceAccumulator tile(grid, options);
 * for (…) tile.add({x, y, z, intensity, return_number, number_of_returns, classification});
 * const SurfaceResult result = tile.compute();
 * \endcode
 */
struct SurfaceResult {
  Raster raster;
  std::vector<CellSource> surface_source, terrain_source;
};

class SurfaceAccumulator {
 public:
  /// Names of the bands, in order.
  static const std::vector<std::string>& bandNames();

  SurfaceAccumulator(RasterGrid grid, SurfaceOptions options);
  ~SurfaceAccumulator();

  /// False for a point outside the grid or of noise, which is not used.
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

/// The bands of a list "height,intensity". UsageError for a name that SurfaceAccumulator does not
/// have, for one that appears twice, and for a list without names.
std::vector<std::string> bandsIn(const std::string& list);

/// The ASPRS class codes of a list "2,9". UsageError for what is no code, and for an empty list.
std::vector<std::uint8_t> classCodesIn(const std::string& list);

}  // namespace pcl_als
