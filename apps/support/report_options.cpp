// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "report_options.h"

#include <pcl_als/io/survey_io.h>

namespace pcl_als::app {

void addReportOption(CommandLine& line, const std::string& help, std::vector<std::string> files) {
  files.insert(files.begin(), {"report.html", "report.md"});
  line.addOutputFolder("report", help, always(std::move(files)));
  line.addText("title", "title of the report, e.g. the name of the mission (default: by content)")
      .in(Group::output);
  line.makeDependent("title", "report");
}

ReportOrigin reportOrigin(const CommandLine& line) {
  ReportOrigin origin;
  origin.folder = line.text("report");
  origin.program = line.toolAndVersion();
  for (const auto& [name, value] : line.settings()) origin.settings.emplace_back(name, value);
  for (const auto& file : line.optionInputs()) origin.inputs.push_back(file.string());
  origin.control = controlOf(line);
  if (line.has("title")) origin.title = line.text("title");
  return origin;
}

void addControlOptions(CommandLine& line) {
  line.addInputFile(
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
