// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/report/report_origin.h>

#include "command_line.h"

namespace pcl_als::app {

/// Provenance of the report of -report: the tool, its settings, the files of \a inputs (names of
/// options) that are given, and the points of -control.
ReportOrigin reportOrigin(const CommandLine& line, const std::vector<const char*>& inputs);

/// Declares -control and -control_units.
void addControlOptions(CommandLine& line);
/// The points of -control; none without it.
std::vector<ControlPoint> controlOf(const CommandLine& line);

}  // namespace pcl_als::app
