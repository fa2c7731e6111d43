// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/report/intensity_report.h>

#include "command_line.h"

namespace pcl_als::app {

/// Declares -no_atmosphere, the weather and -attenuation. \return the names of the options
std::vector<std::string> addAtmosphereOptions(CommandLine& line);

/// UsageError naming the option for values out of range.
ExtinctionChoice extinctionChoice(const CommandLine& line);

}  // namespace pcl_als::app
