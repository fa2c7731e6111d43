// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/processing/point_conversion.h>

#include "command_line.h"
#include "strip_options.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

/// The names of the files where OUT is a folder, as the conversion chooses them. Those of strips
/// are known when the points are read: the conversion checks them then.
std::optional<std::vector<std::string>> filesInFolder(const CommandLine& line) {
  if (line.has("split")) {
    requireStripFolder(line.output());
    return std::vector<std::string>();
  }
  if (!isConversionFolder(line.output(), line.inputs().size() != 1)) return std::nullopt;
  std::vector<std::string> names;
  for (const std::string& input : line.inputs())
    names.push_back(convertedName(input, line.has("format") ? line.text("format") : ""));
  return names;
}

void addFormatOptions(CommandLine& line) {
  const app::OptionGroup group(line, app::Group::output);
  line.addChoice("las_version",
                 "version of the LAS and LAZ files, which are written as a whole (default: that of "
                 "the input, 1.4 from others); 1.5 has point formats 6 to 10 and its CRS as WKT",
                 {"1.4", "1.5"});
  line.addWhole("time_offset",
                "of LAS 1.5: store absolute times less this offset, e.g. 1500 for the years 2023 "
                "to 2031 (default: 1000 as in LAS 1.4)",
                std::nullopt, {0, 65535, "million s"});
  line.makeDependent("time_offset", "las_version");
  line.addChoice("format", "format of the files in an output folder (default: as the input)",
                 {"las", "laz", "pcd", "ply", "xyz"});
  line.addFlag("ascii", "write .ply files as text (default: binary_little_endian)");
}

CommandLine commandLine() {
  CommandLine line(
      "pcl_als_convert",
      "converts point files between .las, .laz, .pcd, .ply and .xyz, or writes parts of "
      "them. LAS to LAZ to LAS gives the same bytes",
      "IN OUT | IN... FOLDER [options]",
      "pcl_als_convert tile.laz part.las -bounds 84900,447500,84950,447600");
  line.setArguments({{"",
                      1,
                      app::Arguments::kAnyNumber,
                      {".las", ".laz", ".pcd", ".ply", ".xyz"},
                      filesInFolder}});
  app::addWindowOptions(line);
  line.addText(
          "columns",
          "columns of .xyz files in their order, e.g. x,y,z,intensity,gps_time; skip: a column "
          "that is not used (default: by their header line)")
      .in(app::Group::inputs);
  app::addStripOptions(line, false);
  line.addFlag(
          "split",
          "write a file for each strip into the output folder; points are divided into flight "
          "lines at gaps in time, changes of course, turns and hovering; points between lines are "
          "excluded")
      .in(app::Group::strips);
  line.addFlag("keep_ids",
               "with -split: points keep their point source ids (default: lines that are not the "
               "only one of their id get numbers of their own)")
      .in(app::Group::output);
  line.makeDependent("keep_ids", "split");
  line.addFlag("number_lines",
               "write the files as they are, but with the number of its flight line as the point "
               "source id of each point (0 between lines): for tiles with wrong ids")
      .in(app::Group::output);
  for (const char* other : {"split", "strips", "without"}) line.exclude({"number_lines", other});
  addFormatOptions(line);
  return line;
}

PointConversionOptions optionsOf(const CommandLine& line) {
  PointConversionOptions options;
  options.window = app::windowOf(line);
  if (line.has("columns")) options.window.columns = splitList(line.text("columns"));
  options.strips = app::stripChoice(line);
  options.keep_ids = line.has("keep_ids");
  options.number_lines = line.has("number_lines");
  if (line.has("las_version")) {
    options.las_version.emplace();
    options.las_version->minor = line.text("las_version") == "1.5" ? 5 : 4;
    if (line.has("time_offset"))
      options.las_version->time_offset = static_cast<std::uint16_t>(line.whole("time_offset"));
  }
  if (line.has("format")) options.format = line.text("format");
  options.ascii_ply = line.has("ascii");
  options.threads = line.threads();
  return options;
}

int convert(const CommandLine& line) {
  const PointConversionOptions options = optionsOf(line);
  const std::vector<std::filesystem::path> inputs(line.inputs().begin(), line.inputs().end());
  const PointConversionResult result =
      convertPointFiles(inputs, line.output(), options, app::progressOf(line));
  if (options.strips.split) {
    for (const PointConversionResult::Output& output : result.outputs)
      app::remark(line, output.path.string() + ": " + grouped(output.points) + " points");
  }
  app::remarks(line, describe(result.excluded));
  app::remarks(line, result.remarks);
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, convert);
}
