// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <limits>
#include <mutex>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/memory.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_flag.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/processing/strip_rasters.h>

namespace pcl_als {
namespace {

/// at most, of a tile that is processed, see SurfaceAccumulator
constexpr double kBytesPerCell = 380.0;

/// A file and the box its header gives, wider by its resolution.
struct BoxedFile {
  std::filesystem::path path;
  std::size_t place;  ///< among all files
  double min_x, min_y, max_x, max_y;

  bool meets(const RasterGrid& grid) const {
    return max_x >= grid.west && min_x <= grid.east() && max_y >= grid.south() &&
           min_y <= grid.north;
  }
};

/// The number of threads whose tiles fit into half of the memory.
int threadsFor(const RasterTile& tile, int threads) {
  const double memory = physicalMemory(),
               needed = kBytesPerCell * static_cast<double>(tile.padded.cells());
  if (memory > 0.0 && needed > 0.8 * memory)
    throw UsageError("a tile of " + std::to_string(tile.window.columns) +
                     " cells with margins of " + std::to_string(tile.margin) + " needs " +
                     std::to_string(static_cast<long>(needed / 1e9)) +
                     " GB of memory; take smaller gaps, larger cells or smaller tiles");
  const double room = memory > 0.0 ? 0.5 * memory / needed : 1e9;
  return std::max(1, static_cast<int>(std::min<double>(threadCount(threads), room)));
}

/// One tile: its points, its bands, its counts.
class TileWork {
 public:
  TileWork(const RasterTile& tile, const SurfaceOptions& options, const ArrangedFiles* arranged)
      : tile_(tile), accumulator_(tile.padded, options), arranged_(arranged) {}

  void read(const BoxedFile& file) {
    const auto reader = PointReader::open(file.path);
    std::optional<StripArrangement::Sorter> sorter;
    if (arranged_ != nullptr) sorter.emplace(arranged_->arrangement(), file.place);
    PointChunk chunk;
    while (reader->read(chunk))
      for (std::size_t i = 0; i < chunk.size(); ++i)
        if (!sorter || isUsed(*sorter, chunk, i)) add(chunk, i);
  }

  void write(RasterWriter& writer, std::mutex& writing) {
    const SurfaceResult result = accumulator_.compute();
    const RasterWindow& window = tile_.window;
    std::vector<std::vector<float>> bands;
    for (const RasterBand& band : result.raster.bands) {
      bands.emplace_back(window.cells());
      for (int row = 0; row < window.rows; ++row)
        std::copy_n(&band.values[inner(0, row)], window.columns,
                    &bands.back()[static_cast<std::size_t>(row) * window.columns]);
    }
    for (int row = 0; row < window.rows; ++row)
      for (int column = 0; column < window.columns; ++column) {
        counts_.surface.add(result.surface_source[inner(column, row)]);
        counts_.terrain.add(result.terrain_source[inner(column, row)]);
      }
    const std::lock_guard<std::mutex> lock(writing);
    for (std::size_t i = 0; i < bands.size(); ++i) writer.write(i, window, bands[i].data());
  }
  const RasterCounts& counts() const { return counts_; }

 private:
  std::size_t inner(int column, int row) const {
    return tile_.padded.index(column + tile_.margin, row + tile_.margin);
  }

  bool isUsed(StripArrangement::Sorter& sorter, const PointChunk& chunk, std::size_t i) const {
    const std::size_t label = sorter.label(chunk.point_source_id[i], chunk.gps_time[i]);
    return arranged_->arrangement().labels()[label].index >= 0;
  }

  void add(const PointChunk& chunk, std::size_t i) {
    if ((chunk.flags[i] & kWithheld) != 0) return;
    const bool used = accumulator_.add({chunk.x[i], chunk.y[i], chunk.z[i], chunk.intensity[i],
                                        chunk.return_number[i], chunk.number_of_returns[i],
                                        chunk.classification[i]});
    if (!used) return;
    const long long column = tile_.padded.columnOf(chunk.x[i]) - tile_.margin,
                    row = tile_.padded.rowOf(chunk.y[i]) - tile_.margin;
    if (column >= 0 && column < tile_.window.columns && row >= 0 && row < tile_.window.rows)
      ++counts_.points;
  }

  const RasterTile& tile_;
  SurfaceAccumulator accumulator_;
  const ArrangedFiles* arranged_;
  RasterCounts counts_;
};

}  // namespace

RasterInput rasterInput(const std::vector<std::string>& paths) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  RasterInput files;
  files.min_x = files.min_y = kFar, files.max_x = files.max_y = -kFar;
  std::vector<PointFileInfo> infos;
  for (const std::string& path : paths) {
    const auto reader = PointReader::open(path);
    const PointFileInfo& info = reader->info();
    files.paths.emplace_back(path);
    if (info.point_count == 0) continue;
    files.points += info.point_count;
    files.min_x = std::min(files.min_x, info.minimum.x());
    files.min_y = std::min(files.min_y, info.minimum.y());
    files.max_x = std::max(files.max_x, info.maximum.x());
    files.max_y = std::max(files.max_y, info.maximum.y());
    infos.push_back(info);
  }
  PointReference reference = commonReference(infos);
  files.crs = std::move(reference.crs);
  files.remarks = std::move(reference.remarks);
  if (files.points == 0)
    throw InputError(paths.front() + (paths.size() > 1 ? " and the others: hold" : ": holds") +
                     " no points");
  return files;
}

void chooseStrips(const StripChoice& choice, RasterInput& files) {
  files.arranged = std::make_shared<ArrangedFiles>(files.paths, choice);
  const ArrangedFiles::Use use = files.arranged->use();
  files.left_out = use.left_out;
  files.points = use.pointCount();
  const Eigen::AlignedBox3d box = use.box();
  files.min_x = box.min().x(), files.min_y = box.min().y();
  files.max_x = box.max().x(), files.max_y = box.max().y();
}

RasterCounts rasterizeStrips(const RasterInput& files, const SurfaceOptions& options, int tile_side,
                             int threads, RasterWriter& writer,
                             const std::function<void(double)>& progress) {
  std::vector<BoxedFile> boxed;
  for (std::size_t place = 0; place < files.paths.size(); ++place) {
    const std::filesystem::path& path = files.paths[place];
    const PointFileInfo info = PointReader::open(path)->info();
    const double x = info.resolution.x(), y = info.resolution.y();
    if (info.point_count > 0)
      boxed.push_back({path, place, info.minimum.x() - x, info.minimum.y() - y,
                       info.maximum.x() + x, info.maximum.y() + y});
  }
  const RasterGrid& grid = writer.layout().grid;
  const std::vector<RasterTile> tiles = tilesOf(grid, tile_side, options.margin(grid.cell));
  std::vector<RasterCounts> counts(tiles.size());
  std::mutex writing, reporting;
  std::size_t done = 0;
  parallelFor(tiles.size(), threadsFor(tiles.front(), threads), [&](std::size_t i) {
    TileWork work(tiles[i], options, files.arranged.get());
    for (const BoxedFile& file : boxed)
      if (file.meets(tiles[i].padded)) work.read(file);
    work.write(writer, writing);
    counts[i] = work.counts();
    const std::lock_guard<std::mutex> lock(reporting);
    progress(static_cast<double>(++done) / static_cast<double>(tiles.size()));
  });
  RasterCounts all;
  for (const RasterCounts& part : counts) {
    all.points += part.points;
    all.surface.merge(part.surface);
    all.terrain.merge(part.terrain);
  }
  return all;
}

}  // namespace pcl_als
