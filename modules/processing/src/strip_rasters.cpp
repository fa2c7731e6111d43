// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_rasters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/memory.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/io/measured_box.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/raster_io.h>
#include <pcl_als/processing/land_cover_job.h>
#include <pcl_als/survey/survey_messages.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {
namespace {

/// at most, of a tile that is processed, see SurfaceAccumulator
constexpr double kBytesPerCell = 440.0;

/// Of the bands of one round of tiles that the first of several processes receives, unless there
/// are more threads.
constexpr double kRoundBytes = 1e9;

/// A file and the box of its points, wider by its resolution.
struct BoxedFile {
  std::size_t place;  ///< among all files
  std::uint64_t points;
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

/// The values of a tile, band by band.
struct TileResult {
  std::vector<std::vector<float>> bands;  ///< until they are written
  RasterCounts counts;

  void write(const RasterWindow& window, RasterWriter& writer) {
    for (std::size_t i = 0; i < bands.size(); ++i) writer.write(i, window, bands[i].data());
    bands.clear();
  }
};

/// One tile: its points, its bands, its counts.
class TileWork {
 public:
  TileWork(const RasterTile& tile, const SurfaceOptions& options)
      : tile_(tile), accumulator_(tile.padded, options) {}

  void read(const SurveyReader& survey, const std::vector<BoxedFile>& files) {
    SurveyReader::Reading reading;
    reading.threads = 1;
    reading.extra_field = "echo_width";
    for (const BoxedFile& file : files)
      if (file.meets(tile_.padded)) reading.files.push_back(file.place);
    if (reading.files.empty()) return;
    survey.read(
        [this](const SurveyReader::Run& run) {
          for (std::size_t row = run.from; row < run.to; ++row) add(run.chunk, row);
        },
        reading);
  }

  /// The values of the bands in the tile without its margin, and the counts.
  void compute(TileResult& tile) {
    const SurfaceResult result = accumulator_.compute();
    const RasterWindow& window = tile_.window;
    for (const RasterBand& band : result.raster.bands) {
      tile.bands.emplace_back(window.cells());
      for (int row = 0; row < window.rows; ++row)
        std::copy_n(&band.values[inner(0, row)], window.columns,
                    &tile.bands.back()[static_cast<std::size_t>(row) * window.columns]);
    }
    for (int row = 0; row < window.rows; ++row)
      for (int column = 0; column < window.columns; ++column) {
        counts_.surface.add(result.surface_source[inner(column, row)]);
        counts_.terrain.add(result.terrain_source[inner(column, row)]);
      }
    tile.counts = counts_;
  }

 private:
  std::size_t inner(int column, int row) const {
    return tile_.padded.index(column + tile_.margin, row + tile_.margin);
  }

  void add(const PointChunk& chunk, std::size_t i) {
    if ((chunk.flags[i] & kWithheld) != 0) return;
    SurfaceReturn point{chunk.x[i],
                        chunk.y[i],
                        chunk.z[i],
                        chunk.intensity[i],
                        chunk.return_number[i],
                        chunk.number_of_returns[i],
                        chunk.classification[i]};
    if (!chunk.extra.empty()) point.echo_width = static_cast<float>(chunk.extra[i]);
    if (!accumulator_.add(point)) return;
    const long long column = tile_.padded.columnOf(chunk.x[i]) - tile_.margin,
                    row = tile_.padded.rowOf(chunk.y[i]) - tile_.margin;
    if (column < 0 || column >= tile_.window.columns || row < 0 || row >= tile_.window.rows) return;
    ++counts_.points;
    counts_.echo_widths += std::isnan(point.echo_width) ? 0 : 1;
  }

  const RasterTile& tile_;
  SurfaceAccumulator accumulator_;
  RasterCounts counts_;
};

}  // namespace

namespace {

/// Collective: the files with the boxes of their points, in each process.
std::vector<MeasuredFile> measureFiles(const std::vector<std::string>& paths, int threads,
                                       Communicator* processes) {
  std::vector<MeasuredFile> files(paths.size());
  std::vector<double> costs;
  for (const std::string& path : paths) costs.push_back(detail::readingCost(path));
  const SharedItems shares(processes, costs);
  doTogether(processes, [&] {
    for (const std::size_t i : shares.ownItems()) files[i] = measureBox(paths[i], threads);
  });
  shareValues(
      processes, shares, files,
      [](ByteWriter& out, const MeasuredFile& file) {
        detail::put(out, file.info);
        out.put(file.box_remark);
      },
      [](ByteReader& in, MeasuredFile& file) {
        detail::get(in, file.info);
        in.get(file.box_remark);
      });
  return files;
}

}  // namespace

RasterInput rasterInput(const std::vector<std::string>& paths, int threads,
                        Communicator* processes) {
  requirePointFiles(paths.size());
  RasterInput files;
  Eigen::AlignedBox2d box;
  std::vector<PointFileInfo> with_points;
  const std::vector<MeasuredFile> measured = measureFiles(paths, threads, processes);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const PointFileInfo& info = measured[i].info;
    files.paths.emplace_back(paths[i]);
    files.infos.push_back(info);
    if (info.point_count == 0) continue;
    files.points += info.point_count;
    box.extend(info.minimum.head<2>()).extend(info.maximum.head<2>());
    with_points.push_back(info);
  }
  files.min_x = box.min().x(), files.min_y = box.min().y();
  files.max_x = box.max().x(), files.max_y = box.max().y();
  PointReference reference = commonReference(with_points);
  files.crs = std::move(reference.crs);
  files.remarks = std::move(reference.remarks);
  for (const MeasuredFile& file : measured)
    if (!file.box_remark.empty()) files.remarks.push_back(file.box_remark);
  files.survey = std::make_shared<SurveyReader>(SurveyReader::ofWholeFiles(files.infos, threads));
  if (files.points == 0)
    throw InputError(paths.front() + (paths.size() > 1 ? " and the others: hold" : ": holds") +
                     " no points");
  return files;
}

void chooseStrips(const StripChoice& choice, RasterInput& files, int threads) {
  const auto survey = std::make_shared<SurveyReader>(SurveyReader::ofFiles(files.paths, threads));
  survey->choose(choice, {});
  const SurveyReader::Contents contents = survey->measure();
  files.survey = survey;
  files.excluded = contents.excluded;
  files.points = contents.pointCount();
  const Eigen::AlignedBox3d box = contents.box();
  files.min_x = box.min().x(), files.min_y = box.min().y();
  files.max_x = box.max().x(), files.max_y = box.max().y();
}

namespace {

std::vector<BoxedFile> boxedFiles(const RasterInput& files) {
  std::vector<BoxedFile> boxed;
  for (std::size_t place = 0; place < files.paths.size(); ++place) {
    const PointFileInfo& info = files.infos[place];
    const double x = info.resolution.x(), y = info.resolution.y();
    if (info.point_count > 0)
      boxed.push_back({place, info.point_count, info.minimum.x() - x, info.minimum.y() - y,
                       info.maximum.x() + x, info.maximum.y() + y});
  }
  return boxed;
}

/// The smallest of the values of all processes.
int leastOf(Communicator* processes, int value) {
  if (!areShared(processes)) return value;
  for (const std::string& bytes : processes->gatherAll(ByteWriter().put(value).take()))
    value = std::min(value, ByteReader(bytes).take<int>());
  return value;
}

/// By tile of a round: points that are read, and cells. Both take time.
std::vector<double> costsOf(const std::vector<RasterTile>& tiles, std::size_t first,
                            std::size_t count, const std::vector<BoxedFile>& files) {
  std::vector<double> costs;
  for (std::size_t i = first; i < first + count; ++i) {
    costs.push_back(static_cast<double>(tiles[i].padded.cells()));
    for (const BoxedFile& file : files)
      if (file.meets(tiles[i].padded)) costs.back() += static_cast<double>(file.points);
  }
  return costs;
}

/// One process writes tiles as they come; several send them round by round. Long rounds divide the
/// work more evenly.
std::size_t tilesPerRound(const Communicator* processes, const std::vector<RasterTile>& tiles,
                          int threads) {
  if (!areShared(processes)) return tiles.size();
  const double bytes = static_cast<double>(tiles.front().window.cells()) *
                       static_cast<double>(SurfaceAccumulator::bandNames().size() * sizeof(float));
  return std::max(static_cast<std::size_t>(threads) * static_cast<std::size_t>(processes->size()),
                  static_cast<std::size_t>(kRoundBytes / bytes));
}

/// Share of all tiles that are done, where \a done of the own ones of a round are.
double shareOf(std::size_t first, std::size_t done, std::size_t round, std::size_t tiles) {
  return static_cast<double>(first + std::min(done, round)) / static_cast<double>(tiles);
}

/// Collective: the root receives the tiles of all processes.
void sendToRoot(Communicator* processes, const SharedItems& shares,
                std::vector<TileResult>& tiles) {
  std::vector<std::string> bytes(static_cast<std::size_t>(processes->size()));
  ByteWriter out;
  for (const std::size_t i : shares.ownItems()) {
    if (isRoot(processes)) break;
    out.put(i).put(tiles[i].bands);
    tiles[i].bands.clear();
  }
  bytes.front() = out.take();
  for (const std::string& received : processes->exchange(bytes)) {
    for (ByteReader in(received); isRoot(processes) && !in.done();) {
      const auto i = in.take<std::size_t>();
      in.get(tiles[i].bands);
    }
  }
}

}  // namespace

RasterCounts rasterizeStrips(const RasterInput& files, const RasterGrid& grid,
                             const SurfaceOptions& options, int tile_side, int threads,
                             RasterWriter* writer, const std::function<void(double)>& progress,
                             Communicator* processes) {
  const std::vector<BoxedFile> boxed = boxedFiles(files);
  const std::vector<RasterTile> tiles = tilesOf(grid, tile_side, options.margin(grid.cell));
  threads = leastOf(processes, threadsFor(tiles.front(), threads));
  const std::size_t round = tilesPerRound(processes, tiles, threads);
  RasterCounts all;
  std::mutex writing;
  for (std::size_t first = 0; first < tiles.size(); first += round) {
    std::vector<TileResult> results(std::min(round, tiles.size() - first));
    const SharedItems shares(processes, costsOf(tiles, first, results.size(), boxed));
    std::size_t done = 0;
    doTogether(processes, [&] {
      parallelFor(shares.ownItems().size(), threads, [&](std::size_t own) {
        const std::size_t i = shares.ownItems()[own];
        TileWork work(tiles[first + i], options);
        work.read(*files.survey, boxed);
        work.compute(results[i]);
        const std::lock_guard<std::mutex> lock(writing);
        if (writer != nullptr) results[i].write(tiles[first + i].window, *writer);
        progress(shareOf(first, ++done, results.size(), tiles.size()));
      });
    });
    shareValues(
        processes, shares, results,
        [](ByteWriter& out, const TileResult& tile) { out.plain(tile.counts); },
        [](ByteReader& in, TileResult& tile) { in.plain(tile.counts); });
    if (areShared(processes)) sendToRoot(processes, shares, results);
    for (std::size_t i = 0; i < results.size(); ++i) {
      if (writer != nullptr) results[i].write(tiles[first + i].window, *writer);
      all.add(results[i].counts);
    }
  }
  return all;
}

}  // namespace pcl_als
