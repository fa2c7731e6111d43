// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/point_classes.h>

namespace pcl_als {
namespace {

constexpr int kTile = 512;  ///< cells: part of the raster that is read for neighbouring points

/// Bands that come from the cells; a point has its own height and intensity.
std::vector<std::string> bandsOfCells(const GaussianModel& model) {
  std::vector<std::string> bands;
  for (const std::string& band : model.bands) {
    if (band == "surface" || band == "intensity") continue;
    const std::string source = band == "height" ? "terrain" : band;
    if (std::find(bands.begin(), bands.end(), source) == bands.end()) bands.push_back(source);
  }
  return bands;
}

std::vector<std::uint8_t> codesOf(const GaussianModel& model) {
  std::vector<std::uint8_t> codes;
  for (const GaussianClass& c : model.classes) codes.push_back(asprsCodeOf(c.name));
  return codes;
}

/// By point, the code that it gets; empty: it keeps its own.
std::vector<std::optional<std::uint8_t>> newCodes(const PointChunk& points, PointClasses& classes,
                                                  const SurveyReader& survey, std::size_t place) {
  const std::vector<std::uint8_t> codes = codesOf(classes.model());
  const std::vector<int> found = classes.classify(points);
  std::vector<std::optional<std::uint8_t>> given(points.size());
  for (std::size_t from = 0; from < points.size();) {
    const SurveyReader::Run run = survey.runAt(place, points, from);
    from = run.to;
    for (std::size_t i = run.from; run.strip >= 0 && i < run.to; ++i)
      if (found[i] != MaximumLikelihood::kNoClass && !isNoise(points.classification[i]))
        given[i] = codes[static_cast<std::size_t>(found[i])];
  }
  return given;
}

PointClassCounts classifyPcd(const std::filesystem::path& input,
                             const std::filesystem::path& output, PointClasses& classes,
                             const SurveyReader& survey, std::size_t place) {
  PcdFindings findings;
  const Strip<PointLidar> strip = loadPcd(input, {}, findings);
  PointChunk points;
  points.resize(strip.cloud->size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const PointLidar& point = (*strip.cloud)[i];
    const Eigen::Vector3d at = strip.frame.toGround({point.x, point.y, point.z});
    points.x[i] = at.x(), points.y[i] = at.y(), points.z[i] = at.z();
    points.intensity[i] = point.intensity;
    points.classification[i] = point.classification;
    points.point_source_id[i] = point.point_source_id;
    points.gps_time[i] = secondsOfTime(point.gps_time);
  }
  const auto given = newCodes(points, classes, survey, place);
  PointClassCounts counts{points.size(), 0, findings.remarks};
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i])
      (*strip.cloud)[i].classification = *given[i];
    else
      ++counts.unclassified;
  }
  savePcd(output, strip);
  return counts;
}

/// Changes the class of records; returns how many keep theirs.
std::uint64_t classifyRecords(const LasFile& file, const LasRecordBlock& block,
                              PointClasses& classes, const SurveyReader& survey,
                              std::size_t place) {
  const LasScaling metres = file.toMetres();
  PointChunk points;
  decodeLasRecords(block.records, block.count, block.record_length, file.layout(), metres.scale,
                   metres.offset, points);
  const auto given = newCodes(points, classes, survey, place);
  std::uint64_t missed = 0;
  for (std::size_t i = 0; i < block.count; ++i) {
    if (given[i])
      file.layout().storeClass(*given[i], block.records + i * block.record_length);
    else
      ++missed;
  }
  return missed;
}

}  // namespace

/// Points of one tile of the raster and the cells that they lie in.
struct PointClasses::Group {
  struct Member {
    std::size_t point;
    int column, row;
  };
  std::vector<Member> members;
  int west, north, east, south;  ///< columns and rows, inclusive
};

PointClasses::PointClasses(std::shared_ptr<const MaximumLikelihood> classifier,
                           const std::filesystem::path& raster)
    : classifier_(std::move(classifier)), bands_(raster, bandsOfCells(classifier_->model())) {}

std::vector<int> PointClasses::classify(const PointChunk& points) {
  const RasterGrid& grid = bands_.grid();
  std::map<std::pair<int, int>, Group> groups;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const long long column = grid.columnOf(points.x[i]), row = grid.rowOf(points.y[i]);
    if (!grid.holds(column, row)) continue;
    const int c = static_cast<int>(column), r = static_cast<int>(row);
    Group& group = groups.try_emplace({r / kTile, c / kTile}, Group{{}, c, r, c, r}).first->second;
    group.members.push_back({i, c, r});
    group.west = std::min(group.west, c), group.east = std::max(group.east, c);
    group.north = std::min(group.north, r), group.south = std::max(group.south, r);
  }
  std::vector<int> classes(points.size(), MaximumLikelihood::kNoClass);
  for (const auto& entry : groups) classify(points, entry.second, classes);
  return classes;
}

void PointClasses::classify(const PointChunk& points, const Group& group,
                            std::vector<int>& classes) {
  const RasterWindow window{group.west, group.north, group.east - group.west + 1,
                            group.south - group.north + 1};
  const auto part = std::make_shared<Raster>();
  {
    const std::lock_guard<std::mutex> lock(reading_);
    *part = bands_.readRaster(window);
  }
  const PointClassifier classifier(classifier_, part);
  for (const Group::Member& member : group.members) {
    // The cell is that of the whole raster: a point on an edge may be rounded into another cell of
    // the part.
    const std::size_t cell =
        part->grid.index(member.column - window.column, member.row - window.row);
    classes[member.point] = classifier
                                .classifyIn(cell, points.z[member.point],
                                            static_cast<double>(points.intensity[member.point]))
                                .index;
  }
}

PointClassCounts classifyPointFile(const std::filesystem::path& input,
                                   const std::filesystem::path& output, PointClasses& classes,
                                   const SurveyReader& survey, std::size_t place, int threads) {
  requireCopyable(input);
  if (lowerExtension(input) == ".pcd") return classifyPcd(input, output, classes, survey, place);
  const LasFile file(input);
  std::atomic<std::uint64_t> unclassified{0};
  const LasEdit edit = [&](const LasRecordBlock& block) {
    unclassified += classifyRecords(file, block, classes, survey, place);
  };
  LasRewriteResult written = rewriteLas(file, output, edit, threads);
  return {written.points, unclassified.load(), std::move(written.remarks)};
}

}  // namespace pcl_als
