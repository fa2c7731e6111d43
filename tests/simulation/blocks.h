// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/simulation/simulator.h>

namespace pcl_als::simulation::test {

inline PlannedLine lineAlong(std::uint16_t id, const Eigen::Vector2d& start,
                             const Eigen::Vector2d& end, double height, double density) {
  PlannedLine line;
  line.id = id;
  line.start = start;
  line.end = end;
  line.height = height;
  line.density = density;
  return line;
}

/// One line north over 150 m at 540 m, 59,000 pulses over a suburb; no biases, no noise.
inline SimulationOptions oneLine() {
  SimulationOptions options;
  options.lines = {lineAlong(1, {0.0, -75.0}, {0.0, 75.0}, 540.0, 1.0)};
  options.seed = 5;
  return options;
}

/// The same over a bare horizontal plane, flown vertically.
inline SimulationOptions overPlane() {
  SimulationOptions options = oneLine();
  options.scene.relief = options.scene.buildings = options.scene.trees = 0.0;
  options.vertical = true;
  return options;
}

inline void setBias(SimulationOptions& options, SystemParameter parameter, double value) {
  options.bias[indexOf(parameter)] = value * infoOf(parameter).internal_per_unit;
}

}  // namespace pcl_als::simulation::test
