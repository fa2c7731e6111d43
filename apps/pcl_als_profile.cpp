// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/drawing/section.h>
#include <pcl_als/drawing/section_search.h>
#include <pcl_als/processing/picture/picture_source.h>
#include <pcl_als/processing/picture/section_files.h>
#include <pcl_als/processing/picture/section_places.h>
#include <pcl_als/processing/picture/survey_picture.h>

#include "command_line.h"
#include "picture_options.h"
#include "strip_options.h"
#include "window_options.h"

namespace {

using namespace pcl_als;
using app::CommandLine;
using app::Step;
namespace fs = std::filesystem;

/// The pictures of -auto, which are written into a folder.
std::optional<std::vector<std::string>> filesInFolder(const CommandLine& line) {
  if (!line.has("auto")) return std::nullopt;
  std::vector<std::string> names;
  for (std::uint64_t i = 1; i <= line.whole("auto"); ++i)
    names.push_back("profile" + std::to_string(i) + ".png");
  return names;
}

CommandLine commandLine() {
  CommandLine line("pcl_als_profile",
                   "draws sections through overlapping strips, points coloured by strip",
                   "FILE... -from X,Y -to X,Y -output PROFILE.png | FILE... -auto N -output FOLDER",
                   "pcl_als_profile block/strip*.las -after corrected -auto 3 -output profiles");
  line.setArguments({{"", 1, app::Arguments::kAnyNumber}});
  line.addText("from", "start of the section: X,Y, m");
  line.addText("to", "end of the section: X,Y, m");
  line.addNumber("width", "width of the section; 0: 2 m, with -auto by the density of the points",
                 0.0, {0.0, 1000.0, "m"});
  line.addWhole("auto",
                "instead of -from and -to: find so many places where a misfit shows best: "
                "gable roofs (two planar faces with a sharp ridge, above the ground around), "
                "other opposite slopes, slopes",
                {}, {1, 100, {}});
  line.exclude({"auto", "from"});
  line.exclude({"auto", "to"});
  line.addInputFile("after",
                    "the corrected strips, drawn below: a folder with files of the same names, or "
                    "files separated by commas",
                    [](const CommandLine& given) { return app::pointFiles(given, "after"); });
  app::addWindowOptions(line);
  app::addStripOptions(line);
  app::Option& output = line.addOutputFile(
      "output", "picture to write, with -auto a folder for profile1.png, …", app::pictureEndings());
  output.needed().files = filesInFolder;
  app::addSizeOption(line);
  line.addText("title", "text above (default: names of the files)").in(app::Group::output);
  return line;
}

std::vector<std::string> filesAfter(const CommandLine& line,
                                    const std::vector<std::string>& before) {
  if (!line.has("after")) return {};
  const std::string text = line.text("after");
  if (!fs::is_directory(text)) return splitList(text);
  std::vector<std::string> files;
  for (const std::string& file : before) {
    files.push_back((fs::path(text) / fs::path(file).filename()).string());
  }
  return files;
}

SectionLine lineOf(const CommandLine& line) {
  if (!line.has("from") || !line.has("to")) {
    throw UsageError("-from X,Y and -to X,Y are needed, or -auto N");
  }
  const std::vector<double> from = app::numbersOf(line, "from", ',', 2, app::kFarthest);
  const std::vector<double> to = app::numbersOf(line, "to", ',', 2, app::kFarthest);
  const double width = line.number("width");
  SectionLine section{{from[0], from[1]}, {to[0], to[1]}, width > 0.0 ? 0.5 * width : 1.0};
  if (section.from == section.to) throw UsageError("options -from and -to: are the same point");
  return section;
}

int profile(const CommandLine& line) {
  const auto& inputs = line.inputs();
  const PictureSize size = app::sizeOf(line);
  const PointWindow window = app::windowOf(line);
  const double width = line.number("width");
  const bool automatic = line.has("auto");
  std::vector<SectionSearch::Place> places(1);
  const std::size_t count = automatic ? line.whole("auto") : 1;
  if (!automatic) places[0].line = lineOf(line);

  Step step("Reading " + counted(inputs.size(), "file"), line.quiet());
  const PictureSource source(inputs, line.has("split"), window);
  const std::vector<bool> chosen = chosenStrips(app::stripChoice(line), source.strips());
  if (automatic) places = findSections(source, chosen, count, width);
  if (places.empty())
    throw InputError("no gable roof or slope that two strips cover: give -from and -to");
  const auto before = collectSections(source, places, source.strips(), chosen);
  std::vector<SectionPoints> after;
  if (line.has("after")) {
    after = collectSections(PictureSource(filesAfter(line, inputs), line.has("split"), window),
                            places, source.strips(), chosen);
  }
  step.done(grouped(source.pointCount()) + " points");
  app::remarks(line, source.remarks());
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (before[i].seen() == 0) {
      throw InputError("no point lies in the section; the files cover " +
                       extentText(source.minimum(), source.maximum()));
    }
    SectionPicture picture;
    picture.setTitle(line.has("title") ? line.text("title") : fileNames(inputs));
    picture.setStrips(source.strips());
    picture.addPanel(after.empty() ? "" : "Before", before[i]);
    if (!after.empty()) picture.addPanel("After", after[i]);
    const fs::path output =
        automatic ? fs::path(line.text("output")) / ("profile" + std::to_string(i + 1) + ".png")
                  : fs::path(line.text("output"));
    Step drawing("Drawing " + output.string(), line.quiet());
    picture.draw(size).write(output);
    drawing.done(automatic ? describe(places[i]) : grouped(before[i].seen()) + " points");
  }
  return app::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  return pcl_als::app::run(argc, argv, commandLine, profile);
}
