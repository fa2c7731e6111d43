// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/las/las_file.h>

namespace pcl_als {

/// How much of a file to sample: runs of consecutive points, evenly spaced from its first point to
/// its last.
struct SampleSize {
  std::size_t runs = 256;
  std::size_t points_per_run = 16;
  std::size_t most_places = 16;  ///< of a compressed file that are read

  /// Enough to see pitch, crab and roll by, several times in every second of a flight line. A
  /// compressed file is decoded once.
  static SampleSize forAttitude() { return {16384, 16, 16384}; }
  std::size_t points() const { return runs * points_per_run; }
};

/** \brief Hands out some points of a LAS file, run by run, in file order.
 *
 * A file with no more points than the sample is handed out whole. An uncompressed file is read
 * only where the runs lie; of a compressed one, of which each place costs the decoding of a chunk,
 * at most most_places are read, with proportionally longer runs.
 */
void samplePoints(const LasFile& file, SampleSize size,
                  const std::function<void(const PointChunk&)>& visit);

}  // namespace pcl_als
