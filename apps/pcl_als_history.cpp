// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/history/history_files.h>
#include <pcl_als/report/history_report.h>

#include "command_line.h"
#include "flight_options.h"
#include "prior_options.h"
#include "report_options.h"

namespace pcl_als::app {
namespace {

CommandLine commandLine() {
  const HistoryOptions defaults;
  CommandLine line("pcl_als_history",
                   "combines calibrations of one system over missions: constancy, steps and drifts "
                   "of each parameter, the value to use from now on, control charts",
                   "CALIBRATION.json... -output history.json [-missions missions.csv] [options]",
                   "pcl_als_history 2026/*/calibration.json -missions missions.csv -output "
                   "history.json -report history");
  line.setArguments({{"", 1, Arguments::kAnyNumber}});
  line.addOutputFile("output", "history.json to write, a prior for pcl_als_calibrate", {".json"})
      .needed();
  line.addInputFile("missions",
                    "table of the missions, CSV with a header: calibration (name of the file), "
                    "date (2026-05-04), and columns of numbers that biases may depend on, such as "
                    "temperature (default: missions are in the order of the files)");
  line.addText("system_name",
               "name of the instrument whose calibrations are used (default: all have the same "
               "name, or none)")
      .in(Group::inputs);
  line.addText("system", "name of the system, needed for calibrations with several")
      .in(Group::inputs);
  line.addText("change",
               "standard deviations of changes between missions that are known, e.g. "
               "boresight_roll=2,lever_arm_x=0.005 (m, arcsec; default: estimated)")
      .in(Group::priors);
  line.addNumber("level", "level of each test, over the whole history", defaults.level,
                 {1e-6, 0.49, ""});
  addForceOption(line, "a calibration should not be applied by its own verdict");
  addReportOption(line, "folder for report.html with control charts, report.md, tables as CSV",
                  {"parameters.csv", "segments.csv", "missions.csv"});
  return line;
}

/// Standard deviations of changes; NaN for parameters that the text does not name.
SystemVector changesIn(const std::string& text) {
  SystemVector std = HistoryOptions().change_std;
  setChanges(text, std);
  return std;
}

int history(const CommandLine& line) {
  HistoryInput input;
  for (const std::string& file : line.inputs()) input.calibrations.emplace_back(file);
  if (line.has("missions")) input.missions = line.text("missions");
  if (line.has("system_name")) input.system_name = line.text("system_name");
  if (line.has("system")) input.system = line.text("system");
  input.with_unusable = line.has("force");
  HistoryOptions options;
  options.level = line.number("level");
  if (line.has("change")) options.change_std = line.parsed("change", changesIn);
  HistoryMissions missions = readHistoryMissions(input);
  HistoryReport report;
  report.history = calibrationHistory(std::move(missions.missions), options);
  report.instrument = pooledInstrument(report.history, missions.newest);
  report.excluded = std::move(missions.excluded);
  if (!line.quiet()) std::cout << historyText(report);
  writeFile(line.text("output"), historyJson(report));
  if (line.has("report")) {
    ReportOrigin origin = reportOrigin(line);
    for (const std::string& file : line.inputs()) origin.inputs.push_back(file);
    writeHistoryPage(origin, report);
  }
  return kDone;
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, pcl_als::app::commandLine, pcl_als::app::history);
}
