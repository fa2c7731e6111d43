// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <utility>
#include <vector>

#include <pcl_als/simulation/scene.h>
#include <pcl_als/simulation/simulation_options.h>
#include <pcl_als/simulation/simulator.h>

namespace pcl_als::simulation {

/// The rectangle that holds every swath, whatever the attitude; whole multiples of 10 m.
std::pair<Eigen::Vector2d, Eigen::Vector2d> sceneRectangle(const SimulationOptions& options);

/// Number of planned swaths over a place, narrowed by a margin (metres).
int swathsOver(const Eigen::Vector2d& place, const SimulationOptions& options, double margin);

/// Level boards above open ground under several swaths.
std::vector<Target> chooseTargets(const Scene& scene, const SimulationOptions& options);

/// Points on the ground, then the surveyed centres of the targets of the scene.
std::vector<ControlPoint> chooseControlPoints(const Scene& scene, const SimulationOptions& options);
std::vector<LandCoverSite> chooseSites(const Scene& scene, const SimulationOptions& options,
                                       int per_class, int set);

}  // namespace pcl_als::simulation
