// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// las_to_copc IN.las OUT.copc.laz: the points of a file of point format 6, as a COPC file without
// the extra bytes.
#include <algorithm>
#include <cstring>
#include <iostream>

#include <pcl_als/las/las_file.h>

#include "copc_bytes.h"

int main(int argc, char** argv) {
  using pcl_als::test::CopcBytes;
  if (argc != 3) return 1;
  const pcl_als::LasFile file(argv[1]);
  const pcl_als::LasHeader& header = file.header();
  if (header.point_format != 6) {
    std::cerr << argv[1] << ": is not of point format 6\n";
    return 1;
  }
  const std::size_t length = header.record_length;
  std::string records(header.point_count * length, '\0');
  file.readRecords(0, header.point_count, reinterpret_cast<std::byte*>(records.data()));
  std::vector<CopcBytes::Point> points(header.point_count);
  std::array<std::int32_t, 3> low{INT32_MAX, INT32_MAX, INT32_MAX}, high{0, 0, 0}, at{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(at.data(), &records[length * i], sizeof at);
    for (std::size_t axis = 0; axis < 3; ++axis) low[axis] = std::min(low[axis], at[axis]);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::memcpy(at.data(), &records[length * i], sizeof at);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] -= low[axis];
      high[axis] = std::max(high[axis], at[axis]);
    }
    std::memcpy(&records[length * i], at.data(), sizeof at);
    points[i] = {at[0], at[1], at[2], records.substr(length * i, 30)};
  }
  CopcBytes::Frame frame;
  frame.step = header.scale.x();
  for (int axis = 0; axis < 3; ++axis)
    frame.offset[axis] = header.offset[axis] + low[static_cast<std::size_t>(axis)] * frame.step;
  while (frame.side <= *std::max_element(high.begin(), high.end())) frame.side *= 2;
  pcl_als::test::writeBytes(argv[2], CopcBytes(points, frame).str());
  return 0;
}
