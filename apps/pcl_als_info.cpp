// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>
#include <iostream>
#include <limits>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/count_text.h>
#include <pcl_als/io/survey_census.h>
#include <pcl_als/report/census_report.h>
#include <pcl_als/survey/strip_arrangement.h>

#include "command_line.h"

namespace pcl_als::app {
namespace {

/// The flight lines that -split finds, with what was left out between them.
std::string linesText(const std::vector<std::string>& paths) {
  std::vector<SurveyedFile> files;
  for (const std::string& path : paths) files.push_back(surveyFile(path));
  const StripArrangement lines(files, {{}, {}, true}, {});
  std::vector<std::uint64_t> counts(lines.labels().size(), 0);
  std::vector<TimeRange> times(lines.names().size());
  PointChunk chunk;
  for (std::size_t file = 0; file < files.size(); ++file) {
    StripArrangement::Sorter sorter(lines, file);
    const auto reader = PointReader::open(files[file].sources.info.path);
    while (reader->read(chunk)) {
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        const std::size_t label = sorter.label(chunk.point_source_id[i], chunk.gps_time[i]);
        ++counts[label];
        const int line = lines.labels()[label].index;
        if (line >= 0) times[static_cast<std::size_t>(line)].add(chunk.gps_time[i]);
      }
    }
  }
  std::string text = "\n" + counted(lines.names().size(), "flight line") + " (-split)\n";
  for (std::size_t label = 0; label < counts.size(); ++label) {
    const int line = lines.labels()[label].index;
    if (line < 0) continue;
    const TimeRange& range = times[static_cast<std::size_t>(line)];
    char row[200];
    std::snprintf(row, sizeof row, "  %-16s %12s points %16.3f … %.3f s\n",
                  lines.labels()[label].strip.c_str(), grouped(counts[label]).c_str(), range.first,
                  range.last);
    text += row;
  }
  for (const std::string& left : describe(lines.leftOut(counts))) text += "  " + left + '\n';
  return text;
}

int info(int argc, char** argv) {
  CommandLine line("pcl_als_info",
                   "lists the contents of point files: strips, times, density, returns, overlaps",
                   "FILE… [-json FILE]", "pcl_als_info strip1.las strip2.las -json survey.json");
  line.add<double>("cell", "cell size for density and overlaps, m; 0: by density", 0.0);
  line.addOptional("json", "also write the facts as JSON");
  line.addFlag("split",
               "also list the flight lines into which -split of the other tools cuts the points");
  if (!line.parse(argc, argv)) return kDone;

  const double cell = line.number("cell", 0.0, 10000.0, "m");
  const auto& inputs = line.inputs(1, std::numeric_limits<std::size_t>::max());
  Step step("Reading " + counted(inputs.size(), "file"), line.quiet());
  const SurveyCensus survey = takeCensus({inputs.begin(), inputs.end()}, cell,
                                         [&](double fraction) { step.progress(fraction); });
  std::uint64_t points = 0;
  for (const FileCensus& file : survey.files) points += file.statistics.points;
  step.done(grouped(points) + " points");
  if (!line.quiet()) std::cout << '\n' << censusText(survey);
  if (line.has("split") && !line.quiet()) std::cout << linesText(inputs);
  if (line.has("json")) {
    writeFile(line.text("json"), censusJson(survey));
  }
  return kDone;
}

}  // namespace
}  // namespace pcl_als::app

int main(int argc, char** argv) {
  return pcl_als::app::run("pcl_als_info", [&] { return pcl_als::app::info(argc, argv); });
}
