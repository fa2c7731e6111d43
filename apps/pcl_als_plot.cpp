// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>

#include <pcl_als/common/errors.h>
#include <pcl_als/report/picture/result_file_plots.h>

#include "command_line.h"
#include "output_check.h"
#include "picture_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
namespace fs = std::filesystem;

CommandLine commandLine() {
  CommandLine line("pcl_als_plot",
                   "draws result files (JSON) as plots: parameters, correlations, residuals, "
                   "convergence, offsets, variance-to-mean, confusion matrices",
                   "RESULT.json... -output FOLDER [-plots NAME,...]",
                   "pcl_als_plot calibration.json -output plots -plots parameters,correlation");
  line.addNeeded("output", "folder for NAME.png of every plot");
  line.addOptional("plots",
                   "only these, e.g. parameters,residuals (default: all that the files "
                   "hold)");
  app::addSizeOption(line);
  return line;
}

/// A plot that is impossible in any size has a file to blame, not an option.
Canvas drawn(const NamedPlot& plot, PictureSize size) {
  try {
    return plot.draw(size);
  } catch (const UsageError& error) {
    try {
      plot.draw({});
    } catch (const UsageError&) {
      throw InputError(plot.file + ": " + error.what());
    }
    throw;
  }
}

int plot(const CommandLine& line) {
  const auto& files = line.inputs(1, 1000);
  const PictureSize size = app::sizeOf(line);
  std::vector<NamedPlot> plots = plotsOfAll({files.begin(), files.end()});
  if (line.has("plots")) {
    const std::vector<std::string> names = splitList(line.text("plots"));
    if (names.empty()) throw UsageError("option -plots: names no plot");
    plots = plotsNamed(plots, names);
  }
  app::makeOutputFolder("output", line.text("output"));
  for (const NamedPlot& each : plots) {
    const fs::path output = fs::path(line.text("output")) / (each.name + ".png");
    Step step("Drawing " + output.string(), line.quiet());
    writePng(output, drawn(each, size).image());
    step.done(std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels");
  }
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, plot);
}
