// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <iostream>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/processing/line_extraction.h>

#include "command_line.h"
#include "strip_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;

CommandLine commandLine() {
  const LineExtractionOptions defaults;
  CommandLine line("pcl_als_lines",
                   "finds straight roof lines (ridges, valleys, eaves) of strips with their "
                   "covariance.",
                   "STRIP... -output lines.csv|.geojson",
                   "pcl_als_lines strip*.las -output lines.csv");
  line.setArguments({{"", 1, app::Arguments::kAnyNumber}});
  line.addOutputFile("output", "lines to write", {".csv", ".geojson"}).needed();
  app::addStripOptions(line);
  line.addFlag("eaves", "also the lower edges of roof faces (known to the spacing of the points)");
  line.addNumber("length", "least length of a line", defaults.settings.least_length,
                 {0.5, 100.0, "m"});
  line.addNumber("area", "least area of a roof face", defaults.settings.least_area,
                 {0.5, 10000.0, "m2"});
  line.addNumber("angle", "least angle between the faces of a line",
                 std::round(defaults.settings.least_angle / kRadiansPerDegree),
                 {3.0, 90.0, "degrees"});
  line.addNumber("point_noise", "standard deviation of points about a roof; 0: from the points",
                 defaults.settings.noise, {0.0, 1.0, "m"})
      .formerly("noise")
      .in(app::Group::priors);
  line.addNumber("same_distance", "lines of different strips closer than this are the same",
                 defaults.same_distance, {0.05, 20.0, "m"});
  line.addNumber("strip_sigma",
                 "standard deviation of the errors of a strip where fewer than ten lines are seen "
                 "in several strips, from whose differences it is estimated otherwise",
                 defaults.assumed.plan, {0.0, 10.0, "m"})
      .in(app::Group::priors);
  return line;
}

LineExtractionOptions optionsOf(const CommandLine& line) {
  LineExtractionOptions options;
  options.settings.eaves = line.has("eaves");
  options.settings.least_length = line.number("length");
  options.settings.least_area = line.number("area");
  options.settings.least_angle = line.number("angle") * kRadiansPerDegree;
  options.settings.noise = line.number("point_noise");
  options.settings.threads = line.threads();
  options.same_distance = line.number("same_distance");
  options.assumed.plan = options.assumed.height = line.number("strip_sigma");
  options.strips = app::stripChoice(line);
  return options;
}

int lines(const CommandLine& line) {
  const auto& inputs = line.inputs();
  const LineExtractionOptions options = optionsOf(line);
  const std::filesystem::path output = line.text("output");
  const ExtractedLines found =
      extractLines({inputs.begin(), inputs.end()}, options, app::progressOf(line));
  writeLines(output, found.lines, found.crs);
  if (!line.quiet()) std::cout << describe(found) << std::flush;
  return app::conclude(line, found.lines.empty() ? "no roof line was found" : "");
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, lines);
}
