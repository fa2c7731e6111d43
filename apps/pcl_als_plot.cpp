// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <filesystem>
#include <set>

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
  line.addOptional("output", "folder for NAME.png of every plot (needed)");
  line.addOptional("plots",
                   "only these, e.g. parameters,residuals (default: all that the files "
                   "hold)");
  app::addSizeOption(line);
  return line;
}

/// Plots to draw, named apart where several files have the same.
std::vector<NamedPlot> chosenPlots(const CommandLine& line, const std::vector<std::string>& files) {
  std::vector<NamedPlot> plots;
  std::set<std::string> names;
  for (const std::string& file : files) {
    for (NamedPlot& plot : plotsOf(file)) {
      const std::string own = fs::path(file).stem().string() + "_" + plot.name;
      if (names.count(plot.name) != 0) plot.name = own;
      for (int i = 2; !names.insert(plot.name).second; ++i) plot.name = own + std::to_string(i);
      plot.file = file;
      plots.push_back(std::move(plot));
    }
  }
  if (!line.has("plots")) return plots;
  std::vector<NamedPlot> chosen;
  for (const std::string& name : app::splitList(line.text("plots"))) {
    const auto found = std::find_if(plots.begin(), plots.end(),
                                    [&](const NamedPlot& plot) { return plot.name == name; });
    if (found == plots.end()) {
      std::string all;
      for (const std::string& each : names) all += (all.empty() ? "" : ", ") + each;
      throw UsageError("option -plots: there is no '" + name + "'; the files hold " + all);
    }
    chosen.push_back(*found);
  }
  if (chosen.empty()) throw UsageError("option -plots: names no plot");
  return chosen;
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

int plot(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  const auto& files = line.inputs(1, 1000);
  if (!line.has("output")) throw UsageError("option -output is needed");
  const PictureSize size = app::sizeOf(line);
  const auto plots = chosenPlots(line, files);
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
  return pcl_als::app::run("pcl_als_plot", [argc, argv] { return plot(argc, argv); });
}
