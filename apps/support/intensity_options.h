// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <optional>
#include <string>

#include <pcl_als/radiometry/atmosphere.h>

#include "command_line.h"
#include "intensity_output.h"
#include "intensity_run.h"

namespace pcl_als::app {

/// Where the extinction comes from.
struct ExtinctionChoice {
  std::optional<Atmosphere> air;  ///< empty: given directly, switched off, or of another run
  Extinction parts;               ///< of the air
  double per_km = 0.0;
  std::string remark;  ///< one line for a user
};

/// Declares the options of the model, the air, gains, surfaces, overlaps, targets and output.
void addIntensityOptions(CommandLine& line);

/// UsageError naming the option for values out of range.
ExtinctionChoice extinctionChoice(const CommandLine& line);
IntensitySettings intensitySettings(const CommandLine& line, double extinction_per_km);
IntensityOutput intensityOutput(const CommandLine& line);

/// "NAME=VALUE,…" of an option, values greater than 0.
std::map<std::string, double> valuesByStrip(const CommandLine& line, const char* option);

}  // namespace pcl_als::app
