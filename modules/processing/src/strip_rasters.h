// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>

namespace pcl_als {

class Communicator;
struct RasterCounts;
struct RasterGrid;
struct RasterInput;
class RasterWriter;
struct SurfaceOptions;

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
