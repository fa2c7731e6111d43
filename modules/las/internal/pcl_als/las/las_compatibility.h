// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/las/las_file.h>

namespace pcl_als {

/** \brief Values of LAS 1.4 in a file in LAS 1.4 compatibility mode (M. Isenburg, 2015).
 *
 * Such a file has point format 1, 3, 4 or 5 instead of 6 to 10 and keeps in extra bytes, named "LAS
 * 1.4 scan angle" and so on, what those cannot store. Its records are read and written as they are
 * stored; columns get the values that they stand for.
 */
class LasCompatibility {
 public:
  /// The positions of the extra bytes; none where a file is not in that mode.
  static std::optional<LasCompatibility> of(const LasFile& file);

  /// Byte of a record whose bits 1 and 2 are the channel of the scanner.
  std::size_t flagsPosition() const { return flags_; }

  /// Replaces return numbers, classes, flags and scan angles of columns that decodeLasRecords()
  /// made of the same records.
  void restore(const std::byte* records, std::size_t record_length, PointChunk& chunk) const;

 private:
  std::size_t angle_ = 0, returns_ = 0, classification_ = 0, flags_ = 0;  ///< bytes in the record
};

}  // namespace pcl_als
