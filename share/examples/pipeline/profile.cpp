// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// profile X1 Y1 X2 Y2 HALF_WIDTH FILE…: the points within HALF_WIDTH (m) of the line from (X1, Y1)
// to (X2, Y2), as lines "distance along it, height" for a plot; files are parted by two empty
// lines.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <Eigen/Core>

#include <pcl_als/io/point_reader.h>

int main(int argc, char** argv) try {
  if (argc < 7) {
    std::fputs("usage: profile X1 Y1 X2 Y2 HALF_WIDTH FILE...\n", stderr);
    return EXIT_FAILURE;
  }
  const Eigen::Vector2d from(std::atof(argv[1]), std::atof(argv[2]));
  const Eigen::Vector2d to(std::atof(argv[3]), std::atof(argv[4]));
  const double half_width = std::atof(argv[5]), length = (to - from).norm();
  const Eigen::Vector2d along = (to - from) / length;
  for (int i = 6; i < argc; ++i) {
    const auto reader = pcl_als::PointReader::open(argv[i]);
    pcl_als::PointChunk chunk;
    while (reader->read(chunk)) {
      for (std::size_t k = 0; k < chunk.size(); ++k) {
        const Eigen::Vector2d offset = Eigen::Vector2d(chunk.x[k], chunk.y[k]) - from;
        const double distance = along.dot(offset);
        const double aside = along.x() * offset.y() - along.y() * offset.x();
        if (distance >= 0.0 && distance <= length && std::abs(aside) <= half_width)
          std::printf("%.3f %.3f\n", distance, chunk.z[k]);
      }
    }
    std::puts("\n");
  }
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::fprintf(stderr, "profile: %s\n", error.what());
  return EXIT_FAILURE;
}
