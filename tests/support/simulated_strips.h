// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/strip.h>
#include <pcl_als/simulation/simulator.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::test {

/// A simulated strip as a cloud, with the true reflectance of every point.
struct SimulatedStrip {
  Strip<PointLidar> strip;
  std::vector<float> reflectance;
};

/// Strips of a simulated block, relative to the block's origin.
struct SimulatedStrips {
  std::vector<SimulatedStrip> strips;
  std::vector<std::string> names;
  std::shared_ptr<const Trajectory> flight;

  explicit SimulatedStrips(const simulation::SimulationOptions& options) {
    const simulation::Simulator simulator(options);
    flight = std::make_shared<const Trajectory>(simulator.trajectory());
    for (std::size_t i = 0; i < simulator.stripCount(); ++i) {
      SimulatedStrip& made = strips.emplace_back();
      made.strip.frame = LocalFrame::around(options.origin, options.crs);
      made.strip.id = std::to_string(i + 1);
      names.push_back(made.strip.id);
      simulator.simulateStrip(i, 2, [&made](const std::vector<simulation::SimulatedPoint>& part) {
        for (const simulation::SimulatedPoint& p : part) {
          made.strip.cloud->push_back(pointOf(p, made.strip.frame));
          made.reflectance.push_back(p.reflectance);
        }
      });
    }
  }

  static PointLidar pointOf(const simulation::SimulatedPoint& p, const LocalFrame& frame) {
    PointLidar point;
    point.getVector3fMap() = frame.toLocal(p.position);
    point.gps_time = p.time;
    point.intensity = p.intensity;
    point.point_source_id = p.strip;
    point.return_number = p.return_number;
    point.number_of_returns = p.number_of_returns;
    point.classification = p.classification;
    return point;
  }
};

}  // namespace pcl_als::test
