// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

#include <Eigen/Core>

namespace pcl_als::simulation {

/// One return with its truth. Positions in metres, ground frame.
struct SimulatedPoint {
  Eigen::Vector3d position;  ///< as written: measurements, assumed parameters, written trajectory
  /// The same, with the same random errors, without biases and error sources.
  Eigen::Vector3d unbiased;
  Eigen::Vector3d surface;   ///< position on the surface: no noise, no bias
  double time = 0.0;         ///< GPS seconds of week
  float scan_angle = 0.0F;   ///< degrees from the vertical, right of flight positive (as LAS)
  float reflectance = 0.0F;  ///< truth, 0 … 1
  std::uint16_t intensity = 0;
  std::uint16_t strip = 0;
  std::uint8_t return_number = 1, number_of_returns = 1;
  std::uint8_t classification = 0;  ///< ASPRS: 2 ground, 5 vegetation, 6 building, 11 road
  std::uint8_t flags = 0;           ///< PointFlag: scan direction, edge of flight line
  std::uint8_t channel = 0;         ///< of the scanner
};

}  // namespace pcl_als::simulation
