// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "report_options.h"

#include <pcl_als/io/survey_io.h>

namespace pcl_als::app {

ReportOrigin reportOrigin(const CommandLine& line, const std::vector<const char*>& inputs) {
  ReportOrigin origin;
  origin.folder = line.text("report");
  origin.program = line.toolAndVersion();
  for (const auto& [name, value] : line.settings()) origin.settings.emplace_back(name, value);
  for (const char* option : inputs) {
    if (!line.has(option)) continue;
    origin.inputs.push_back(line.text(option));
    if (std::string(option) == "control") origin.control = controlOf(line);
  }
  return origin;
}

void addControlOptions(CommandLine& line) {
  line.addOptional(
      "control",
      "control points: CSV id,x,y,z[,sigma], used vertically; a calibration uses planar "
      "patches, rows with nx,ny,nz[,extent], along their normals, and circular targets, rows with "
      "diameter[,sigma_plan], in three dimensions");
  addUnitsOption(line, "control", "the control file");
}

std::vector<ControlPoint> controlOf(const CommandLine& line) {
  if (!line.has("control")) return {};
  return readControl(line.text("control"), unitOption(line, "control"));
}

}  // namespace pcl_als::app
