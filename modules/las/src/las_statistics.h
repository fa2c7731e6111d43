// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <Eigen/Geometry>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_header.h>
#include <pcl_als/las/las_record.h>

namespace pcl_als::detail {

/// Bounding box of raw integer coordinates; empty while low > high.
struct LasBox {
  std::array<std::int32_t, 3> low{kMaximumInteger, kMaximumInteger, kMaximumInteger},
      high{kLeast, kLeast, kLeast};

  static constexpr std::int32_t kMaximumInteger = std::numeric_limits<std::int32_t>::max();
  static constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();

  /// Takes in raw records (of at least 20 bytes, as every LAS record has).
  void add(const std::byte* records, std::size_t count, std::size_t record_length);
  void add(const LasBox& other);
  bool operator==(const LasBox& other) const { return low == other.low && high == other.high; }
  bool empty() const { return low[0] > high[0]; }
  Eigen::AlignedBox3d inMetres(const LasFile& file) const;
  /// Stores the box in the unit of the file; an empty one as zeros.
  void store(LasHeader& header) const;
};

/// What a header tells of its points: number, returns by number, box, times as stored.
struct LasStatistics {
  std::uint64_t points = 0;
  std::array<std::uint64_t, 15> by_return{};
  LasBox box;
  TimeRange times;  ///< without zeros

  void add(const std::byte* records, std::size_t count, std::size_t record_length,
           const LasRecordLayout& layout);
  void store(LasHeader& header) const;
};

}  // namespace pcl_als::detail
