// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/dataset_inventory.h>

#include "cell_counts.h"

namespace pcl_als::detail {

/// Smallest and largest time in every half second that has points; gaps follow from it.
class TimeBins {
 public:
  void add(double time);
  void add(const TimeBins& other);
  std::vector<TimeGap> gaps(double longer_than) const;
  std::vector<TimeRange> ranges() const;

 private:
  static constexpr double kBin = 0.5;
  static constexpr std::size_t kMaximumTimes =
      1000000;  ///< times that scatter wider are not followed

  std::map<std::int64_t, std::pair<double, double>> bins_;
  std::int64_t last_key_ = 0;
  CachedPlace<std::pair<double, double>> last_;
};

/// Everything that the inventory keeps of the points of one id in one file.
class SourceCounters {
 public:
  /// Takes in rows [first, last) of a chunk; cells of \a cell metres.
  void add(const PointChunk& chunk, std::size_t first, std::size_t last, double cell);
  void add(const SourceCounters& other);

  const PointStatistics& statistics() const { return statistics_; }
  const TimeBins& times() const { return times_; }
  const TimeResolution& resolution() const { return resolution_; }
  const CellCounts& cells() const { return cells_; }
  CellCounts& cells() { return cells_; }
  /// Brings seconds of the week below \a rollover to those of the week before, beyond 604800.
  void unwrap(double rollover);

 private:
  void addPlace(const PointChunk& chunk, std::size_t i, double inverse_cell);
  void addTime(double time);
  void addAttributes(const PointChunk& chunk, std::size_t i);

  PointStatistics statistics_;
  double previous_time_ = 0.0;
  TimeBins times_;
  TimeResolution resolution_;
  CellCounts cells_;
};

/// \a into takes in the points of \a other.
void mergeStatistics(PointStatistics& into, const PointStatistics& other);

}  // namespace pcl_als::detail
