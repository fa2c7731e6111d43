// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/report/intensity_report.h>

#include "command_line.h"

namespace pcl_als::app {

/// Declares the options of the model, the air, gains, surfaces, overlaps, targets and output.
void addIntensityOptions(CommandLine& line);

/// UsageError naming the option for values out of range.
IntensityOptions intensityOptions(const CommandLine& line, double extinction_per_km);

}  // namespace pcl_als::app
