// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "las_statistics.h"

#include <algorithm>
#include <cmath>

namespace pcl_als::detail {
namespace {

// X, Y, Z and the four bytes behind them as one vector, so that every compiler makes a handful of
// instructions per point of it; the fourth lane is ignored.
using Lanes = std::int32_t __attribute__((vector_size(16)));

}  // namespace

void LasBox::add(const std::byte* records, std::size_t count, std::size_t record_length) {
  // Several boxes side by side: a minimum waits for the one before it.
  constexpr std::size_t kSide = 4;
  Lanes least[kSide], most[kSide];
  for (std::size_t k = 0; k < kSide; ++k) {
    least[k] = Lanes{low[0], low[1], low[2], 0};
    most[k] = Lanes{high[0], high[1], high[2], 0};
  }
  const auto take = [&](std::size_t i, std::size_t k) {
    const auto value = loadLas<Lanes>(records + i * record_length);
    least[k] = value < least[k] ? value : least[k];
    most[k] = value > most[k] ? value : most[k];
  };
  std::size_t i = 0;
  for (; i + kSide <= count; i += kSide)
    for (std::size_t k = 0; k < kSide; ++k) take(i + k, k);
  for (; i < count; ++i) take(i, 0);
  for (std::size_t k = 0; k < kSide; ++k)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], least[k][axis]);
      high[axis] = std::max(high[axis], most[k][axis]);
    }
}

void LasBox::add(const LasBox& other) {
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::min(low[axis], other.low[axis]);
    high[axis] = std::max(high[axis], other.high[axis]);
  }
}

void LasBox::store(LasHeader& header) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double scale = header.scale[axis], offset = header.offset[axis];
    const double first = empty() ? 0.0 : low[axis] * scale + offset;
    const double last = empty() ? 0.0 : high[axis] * scale + offset;
    header.minimum[axis] = std::min(first, last);  // the scale may be negative
    header.maximum[axis] = std::max(first, last);
  }
}

Eigen::AlignedBox3d LasBox::inMetres(const LasFile& file) const {
  if (empty()) return {};
  LasHeader header = file.header();
  store(header);
  const Eigen::Vector3d metres = file.units().metres();
  return {header.minimum.cwiseProduct(metres), header.maximum.cwiseProduct(metres)};
}

void LasStatistics::add(const std::byte* records, std::size_t count, std::size_t record_length,
                        const LasRecordLayout& layout) {
  points += count;
  box.add(records, count, record_length);
  const unsigned mask = layout.extended ? 15U : 7U;
  const unsigned last = layout.extended ? 15U : 5U;  // legacy headers count five returns
  for (std::size_t i = 0; i < count; ++i) {
    const unsigned number = std::to_integer<unsigned>(records[i * record_length + 14]) & mask;
    if (number >= 1 && number <= last) ++by_return[number - 1];
  }
  if (layout.gps_time < 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    const auto time = loadLas<double>(records + i * record_length + layout.gps_time);
    if (time != 0.0 && std::isfinite(time)) times.add(time);
  }
}

void LasStatistics::store(LasHeader& header) const {
  header.point_count = points;
  header.points_by_return = by_return;
  box.store(header);
  header.earliest_time = times.empty() ? 0.0 : times.first;
  header.latest_time = times.empty() ? 0.0 : times.last;
}

}  // namespace pcl_als::detail
