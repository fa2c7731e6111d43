// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/report/picture/result_file_plots.h>

#include "command_line.h"
#include "picture_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
namespace fs = std::filesystem;

/// "png" of ".png"
std::vector<std::string> formats() {
  std::vector<std::string> names;
  for (const std::string& ending : app::pictureEndings()) names.push_back(ending.substr(1));
  return names;
}

const std::string& endingOf(const CommandLine& line) {
  return app::pictureEndings()[line.choice("format")];
}

/// The pictures that are asked for. Of a plot that several files hold, all but the first have the
/// name of their file before it: they are checked when the files are read.
std::optional<std::vector<std::string>> pictures(const CommandLine& line) {
  std::vector<std::string> names{"parameters",
                                 "correlation",
                                 "pairs",
                                 "convergence",
                                 "residuals",
                                 "strip_errors",
                                 "heights",
                                 "offset_against_distance",
                                 "offset_against_time",
                                 "offset_against_scan_angle",
                                 "variance_to_mean",
                                 "histograms",
                                 "strip_gains",
                                 "pulse",
                                 "waveforms",
                                 "confusion"};
  if (line.has("plots")) names = splitList(line.text("plots"));
  for (std::string& name : names) name += endingOf(line);
  return names;
}

CommandLine commandLine() {
  CommandLine line("pcl_als_plot",
                   "draws result files (JSON) as plots: parameters, correlations, residuals, "
                   "convergence, offsets, variance-to-mean, confusion matrices, waveforms",
                   "RESULT.json... -output FOLDER [-plots NAME,...] [-format svg]",
                   "pcl_als_plot calibration.json -output plots -plots parameters,correlation");
  line.setArguments({{"", 1, 1000}});
  line.addOutputFolder("output", "folder for a file NAME.png of every plot", pictures).needed();
  line.addText("plots",
               "only these, e.g. parameters,residuals (default: all that the files "
               "hold)")
      .in(app::Group::output);
  line.addChoice("format", "of the files: png, svg or pdf", formats(), "png")
      .in(app::Group::output);
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
  const auto& files = line.inputs();
  const PictureSize size = app::sizeOf(line);
  std::vector<NamedPlot> plots = plotsOfAll({files.begin(), files.end()});
  if (line.has("plots")) {
    const std::vector<std::string> names = splitList(line.text("plots"));
    if (names.empty()) throw UsageError("option -plots: names no plot");
    plots = plotsNamed(plots, names);
  }
  std::vector<fs::path> outputs;
  for (const NamedPlot& each : plots)
    outputs.push_back(fs::path(line.text("output")) / (each.name + endingOf(line)));
  refuseForeign(outputs);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const NamedPlot& each = plots[i];
    const fs::path& output = outputs[i];
    Step step("Drawing " + output.string(), line.quiet());
    drawn(each, size).write(output);
    step.done(std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels");
  }
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, plot);
}
