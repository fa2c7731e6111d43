// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <pcl_als/common/coordinate_steps.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/dataset_inventory.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/io/time_scale.h>

#include "duplicate_sample.h"
#include "inventory_remarks.h"
#include "simultaneous_strips.h"
#include "source_counters.h"

namespace pcl_als {
namespace {

using detail::CellCounts;
using detail::SourceCounters;

// 1.1 kB each with their place in the table.
constexpr std::size_t kMostBlocks = std::size_t{1} << 17U;
constexpr unsigned kMostDoublings = 40;  // then everything is in one block
constexpr double kPointsPerCell = 20.0;
// The inventory describes what other jobs refuse.
constexpr auto kAnyCoordinates = PointReader::OtherCoordinates::as_stored;

class Inventory {
 public:
  Inventory(const std::vector<std::filesystem::path>& paths, double cell,
            const std::function<void(double)>& progress, const InventoryStrips& strips,
            const PointWindow& window)
      : progress_(progress), given_(strips) {
    survey_.window = window;
    for (const auto& path : paths) {
      survey_.files.emplace_back().info = PointReader::open(path, window, kAnyCoordinates)->info();
      total_ += survey_.files.back().info.point_count;
    }
    survey_.cell = cell > 0.0 ? cell : usualInventoryCell(infos());
  }

  /// Reads all files. \return false where a header that is wrong made the cells too small or large.
  bool read() {
    const double used = survey_.cell;
    for (std::size_t f = 0; f < survey_.files.size(); ++f) readFile(f);
    std::vector<PointFileInfo> measured = infos();
    for (std::size_t f = 0; f < measured.size(); ++f) {
      const PointStatistics& s = survey_.files[f].statistics;
      measured[f].point_count = s.points;
      measured[f].minimum = s.minimum, measured[f].maximum = s.maximum;
    }
    proper_cell_ = usualInventoryCell(measured);
    return !wrong_header_ || used == proper_cell_;
  }
  double properCell() const { return proper_cell_; }

  DatasetInventory take() {
    if (done_ == 0 && !survey_.window.everything()) refuseNothingRead();
    unwrapWeek();
    survey_.duplicates = duplicates_.count();
    survey_.duplicates_estimated = duplicates_.estimated();
    joinStrips();
    findOverlaps();
    detail::addRemarks(survey_);
    return std::move(survey_);
  }

 private:
  using SourceKey = std::pair<std::size_t, int>;  // file; point source id, or index of given_

  std::vector<PointFileInfo> infos() const {
    std::vector<PointFileInfo> infos;
    for (const FileInventory& file : survey_.files) infos.push_back(file.info);
    return infos;
  }

  [[noreturn]] void refuseNothingRead() const {
    std::vector<std::filesystem::path> paths;
    for (const FileInventory& file : survey_.files) paths.push_back(file.info.path);
    refuseEmptyWindow(paths, survey_.window);
  }

  void readFile(std::size_t f) {
    const auto reader =
        PointReader::open(survey_.files[f].info.path, survey_.window, kAnyCoordinates);
    if (!reader->damage().empty()) survey_.files[f].remarks.push_back(reader->damage());
    for (const std::string& text : reader->remarks()) survey_.files[f].remarks.push_back(text);
    PointChunk chunk;
    std::vector<Eigen::Vector3d> first;
    while (reader->read(chunk)) {
      addChunk(f, chunk);
      for (std::size_t i = 0; i < chunk.size() && first.size() < kEnoughForSteps; ++i)
        first.emplace_back(chunk.x[i], chunk.y[i], chunk.z[i]);
      duplicates_.add(chunk);
      done_ += chunk.size();
      // Of a part of a file the number of points is only estimated before.
      if (progress_)
        progress_(std::min(1.0, static_cast<double>(done_) / static_cast<double>(total_)));
    }
    for (const auto& [key, counters] : sources_)
      if (key.first == f)
        detail::mergeStatistics(survey_.files[f].statistics, counters.statistics());
    survey_.files[f].steps = coordinateSteps(first);
    const PointStatistics& s = survey_.files[f].statistics;
    if (s.points == s.invalid_coordinates) return;
    const std::string remark = reader->boxRemark({s.minimum, s.maximum});
    if (remark.empty()) return;
    survey_.files[f].remarks.push_back(remark);
    wrong_header_ = true;
  }

  /// Runs of the same strip, as most chunks have few.
  void addChunk(std::size_t f, const PointChunk& chunk) {
    for (std::size_t first = 0; first < chunk.size();) {
      const auto [last, source] =
          given_.run ? given_.run(f, chunk, first) : sourceRun(chunk, first);
      sources_[{f, source}].add(chunk, first, last, survey_.cell);
      first = last;
    }
    limitMemory();
  }

  static std::pair<std::size_t, int> sourceRun(const PointChunk& chunk, std::size_t first) {
    const auto& ids = chunk.point_source_id;
    std::size_t last = first + 1;
    while (last < ids.size() && ids[last] == ids[first]) ++last;
    return {last, ids[first]};
  }

  /// Blocks of cells of all sources after joining squares of 2^doublings cells.
  std::size_t blocksAfter(unsigned doublings) const {
    std::size_t count = 0;
    for (const auto& source : sources_) {
      const CellCounts& cells = source.second.cells();
      count += doublings == 0 ? cells.blockCount() : cells.blockCountAfter(doublings);
    }
    return count;
  }

  /// Larger cells where there are too many, with room for as many again.
  void limitMemory() {
    if (blocksAfter(0) <= kMostBlocks) return;
    unsigned doublings = 1;
    while (blocksAfter(doublings) > kMostBlocks / 2 && doublings < kMostDoublings) ++doublings;
    for (auto& source : sources_) source.second.cells().coarsen(doublings);
    survey_.cell = std::ldexp(survey_.cell, static_cast<int>(doublings));
  }

  /// Lines that go on through the end of a GPS week.
  void unwrapWeek() {
    std::vector<TimeRange> observed;
    for (const auto& source : sources_) {
      for (const TimeRange& range : source.second.times().ranges())
        if (range.last != 0.0) observed.push_back(range);  // zero: none
    }
    const auto rollover = weekRollover(std::move(observed));
    if (!rollover) return;
    survey_.remarks.emplace_back(
        "the flight passes the end of a GPS week: the times after it are given as seconds beyond "
        "604800");
    std::vector<TimeRange> of_files(survey_.files.size());
    for (auto& [key, counters] : sources_) {
      counters.unwrap(*rollover);
      const PointStatistics& s = counters.statistics();
      of_files[key.first].add(s.first_time);
      of_files[key.first].add(s.last_time);
    }
    for (std::size_t f = 0; f < of_files.size(); ++f) {
      if (of_files[f].empty()) continue;
      survey_.files[f].statistics.first_time = of_files[f].first;
      survey_.files[f].statistics.last_time = of_files[f].last;
    }
  }

  /// By key; points of no strip have none.
  std::map<SourceKey, std::string> nameStrips(std::vector<std::string>& names) const {
    std::map<SourceKey, std::string> name_of;
    if (given_.run) {
      names = given_.names;
      for (const auto& source : sources_) {
        const int strip = source.first.second;
        if (strip >= 0) name_of[source.first] = names[static_cast<std::size_t>(strip)];
      }
      return name_of;
    }
    std::vector<PointFileSources> files;
    for (const FileInventory& file : survey_.files) files.push_back({file.info, {}});
    for (const auto& [key, counters] : sources_) {
      const PointStatistics& s = counters.statistics();
      files[key.first].sources.push_back({static_cast<std::uint16_t>(key.second), s.points,
                                          s.first_time, s.last_time, s.minimum, s.maximum});
    }
    const StripNaming naming(files);
    names = naming.names();
    for (const auto& source : sources_) {
      const auto id = static_cast<std::uint16_t>(source.first.second);
      name_of[source.first] = naming.nameOf(source.first.first, id);
    }
    return name_of;
  }

  void joinStrips() {
    std::vector<std::string> names;
    const std::map<SourceKey, std::string> name_of = nameStrips(names);
    std::map<std::string, SourceCounters> strips;
    for (auto& [key, counters] : sources_) {
      const auto name = name_of.find(key);
      if (name == name_of.end()) continue;
      const auto [strip, is_new] = strips.try_emplace(name->second);
      if (is_new)
        strip->second = std::move(counters);
      else
        strip->second.add(counters);
      counters = SourceCounters();
    }
    const double cell_area = survey_.cell * survey_.cell;
    std::vector<std::vector<TimeRange>> times;
    for (const std::string& name : names) {
      SourceCounters& counters = strips[name];
      StripInventory strip;
      strip.id = name;
      strip.statistics = counters.statistics();
      strip.gaps = counters.times().gaps(DatasetInventory::kGap);
      strip.times = counters.resolution();
      times.push_back(counters.times().ranges());
      strip.area = static_cast<double>(counters.cells().occupied()) * cell_area;
      strip.density = counters.cells().typicalCount() / cell_area;
      survey_.strips.push_back(std::move(strip));
      cells_.push_back(std::move(counters.cells()));
      strips.erase(name);
    }
    const auto companions = detail::simultaneousStrips(times);
    for (std::size_t s = 0; s < companions.size(); ++s)
      survey_.strips[s].recorded_with = companions[s];
  }

  bool boxesMeet(std::size_t a, std::size_t b) const {
    const PointStatistics &s = survey_.strips[a].statistics, &t = survey_.strips[b].statistics;
    const double margin = survey_.cell;
    return s.minimum.x() <= t.maximum.x() + margin && t.minimum.x() <= s.maximum.x() + margin &&
           s.minimum.y() <= t.maximum.y() + margin && t.minimum.y() <= s.maximum.y() + margin;
  }

  void findOverlaps() {
    const double cell_area = survey_.cell * survey_.cell;
    const std::size_t lines = cells_.size() <= DatasetInventory::kMostLines ? cells_.size() : 0;
    for (std::size_t a = 0; a < lines; ++a)
      for (std::size_t b = a + 1; b < lines; ++b) {
        if (!boxesMeet(a, b)) continue;
        std::uint64_t shared = 0;
        const bool a_smaller = cells_[a].blockCount() < cells_[b].blockCount();
        const CellCounts& other = cells_[a_smaller ? b : a];
        forEachCell(cells_[a_smaller ? a : b], [&](std::int64_t x, std::int64_t y, std::uint32_t) {
          shared += other.at(x, y) != 0 ? 1 : 0;
        });
        if (shared > 0) survey_.overlaps.push_back({a, b, static_cast<double>(shared) * cell_area});
      }
    CellCounts strips_per_cell;
    for (const CellCounts& cells : cells_)
      forEachCell(
          cells, [&](std::int64_t x, std::int64_t y, std::uint32_t) { strips_per_cell.add(x, y); });
    survey_.area_by_strips.assign(cells_.size(), 0.0);
    forEachCell(strips_per_cell, [&](std::int64_t, std::int64_t, std::uint32_t strips) {
      survey_.area_by_strips[strips - 1] += cell_area;
    });
    while (!survey_.area_by_strips.empty() && survey_.area_by_strips.back() == 0.0)
      survey_.area_by_strips.pop_back();
  }

  const std::function<void(double)>& progress_;
  const InventoryStrips& given_;
  DatasetInventory survey_;
  std::uint64_t total_ = 0, done_ = 0;
  bool wrong_header_ = false;  ///< of any file
  double proper_cell_ = 0.0;   ///< by the points
  std::map<SourceKey, SourceCounters> sources_;
  std::vector<CellCounts> cells_;  ///< by strip
  detail::DuplicateSample duplicates_;
};

}  // namespace

double usualInventoryCell(const std::vector<PointFileInfo>& files) {
  double area = 0.0;
  std::uint64_t points = 0;
  for (const PointFileInfo& file : files) {
    const Eigen::Vector3d size = file.maximum - file.minimum;
    area += size.x() * size.y();
    points += file.point_count;
  }
  const double side = std::sqrt(kPointsPerCell * area / static_cast<double>(points));
  for (const double cell : {1.0, 2.0, 5.0})
    if (side <= cell) return cell;
  return 10.0;
}

DatasetInventory takeInventory(const std::vector<std::filesystem::path>& files, double cell,
                               const std::function<void(double)>& progress,
                               const InventoryStrips& strips, const PointWindow& window) {
  if (!(std::isfinite(cell) && cell >= 0.0)) throw UsageError("cell size must be positive, metres");
  Inventory inventory(files, cell, progress, strips, window);
  // Given strips are counted as they are read, and their cell is given.
  if (inventory.read() || cell > 0.0 || strips.run) return inventory.take();
  Inventory again(files, inventory.properCell(), progress, strips, window);
  again.read();
  return again.take();
}

}  // namespace pcl_als
