// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>
#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/processing/line_extraction.h>
#include <pcl_als/processing/strip_positions.h>

namespace pcl_als {
namespace {

std::vector<Eigen::Vector3d> positionsOf(const StripPoints& points) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(points.positions.size());
  for (const Eigen::Vector3f& p : points.positions) positions.emplace_back(p.cast<double>());
  return positions;
}

}  // namespace

ExtractedLines extractLines(const std::vector<std::filesystem::path>& files,
                            const LineExtractionOptions& options,
                            const ProgressCallback& callback) {
  options.settings.check();
  const UnchangedInputs unchanged;
  ProgressReport progress(callback);
  progress.begin("Reading " + counted(files.size(), "point file"));
  StripChoice choice = options.strips;
  choice.keep_timeless = true;  // nothing here needs times
  const auto survey = std::make_shared<SurveyReader>(SurveyReader::ofFiles(files));
  survey->choose(choice, {});
  const SurveyReader::Contents contents = survey->measure();
  const std::vector<std::string>& names = survey->strips();
  std::vector<PointFileInfo> infos;
  for (const SurveyedFile& file : survey->files()) infos.push_back(file.sources.info);
  const PointReference reference = commonReference(infos);
  progress.end(grouped(contents.pointCount()) + " points of " + counted(names.size(), "strip"));
  for (const std::string& text : reference.remarks) progress.remark(text);
  for (const std::string& text : describe(contents.excluded)) progress.remark(text);

  ExtractedLines result;
  result.crs = reference.crs;
  const Eigen::AlignedBox3d box = contents.box();
  const Eigen::Vector3d origin = box.center().array().round();
  const Eigen::AlignedBox2d everywhere(box.min().head<2>().array() - 1.0,
                                       box.max().head<2>().array() + 1.0);
  std::vector<std::vector<StripLine>> lines;
  for (std::size_t s = 0; s < names.size(); ++s) {
    progress.begin("Finding lines of strip " + names[s]);
    const StripPoints points = readStripPoints(
        StripPart::ofStrip(survey, static_cast<int>(s), contents.boxes[s]), everywhere, origin);
    lines.push_back(findRoofLines(positionsOf(points), options.settings));
    result.strips.push_back({names[s], points.positions.size(), lines.back().size()});
    progress.end(counted(lines.back().size(), "line"));
  }
  progress.begin("Combining lines");
  result.lines = combineLines(lines, names, options.same_distance, options.assumed, &result.errors);
  for (ObjectLine& line : result.lines) {
    line.start += origin;
    line.end += origin;
  }
  progress.end(counted(result.lines.size(), "line"));
  return result;
}

std::string describe(const ExtractedLines& found) {
  std::map<std::string, std::size_t> kinds;
  std::map<std::size_t, std::size_t> seen;
  for (const ObjectLine& line : found.lines) {
    ++kinds[nameOf(line.kind)];
    ++seen[line.strips.size()];
  }
  std::string text = "  kind     lines\n";
  char line[160];
  for (const auto& [kind, count] : kinds) {
    std::snprintf(line, sizeof line, "  %-8s %5zu\n", kind.c_str(), count);
    text += line;
  }
  for (const auto& [strips, count] : seen) {
    std::snprintf(line, sizeof line, "  seen in %s: %zu\n", counted(strips, "strip").c_str(),
                  count);
    text += line;
  }
  std::snprintf(
      line, sizeof line,
      "  errors of strips at lines (standard deviation): %.3f m in plan, %.3f m in height, "
      "from %s\n",
      found.errors.plan, found.errors.height,
      counted(found.errors.differences, "difference").c_str());
  return text + line;
}

}  // namespace pcl_als
