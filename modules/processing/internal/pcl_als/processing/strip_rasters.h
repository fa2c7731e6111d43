// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/classification/surface_rasters.h>
#include <pcl_als/common/excluded_points.h>
#include <pcl_als/common/point_file_info.h>
#include <pcl_als/common/raster.h>
#include <pcl_als/survey/strip_choice.h>

namespace pcl_als {

class Communicator;
class RasterWriter;
class SurveyReader;

/// Contents of point files.
struct RasterInput {
  std::vector<std::filesystem::path> paths;
  std::vector<PointFileInfo> infos;  ///< of each, with the box of its points
  std::uint64_t points = 0;
  double min_x = 0.0, min_y = 0.0, max_x = 0.0, max_y = 0.0;  ///< of the points, metres
  std::string crs;                                            ///< of the first file that has one
  /// Units that are converted or assumed, headers that state another box than that of the points.
  std::vector<std::string> remarks;
  /// The same files: all points, or those of chooseStrips().
  std::shared_ptr<const SurveyReader> survey;
  std::vector<ExcludedPoints> excluded;
};

/** \brief Reads the coordinates of every file once, because the box in a header may be wrong.
 *
 * Collective: \a processes (null: one) share the files. InputError for files without points or that
 * commonReference() refuses. \a threads: 0: all cores.
 */
RasterInput rasterInput(const std::vector<std::string>& paths, int threads = 0,
                        Communicator* processes = nullptr);
/// Restricts the contents to the chosen strips: reads every file twice.
void chooseStrips(const StripChoice& choice, RasterInput& files, int threads = 0);

struct RasterCounts {
  std::uint64_t points = 0;       ///< inside the raster, without noise
  std::uint64_t echo_widths = 0;  ///< of these, with the width of a decomposed echo
  CellCounts surface, terrain;

  void add(const RasterCounts& other) {
    points += other.points;
    echo_widths += other.echo_widths;
    surface.merge(other.surface);
    terrain.merge(other.terrain);
  }
};

/** \brief Makes the rasters of SurfaceAccumulator from point files, tile by tile.
 *
 * Each tile reads the files whose box intersects it, so that the memory is that of a tile per
 * thread for any number of points. \a progress is called by one thread at a time. Collective: \a
 * processes (null: one) share the tiles; the first one, which alone has a \a writer, receives and
 * writes them.
 */
RasterCounts rasterizeStrips(const RasterInput& files, const RasterGrid& grid,
                             const SurfaceOptions& options, int tile_side, int threads,
                             RasterWriter* writer, const std::function<void(double)>& progress,
                             Communicator* processes = nullptr);

}  // namespace pcl_als
