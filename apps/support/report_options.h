// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/report/report_origin.h>

#include "command_line.h"

namespace pcl_als::app {

/// Declares -report, with what \a help says the folder is for, and the names of the files that are
/// written there besides report.html and report.md.
void addReportOption(CommandLine& line, const std::string& help, std::vector<std::string> files);
/// Provenance of the report of -report: the tool, its settings, the files that its options read,
/// and the points of -control.
ReportOrigin reportOrigin(const CommandLine& line);

/// Declares -control and -control_units.
void addControlOptions(CommandLine& line);
/// The points of -control; none without it.
std::vector<ControlPoint> controlOf(const CommandLine& line);

}  // namespace pcl_als::app
