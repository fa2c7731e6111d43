// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/io/point_window.h>

#include "command_line.h"

namespace pcl_als::app {

/// \a count numbers of an option, separated by a character, none beyond \a largest in absolute
/// value; UsageError otherwise.
std::vector<double> numbersOf(const CommandLine& line, const std::string& option, char separator,
                              std::size_t count, double largest);

/// XMIN,YMIN,XMAX,YMAX of an option, metres; UsageError otherwise.
Eigen::AlignedBox2d rectangleOf(const CommandLine& line, const std::string& option);

/// The point files that an option names: a folder with them, or files separated by commas.
std::vector<std::filesystem::path> pointFiles(const CommandLine& line, const std::string& option);

/// Adds -bounds, which it returns, -resolution and -keep_readable. They mean the same in every tool
/// that reads parts of files.
Option& addWindowOptions(CommandLine& line);
/// Their values.
PointWindow windowOf(const CommandLine& line);

}  // namespace pcl_als::app
