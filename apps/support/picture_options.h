// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/result_plots.h>

#include "command_line.h"

namespace pcl_als::app {

/// The endings of the pictures that Canvas::write() writes.
const std::vector<std::string>& pictureEndings();

void addSizeOption(CommandLine& line);
/// -size WIDTHxHEIGHT; UsageError unless 200x150 to 16384x16384, 40 million pixels at most.
PictureSize sizeOf(const CommandLine& line);

}  // namespace pcl_als::app
