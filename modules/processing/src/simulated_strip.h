// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/las/las_writer.h>
#include <pcl_als/processing/simulated_survey.h>

namespace pcl_als::detail {

/// Seconds that are added to the times of a simulation.
double timeShiftOf(const StripFileOptions& files);

/// LAS 1.4, point format 6, with the extra bytes of simulated points.
LasWriterOptions stripFormat(const simulation::SimulationOptions& options, std::uint16_t strip,
                             const StripFileOptions& files);

/// Fields of points. The scanner channel of the point formats has room for four; more are stored in
/// the user data. \param few_channels there are four or fewer
void fillChunk(const std::vector<simulation::SimulatedPoint>& points, double time_shift,
               bool few_channels, PointChunk& chunk);

/// The extra bytes, in the order of stripFormat().
std::vector<std::vector<double>> stripColumns(const std::vector<simulation::SimulatedPoint>& points,
                                              const StripFileOptions& files);

}  // namespace pcl_als::detail
