// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// What the examples in the comments of public headers take as given. They are compiled and not run.
#pragma once

#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pcl/registration/icp.h>

#include <pcl_als/io/class_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/trajectory/trajectory.h>

namespace examples {

using pcl_als::Tin;
using Cloud = pcl::PointCloud<pcl_als::PointLidar>;

template <typename... Values>
void use(const Values&... /*values*/) {}

extern const std::shared_ptr<const pcl_als::Trajectory> trajectory, flight;
extern const std::vector<pcl_als::Strip<>> strips;
extern const pcl_als::Strip<> strip, strip1, strip2, a, b;
extern Cloud classified, corrected, echoes, aligned;
extern pcl::Indices common, measurable, steep_view;
extern const pcl_als::Atmosphere weather;
extern const std::vector<pcl_als::TrainingClass> training;
extern const std::shared_ptr<const pcl_als::MaximumLikelihood> likelihood;
extern const std::shared_ptr<const pcl_als::Raster> raster;
extern const pcl_als::RasterGrid grid;
extern const pcl_als::SurfaceOptions options;
extern const std::vector<pcl_als::SurfaceReturn> returns;
extern const std::vector<Eigen::Vector3d> positions, points;
extern const std::vector<double> heights;
extern const Eigen::Vector3d minimum, maximum;
extern const pcl_als::PointColoring coloring;
extern const pcl_als::CurvePlot plot;
extern const pcl_als::CurvePlot::Series series;
extern const std::vector<std::vector<std::string>> rows;
extern const Eigen::AlignedBox2d tile_with_margin;
extern const double time, x, y;

}  // namespace examples
