// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iostream>
#include <optional>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/processing/file_motion.h>
#include <pcl_als/processing/pair_alignment.h>
#include <pcl_als/report/alignment_report.h>

#include "command_line.h"
#include "strip_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;

CommandLine commandLine() {
  CommandLine line("pcl_als_icpatch",
                   "estimates the rigid motion of one strip onto another from points and TIN "
                   "patches (ICPatch; Habib et al. 2011, section 2.3).",
                   "SOURCE TARGET -output result.json [options], or FILE… -pair A:B …",
                   "pcl_als_icpatch strip1.las strip2.las -output result.json -transformed "
                   "moved1.las");
  const PatchAlignmentSettings defaults;
  line.setArguments({{"pair", 1, app::Arguments::kAnyNumber}, {"", 2, 2}});
  line.addOutputFile("output", "result", {".json"}).needed();
  line.addOutputFile("transformed", "the source moved onto the target, of the kind of SOURCE",
                     {".las", ".laz", ".pcd"});
  line.addText("pair", "A:B: strip A of the files onto strip B of the files")
      .in(app::Group::strips);
  app::addStripOptions(line);
  line.addFlag("estimate_scale", "also estimate a scale")
      .formerly("scale")
      .in(app::Group::estimation);
  line.addNumber("max_distance", "largest distance of the surfaces at the start",
                 defaults.search_distance, {0.1, 200.0, "m"})
      .formerly("search_distance");
  line.addNumber("determined_std",
                 "parameters with a larger standard deviation, at the radius of the overlap, are "
                 "reported as not determined",
                 defaults.determined_std, {1e-4, 100.0, "m"});
  line.addNumber("points_per_strip",
                 "approximate number of points of each strip that are triangulated",
                 static_cast<double>(defaults.points), {1e3, 1e8})
      .formerly("points");
  line.addNumber("candidates", "approximate number of points in each direction that may form pairs",
                 1e-3 * static_cast<double>(defaults.pairs), {1.0, 1e5, "thousands"})
      .formerly("pairs", 1e-3);
  line.addWhole("iterations", "largest number of iterations of the last stage",
                static_cast<std::uint64_t>(defaults.maximum_iterations), {1, 1000, {}});
  line.exclude({"pair", "transformed"});
  return line;
}

AlignmentPair pairOf(const CommandLine& line) {
  const std::vector<std::filesystem::path> files(line.inputs().begin(), line.inputs().end());
  if (line.has("pair")) {
    return namedPair(files, line.parsed("pair", pairIn), app::stripChoice(line), "option -pair");
  }
  return filePair(files,
                  app::choosesStrips(line) ? std::optional(app::stripChoice(line)) : std::nullopt);
}

PatchAlignmentSettings settingsOf(const CommandLine& line) {
  PatchAlignmentSettings settings;
  settings.search_distance = line.number("max_distance");
  settings.determined_std = line.number("determined_std");
  settings.points = static_cast<std::size_t>(line.number("points_per_strip"));
  settings.pairs = static_cast<std::size_t>(std::lround(1e3 * line.number("candidates")));
  settings.maximum_iterations = static_cast<int>(line.whole("iterations"));
  settings.estimate_scale = line.has("estimate_scale");
  settings.threads = line.threads();
  return settings;
}

int icpatch(const CommandLine& line) {
  const AlignmentPair pair = pairOf(line);
  const PatchAlignmentSettings settings = settingsOf(line);
  const std::filesystem::path source = pair.source.files().front().path;
  if (line.has("transformed")) checkMovable(source, line.text("transformed"));
  const PairAlignment alignment = registerPair(pair, settings, app::progressOf(line));
  const PatchAlignmentResult& result = alignment.result;
  writeFile(line.text("output"),
            alignmentJson(result, {pair.source.name, pair.target.name, alignment.source_points,
                                   alignment.target_points, pair.excluded}));
  if (!line.quiet()) std::cout << '\n' << alignmentTable(result) << std::endl;
  if (result.hasConverged() && line.has("transformed")) {
    Step writing("Writing " + line.text("transformed"), line.quiet());
    const auto moved =
        movePointFile(source, line.text("transformed"), result.motion, line.threads());
    writing.done(grouped(moved.points) + " points");
    app::remarks(line, moved.remarks);
  }
  const bool reliable = result.hasConverged() && result.allDetermined();
  return app::conclude(line, reliable ? "" : unreliability(result));
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, icpatch);
}
