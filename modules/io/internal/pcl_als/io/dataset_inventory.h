// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/time_resolution.h>
#include <pcl_als/io/point_reader.h>

namespace pcl_als {

/// A stretch of time in which a strip has no point, seconds.
struct TimeGap {
  double from = 0.0, to = 0.0;
};

/// Statistics of a set of points. Extents and ranges are of finite values; 0 without points.
struct PointStatistics {
  std::uint64_t points = 0, single_returns = 0, first_returns = 0;
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();  ///< metres, ground frame
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  double first_time = 0.0, last_time = 0.0;                  ///< seconds, as the file counts
  float least_scan_angle = 0.0F, largest_scan_angle = 0.0F;  ///< degrees, the file's sign
  float least_intensity = 0.0F, largest_intensity = 0.0F;
  std::uint64_t unsorted_times = 0;  ///< points that are earlier than the one before
  std::uint64_t zero_times = 0, invalid_times = 0;
  std::uint64_t invalid_coordinates = 0;  ///< not finite, or past a million kilometres
  std::uint64_t wrong_returns = 0;        ///< return number 0 or above the number of returns
  std::uint64_t withheld = 0, synthetic = 0, overlap_flags = 0;
  std::array<std::uint64_t, 4> channels{};  ///< by scanner channel; all are 0 in LAS before 1.4
  std::array<std::uint64_t, 256> classes{};
  std::array<std::uint64_t, 16> returns{};  ///< by return number
};

struct FileInventory {
  PointFileInfo info;
  PointStatistics statistics;
  /// Of the coordinates of its first points, metres; zero: unknown; see coordinateSteps().
  Eigen::Vector3d steps = Eigen::Vector3d::Zero();
  Warnings remarks;  ///< suspicious facts in plain words
};

struct StripInventory {
  std::string id;
  PointStatistics statistics;
  std::vector<TimeGap> gaps;  ///< longer than DatasetInventory::kGap
  TimeResolution times;       ///< of the points with a time
  double area = 0.0;          ///< m2: cells that hold a point
  double density =
      0.0;  ///< points per m2: median over cells whose eight neighbours hold points too
  /// A strip that was recorded at the same times: at least half of the seconds of this strip are
  /// those of other strips, and most of these are of that one. An index; none: empty.
  std::optional<std::size_t> recorded_with;
  Warnings remarks;
};

struct StripOverlap {
  std::size_t a = 0, b = 0;  ///< indices of strips
  double area = 0.0;         ///< m2: cells that hold points of both
};

/// What a set of point files holds.
struct DatasetInventory {
  static constexpr double kGap = 1.0;              ///< seconds
  static constexpr std::size_t kMostLines = 1000;  ///< flight lines of one survey

  PointWindow window;  ///< the part of the files that was read
  std::vector<FileInventory> files;
  std::vector<StripInventory> strips;  ///< named and joined by StripNaming
  std::vector<StripOverlap> overlaps;  ///< empty for more than kMostLines strips
  std::vector<double> area_by_strips;  ///< m2 of cells seen by 1, 2, … strips
  double cell = 0.0;                   ///< metres
  std::uint64_t duplicates = 0;  ///< points equal to another in place, time, return and source id
  bool duplicates_estimated = false;
  Warnings remarks;
};

/// Assignment of points to strips where StripNaming does not determine it (module survey).
struct InventoryStrips {
  std::vector<std::string> names;
  /// The end of the run of points of one strip that starts with row \a from of a chunk, and the
  /// strip's index among the names; -1: of none, then they count for their file only. Is called
  /// with all points of the files in order; empty: strips are those of StripNaming.
  std::function<std::pair<std::size_t, int>(std::size_t file, const PointChunk& chunk,
                                            std::size_t from)>
      run;
};

/// 1, 2, 5 or 10 m, so that a cell of files of this number of points in these boxes holds about 20.
double usualInventoryCell(const std::vector<PointFileInfo>& files);

/** \brief Reads point files once and lists their contents.
 *
 * Memory is that of the occupied cells (4 bytes each) and at most a few hundred MB: where the
 * points are spread over more cells the cell size doubles, and duplicates are counted in a sample
 * of the points chosen by hash (all points up to half a million).
 *
 * Files whose headers state a wrong bounding box may be read twice, because the size of the cells
 * depends on it.
 *
 * \param cell metres; 0: usualInventoryCell()
 * \param progress called with the fraction of points read
 * \param strips whose names are listed, one entry each
 * \param window the part of the files that is read
 */
DatasetInventory takeInventory(const std::vector<std::filesystem::path>& files, double cell = 0.0,
                               const std::function<void(double)>& progress = {},
                               const InventoryStrips& strips = {}, const PointWindow& window = {});

}  // namespace pcl_als
