// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>

#include <pcl_als/las/las_file.h>

namespace pcl_als {

/** \brief Bytes of a LAS or LAZ file behind its points that neither the header nor an extended VLR
 * refers to.
 *
 * A header that announces too few points leaves whole records there.
 */
struct UnclaimedBytes {
  std::uint64_t bytes = 0;
  /// Records that the bytes directly behind the points of a .las would make; 0: no whole number.
  std::uint64_t records = 0;
  std::uint64_t record_length = 0;
  /// Of a .laz: bytes of compressed points behind the announced ones, besides \a bytes.
  std::uint64_t surplus_points = 0;

  bool any() const { return bytes > 0 || surplus_points > 0; }
  /// "560 bytes behind the points belong to no record; they have the size of 20 further points of
  /// 28 bytes, which the header does not count"; empty where there are none.
  std::string describe() const;
  /// The same of a copy, which has the bytes but not the compressed points.
  std::string describeCopy() const;
};

/// Of a truncated file that is read all the same: none.
UnclaimedBytes unclaimedBytes(const LasFile& file);

}  // namespace pcl_als
