// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <limits>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/processing/point_conversion.h>

#include "command_line.h"
#include "strip_options.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

CommandLine commandLine() {
  CommandLine line("pcl_als_convert",
                   "converts point files between .las, .laz and .pcd, or writes parts of them. LAS "
                   "to LAZ to LAS gives the same bytes",
                   "IN OUT | IN... FOLDER [options]",
                   "pcl_als_convert tile.laz part.las -bounds 84900,447500,84950,447600");
  app::addWindowOptions(line);
  app::addStripOptions(line, false);
  line.addFlag(
      "split",
      "write a file for each strip into the output folder; points are divided into flight "
      "lines at gaps in time, changes of course, turns and hovering; points between lines are "
      "left out");
  line.addOptional("format", "las, laz or pcd: files in an output folder (default: as the input)");
  return line;
}

PointConversionOptions optionsOf(const CommandLine& line) {
  PointConversionOptions options;
  options.window = app::windowOf(line);
  options.strips = app::stripChoice(line);
  if (line.has("format")) {
    line.choice("format", {"las", "laz", "pcd"});
    options.format = line.text("format");
  }
  options.threads = line.threads();
  return options;
}

int convert(const CommandLine& line) {
  const std::vector<std::string>& files = line.inputs(2, std::numeric_limits<std::size_t>::max());
  const PointConversionOptions options = optionsOf(line);
  const std::vector<std::filesystem::path> inputs(files.begin(), files.end() - 1);
  const PointConversionResult result =
      convertPointFiles(inputs, files.back(), options, app::progressOf(line));
  if (options.strips.split) {
    for (const PointConversionResult::Output& output : result.outputs)
      app::remark(line, output.path.string() + ": " + grouped(output.points) + " points");
  }
  app::remarks(line, describe(result.left_out));
  app::remarks(line, result.remarks);
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, convert);
}
