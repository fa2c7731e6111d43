// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <mutex>
#include <vector>

#include <pcl_als/common/parallel.h>
#include <pcl_als/las/point_box.h>

#include "las_statistics.h"

namespace pcl_als {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

}  // namespace

Eigen::AlignedBox3d pointBox(const LasFile& file, int threads) {
  const std::size_t length = file.header().record_length;
  const std::uint64_t count = file.header().point_count;
  const std::size_t per_block = std::max<std::size_t>(1, kBlockBytes / length);
  // Compressed points are decoded on several threads in the order of the file.
  const int readers = file.header().compressed ? 1 : threads;
  std::mutex mutex;
  detail::LasBox box;
  parallelFor((count + per_block - 1) / per_block, readers, [&](std::size_t block) {
    thread_local std::vector<std::byte> records;
    const std::uint64_t first = block * per_block;
    const std::size_t part = std::min<std::uint64_t>(per_block, count - first);
    records.resize(part * length);
    file.readRecords(first, part, records.data());
    detail::LasBox own;
    own.add(records.data(), part, length);
    const std::lock_guard<std::mutex> lock(mutex);
    box.add(own);
  });
  return box.inMetres(file);
}

}  // namespace pcl_als
