// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <atomic>
#include <map>
#include <optional>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/time_unit.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/point_classes.h>

namespace pcl_als {
namespace {

// Formats 0-5 keep flags in the upper three bits.
constexpr unsigned kShortClass = 0x1F;
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

/// Which points of a file get a class; not to be shared between threads.
class UsedPoints {
 public:
  UsedPoints(const ArrangedFiles* arranged, std::size_t place) : arranged_(arranged) {
    if (arranged != nullptr) sorter_.emplace(arranged->arrangement(), place);
  }
  bool operator()(std::uint16_t source, double time) {
    if (!sorter_) return true;
    return arranged_->arrangement().labels()[sorter_->label(source, time)].index >= 0;
  }

 private:
  const ArrangedFiles* arranged_;
  std::optional<StripArrangement::Sorter> sorter_;
};

PointClassCounts classifyPcd(const std::filesystem::path& input,
                             const std::filesystem::path& output, PointClasses& classes,
                             UsedPoints used) {
  PcdFindings findings;
  const Strip<PointLidar> strip = loadPcd(input, {}, findings);
  std::vector<PointClasses::Point> points;
  for (const PointLidar& point : *strip.cloud) {
    const Eigen::Vector3d place = strip.frame.toGround({point.x, point.y, point.z});
    points.push_back({place.x(), place.y(), place.z(), static_cast<double>(point.intensity)});
  }
  const std::vector<int> found = classes.classify(points);
  const std::vector<std::uint8_t> codes = codesOf(classes.model());
  PointClassCounts counts{points.size(), 0, findings.remarks};
  for (std::size_t i = 0; i < found.size(); ++i) {
    PointLidar& point = (*strip.cloud)[i];
    auto& code = point.classification;
    if (found[i] == MaximumLikelihood::kNoClass || isNoise(code) ||
        !used(point.point_source_id, secondsOfTime(point.gps_time)))
      ++counts.unclassified;
    else
      code = codes[static_cast<std::size_t>(found[i])];
  }
  savePcd(output, strip);
  return counts;
}

/// Changes the class of records; returns how many keep theirs.
std::uint64_t classifyRecords(const LasFile& file, const std::vector<std::uint8_t>& codes,
                              const LasRecordBlock& block, PointClasses& classes, UsedPoints used) {
  const LasScaling metres = file.toMetres();
  const LasRecordLayout& layout = file.layout();
  std::vector<PointClasses::Point> points;
  points.reserve(block.count);
  for (std::size_t i = 0; i < block.count; ++i) {
    const std::byte* record = block.records + i * block.record_length;
    double place[3];
    for (int axis = 0; axis < 3; ++axis)
      place[axis] =
          loadLas<std::int32_t>(record + 4 * axis) * metres.scale[axis] + metres.offset[axis];
    const double intensity = loadLas<std::uint16_t>(record + 12);
    points.push_back({place[0], place[1], place[2], intensity});
  }
  const std::vector<int> found = classes.classify(points);
  std::uint64_t missed = 0;
  for (std::size_t i = 0; i < block.count; ++i) {
    std::byte* record = block.records + i * block.record_length;
    std::byte& field = record[layout.classification];
    const auto present = std::to_integer<unsigned>(field);
    const unsigned flags = layout.extended ? 0U : present & ~kShortClass;
    if (found[i] == MaximumLikelihood::kNoClass ||
        isNoise(static_cast<std::uint8_t>(present & ~flags)) ||
        !used(loadLas<std::uint16_t>(record + layout.point_source_id), layout.timeOf(record)))
      ++missed;
    else
      field = static_cast<std::byte>(flags | codes[static_cast<std::size_t>(found[i])]);
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

std::vector<int> PointClasses::classify(const std::vector<Point>& points) {
  const RasterGrid& grid = bands_.grid();
  std::map<std::pair<int, int>, Group> groups;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const long long column = grid.columnOf(points[i].x), row = grid.rowOf(points[i].y);
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

void PointClasses::classify(const std::vector<Point>& points, const Group& group,
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
    const Point& point = points[member.point];
    // The cell is that of the whole raster: a point on an edge may be rounded into another cell of
    // the part.
    const std::size_t cell =
        part->grid.index(member.column - window.column, member.row - window.row);
    classes[member.point] = classifier.classifyIn(cell, point.z, point.intensity).index;
  }
}

PointClassCounts classifyPointFile(const std::filesystem::path& input,
                                   const std::filesystem::path& output, PointClasses& classes,
                                   const ArrangedFiles* arranged, std::size_t place, int threads) {
  if (input.extension() == ".pcd")
    return classifyPcd(input, output, classes, UsedPoints(arranged, place));
  const LasFile file(input);
  const std::vector<std::uint8_t> codes = codesOf(classes.model());
  std::atomic<std::uint64_t> unclassified{0};
  const LasEdit edit = [&](const LasRecordBlock& block) {
    unclassified += classifyRecords(file, codes, block, classes, UsedPoints(arranged, place));
  };
  LasRewriteResult written = rewriteLas(file, output, edit, threads);
  return {written.points, unclassified.load(), std::move(written.remarks)};
}

}  // namespace pcl_als
