// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/point_chunk.h>

namespace pcl_als {

void PointChunk::resize(std::size_t count) {
  for (auto* column : {&x, &y, &z, &gps_time}) column->resize(count);
  for (auto* column : {&intensity, &scan_angle}) column->resize(count);
  point_source_id.resize(count);
  for (auto* column : {&return_number, &number_of_returns, &classification, &flags, &channel})
    column->resize(count);
}

}  // namespace pcl_als
