// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>

#include <pcl_als/simulation/image_flight.h>
#include <pcl_als/simulation/simulator.h>

namespace pcl_als {

/// Image flight over the block of a simulation: exact coordinates where the block has no noise,
/// and for a drone's block a lower flight.
simulation::ImageFlightOptions imageFlightOver(const simulation::SimulationOptions& options);

/** \brief Writes the images of a block: camera.json, images.csv (approximate orientations),
 * measurements.csv, checkpoints.csv, and the truth as true_images.csv, true_points.csv and
 * true_lines.csv. Returns their counts as text.
 */
std::string writeImageFiles(const simulation::SimulatedImages& images,
                            const std::filesystem::path& folder);

}  // namespace pcl_als
