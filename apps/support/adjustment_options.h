// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/calibration_result.h>

#include "command_line.h"

namespace pcl_als::app {

/// Assumptions of an adjustment about errors, for measured or planned data:
/// -range_noise, -angle_noise, -beam_divergence, -position_sigma, -roll_pitch_sigma,
/// -heading_sigma, -control_sigma.
void addErrorOptions(CommandLine& line);
NoiseModel noiseOf(const CommandLine& line);
SharedErrorModel sharedErrorsOf(const CommandLine& line);

/// -estimate: names separated by commas, or auto (an empty list). \a subject determines them.
void addEstimateOption(CommandLine& line, const std::string& subject);
std::vector<SystemParameter> parametersToEstimate(const CommandLine& line);

/// Adds -systems, -own, -fixed and -fixed_sigma, which readSystems() takes into the settings.
void addSystemOptions(CommandLine& line);
void readSystems(const CommandLine& line, CalibrationSettings& settings);

}  // namespace pcl_als::app
