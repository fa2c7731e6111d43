// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/processing/file_motion.h>
#include <pcl_als/processing/strip_positions.h>
#include <pcl_als/registration/patch_alignment.h>
#include <pcl_als/report/alignment_report.h>
#include <pcl_als/survey/arranged_files.h>

#include "command_line.h"
#include "strip_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
using Eigen::AlignedBox2d;

CommandLine commandLine() {
  CommandLine line("pcl_als_icpatch",
                   "estimates the rigid motion of one strip onto another from points and TIN "
                   "patches (ICPatch; Habib et al. 2011, section 2.3).",
                   "SOURCE TARGET -output result.json [options], or FILE… -pair A:B …",
                   "pcl_als_icpatch strip1.las strip2.las -output result.json -transformed "
                   "moved1.las");
  const PatchAlignmentSettings defaults;
  line.addOptional("output", "result as JSON (needed)");
  line.addOptional("transformed",
                   "the source moved onto the target: .las, .laz or .pcd like SOURCE");
  line.addOptional("pair", "A:B: strip A of the files onto strip B of the files");
  app::addStripOptions(line);
  line.addFlag("scale", "also estimate a scale");
  line.add("search_distance", "largest distance of the surfaces at the start, m, 0.1 to 200",
           defaults.search_distance);
  line.add("determined_std",
           "parameters with a larger standard deviation are reported as not determined, m at the "
           "radius of the overlap",
           defaults.determined_std);
  line.add("points",
           "approximate number of points of each strip that are triangulated, at least 1000",
           static_cast<double>(defaults.points));
  line.add("pairs", "approximate number of candidate points in each direction, at least 1000",
           static_cast<double>(defaults.pairs));
  line.add("iterations", "largest number of iterations of the last stage",
           defaults.maximum_iterations);
  return line;
}

/// The strips to align, and the arrangement that they refer to, if any.
struct Request {
  std::unique_ptr<ArrangedFiles> arranged;
  ArrangedFiles::Use use;
  StripFiles source, target;
};

bool isSourceId(const std::string& text) {
  constexpr std::size_t kMostDigits = 5;
  return !text.empty() && text.size() <= kMostDigits &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

/// A number that no strip has is input without the strip; another word is no strip's name.
int indexOf(const ArrangedFiles& arranged, const std::string& strip) {
  const std::vector<std::string>& names = arranged.arrangement().names();
  const bool known = std::find(names.begin(), names.end(), strip) != names.end();
  if (known || !isSourceId(strip)) return static_cast<int>(stripNamed(names, strip, "pair"));
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  throw InputError("option -pair: no point is of strip " + strip + "; there are " + all);
}

StripFiles stripOf(const Request& request, const std::string& strip) {
  const ArrangedFiles& arranged = *request.arranged;
  StripFiles files;
  files.strip = strip;
  files.arrangement = &arranged.arrangement();
  files.index = indexOf(arranged, strip);
  files.box = request.use.boxes[static_cast<std::size_t>(files.index)];
  for (std::size_t file = 0; file < arranged.files().size(); ++file) {
    files.files.push_back(arranged.files()[file].sources.info.path);
    files.places.push_back(file);
  }
  return files;
}

StripFiles fileOf(const Request& request, const std::string& path, std::size_t place) {
  StripFiles files;
  files.files = {path};
  if (request.arranged) files.arrangement = &request.arranged->arrangement();
  files.places = {place};
  return files;
}

Request requestOf(const CommandLine& line) {
  if (line.has("pair") && line.has("transformed"))
    throw UsageError("option -transformed: needs SOURCE and TARGET as files, not -pair");
  const std::string pair = line.has("pair") ? line.text("pair") : "";
  const std::size_t colon = pair.find(':');
  if (line.has("pair") && (colon == std::string::npos || colon == 0 || colon + 1 == pair.size()))
    throw UsageError("option -pair: '" + pair + "' is not A:B");
  const auto& inputs = line.has("pair") ? line.inputs(1, 100000) : line.inputs(2, 2);
  Request request;
  if (line.has("pair") || app::choosesStrips(line)) {
    StripChoice choice = app::stripChoice(line);
    choice.keep_timeless = true;  // nothing here needs times
    request.arranged = std::make_unique<ArrangedFiles>(
        std::vector<std::filesystem::path>(inputs.begin(), inputs.end()), choice);
    request.use = request.arranged->use();
  }
  if (line.has("pair")) {
    request.source = stripOf(request, pair.substr(0, colon));
    request.target = stripOf(request, pair.substr(colon + 1));
  } else {
    request.source = fileOf(request, inputs[0], 0);
    request.target = fileOf(request, inputs[1], 1);
  }
  return request;
}

PatchAlignmentSettings settingsOf(const CommandLine& line) {
  PatchAlignmentSettings settings;
  settings.search_distance = line.number("search_distance", 0.1, 200.0, "m");
  settings.determined_std = line.number("determined_std", 1e-4, 100.0, "m");
  settings.points = static_cast<std::size_t>(line.number("points", 1e3, 1e8, "points"));
  settings.pairs = static_cast<std::size_t>(line.number("pairs", 1e3, 1e8, "pairs"));
  settings.maximum_iterations = line.get<int>("iterations");
  if (settings.maximum_iterations < 1 || settings.maximum_iterations > 1000)
    throw UsageError("option -iterations: must be 1 to 1000");
  settings.estimate_scale = line.has("scale");
  settings.threads = line.threads();
  return settings;
}

std::string boxText(const Eigen::AlignedBox3d& box) {
  char text[120];
  std::snprintf(text, sizeof text, "x %.1f to %.1f, y %.1f to %.1f", box.min().x(), box.max().x(),
                box.min().y(), box.max().y());
  return text;
}

/// The box in plan that both strips have points in, with what they may be apart.
AlignedBox2d commonBox(const Request& request, const StripFileInfo& source,
                       const StripFileInfo& target, double reach) {
  const auto wide = [reach](const Eigen::AlignedBox3d& box) {
    return AlignedBox2d(box.min().head<2>().array() - reach, box.max().head<2>().array() + reach);
  };
  AlignedBox2d common;
  if (!source.box.isEmpty() && !target.box.isEmpty())
    common = wide(source.box).intersection(wide(target.box));
  if (common.isEmpty())
    throw InputError(request.source.name() + " and " + request.target.name() +
                     " do not overlap: " + boxText(source.box) + " and " + boxText(target.box));
  return common;
}

/// The reason for which a result is not reliable, in one line.
std::string whyNot(const PatchAlignmentResult& result) {
  if (!result.hasConverged()) return result.message;
  std::string why;
  for (int p = 0; p < PatchAlignmentResult::kParameters; ++p) {
    if (result.parameters[p].determined) continue;
    why += (why.empty() ? "" : "; ") + std::string(PatchAlignmentResult::name(p)) +
           " is not determined (" + result.parameters[p].reason + ")";
  }
  return why;
}

int icpatch(int argc, char** argv) {
  CommandLine line = commandLine();
  if (!line.parse(argc, argv)) return app::kDone;
  const Request request = requestOf(line);
  PatchAlignmentSettings settings = settingsOf(line);
  if (!line.has("output")) throw UsageError("option -output is needed");
  if (line.has("transformed")) checkMovable(request.source.files.front(), line.text("transformed"));

  Step reading("Reading " + request.source.name() + " and " + request.target.name(), line.quiet());
  const StripFileInfo source_info = stripFileInfo(request.source);
  const StripFileInfo target_info = stripFileInfo(request.target);
  std::vector<PointFileInfo> files = source_info.files;
  files.insert(files.end(), target_info.files.begin(), target_info.files.end());
  const PointReference reference = commonReference(files);
  const AlignedBox2d box =
      commonBox(request, source_info, target_info, settings.search_distance + 10.0);
  settings.resolution = std::min(source_info.resolution, target_info.resolution);
  Eigen::Vector3d origin;
  origin << box.center(), target_info.box.center().z();
  origin = origin.array().round();
  const StripPoints source = readStripPoints(request.source, box, origin);
  const StripPoints target = readStripPoints(request.target, box, origin);
  reading.done(grouped(source.positions.size()) + " and " + grouped(target.positions.size()) +
               " points in common reach");
  app::remarks(line, reference.remarks);
  app::remarks(line, describe(request.use.left_out));

  Step aligning("Aligning", line.quiet());
  const PatchAlignmentResult result = alignPatches(source.view(), target.view(), settings);
  aligning.done(grouped(result.pairs) + " pairs, " + std::to_string(result.iterations) +
                " iterations");
  if (result.status == PatchAlignmentResult::Status::no_overlap)
    throw InputError(request.source.name() + " and " + request.target.name() + ": " +
                     result.message);
  writeAlignment(line.text("output"), result,
                 {request.source.name(), request.target.name(), source.positions.size(),
                  target.positions.size(), request.use.left_out});
  if (!line.quiet()) std::cout << '\n' << alignmentTable(result) << std::endl;
  if (result.hasConverged() && line.has("transformed")) {
    Step writing("Writing " + line.text("transformed"), line.quiet());
    const auto moved = movePointFile(request.source.files.front(), line.text("transformed"),
                                     result.motion, line.threads());
    writing.done(grouped(moved) + " points");
  }
  if (result.hasConverged() && result.allDetermined()) return app::kDone;
  std::cerr << "pcl_als_icpatch: no reliable answer: " << whyNot(result) << std::endl;
  return app::kNoReliableAnswer;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_icpatch", [argc, argv] { return icpatch(argc, argv); });
}
