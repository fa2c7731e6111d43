// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/strip_naming.h>

#include "column_reader.h"
#include "point_fill.h"

namespace pcl_als {
namespace {

// The corner of a square is 3.54 km from its centre, within LocalFrame::kMaximumExtent.
constexpr double kSquare = 5000.0;
static_assert(kSquare * 0.7072 < LocalFrame::kMaximumExtent);

/// A part of a strip while it is filled.
class PartBuilder {
 public:
  PartBuilder(const std::string& id, const Eigen::Vector3d& centre, const std::string& crs) {
    strip_.id = id;
    strip_.frame = LocalFrame::around(centre, crs);
    strip_.cloud->sensor_origin_.head<3>() = strip_.frame.origin.cast<float>();
  }

  void recordCorrections(const std::string& record) { strip_.corrections = record; }
  void reserve(std::uint64_t points) { strip_.cloud->reserve(points); }

  void add(const PointChunk& chunk, std::size_t row, const detail::ColumnReader& reader) {
    const std::size_t before = strip_.cloud->size();
    strip_.cloud->push_back(detail::pointOf(chunk, row, strip_.frame.origin));
    if (reader.fields().empty()) return;
    if (reader.file() != file_) assignColumns(reader);
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      PointColumn& column = strip_.columns[columns_[k]];
      column.values.resize(before, missingValue(column.field));
      column.values.push_back(reader.values(k)[row]);
    }
  }

  StripWithColumns finish() {
    for (PointColumn& column : strip_.columns)
      column.values.resize(strip_.cloud->size(), missingValue(column.field));
    return std::move(strip_);
  }

 private:
  static double missingValue(const LasExtraField& field) {
    const bool floating = field.type == LasExtraType::f32 || field.type == LasExtraType::f64;
    return floating ? std::numeric_limits<double>::quiet_NaN() : 0.0;
  }

  /// Finds the columns of the fields of a file, or makes them.
  void assignColumns(const detail::ColumnReader& reader) {
    file_ = reader.file();
    columns_.clear();
    for (const LasExtraField& field : reader.fields()) {
      std::size_t column = 0;
      while (column < strip_.columns.size() && strip_.columns[column].field.name != field.name)
        ++column;
      if (column == strip_.columns.size()) strip_.columns.push_back({field, {}});
      columns_.push_back(column);
    }
  }

  StripWithColumns strip_;
  std::size_t file_ = std::numeric_limits<std::size_t>::max();  ///< whose fields columns_ are of
  std::vector<std::size_t> columns_;
};

/// A strip while it is filled: one part, or one per square of the grid.
class StripBuilder {
 public:
  void extend(const PointSource& source) {
    low_ = points_ == 0 ? source.minimum : low_.cwiseMin(source.minimum);
    high_ = points_ == 0 ? source.maximum : high_.cwiseMax(source.maximum);
    points_ += source.points;
  }

  /// The record of the first file of the strip that has one.
  void recordCorrections(const std::string& record) {
    if (corrections_.empty()) corrections_ = record;
  }

  void begin(const std::string& id, const std::string& crs) {
    id_ = id;
    crs_ = crs;
    whole_ = 0.5 * (high_ - low_).head<2>().norm() < LocalFrame::kMaximumExtent - 10.0;
    if (whole_) newPart({0, 0}, 0.5 * (low_ + high_)).reserve(points_);
  }

  void add(const PointChunk& chunk, std::size_t row, const detail::ColumnReader& reader) {
    PartBuilder& part = whole_ ? parts_.begin()->second : partAt(chunk.x[row], chunk.y[row]);
    part.add(chunk, row, reader);
  }

  void moveTo(std::vector<StripWithColumns>& strips) {
    for (auto& part : parts_) strips.push_back(part.second.finish());
  }

 private:
  using Square = std::pair<long, long>;

  PartBuilder& newPart(const Square& square, const Eigen::Vector3d& centre) {
    PartBuilder& part = parts_.try_emplace(square, id_, centre, crs_).first->second;
    part.recordCorrections(corrections_);
    return part;
  }

  PartBuilder& partAt(double x, double y) {
    const Square square{std::lround(std::floor(x / kSquare)), std::lround(std::floor(y / kSquare))};
    const auto found = parts_.find(square);
    if (found != parts_.end()) return found->second;
    return newPart(square, {(square.first + 0.5) * kSquare, (square.second + 0.5) * kSquare,
                            0.5 * (low_.z() + high_.z())});
  }

  std::string id_, crs_, corrections_;
  std::uint64_t points_ = 0;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), high_ = Eigen::Vector3d::Zero();
  bool whole_ = true;
  std::map<Square, PartBuilder> parts_;
};

std::string commonCrs(const std::vector<PointFileSources>& files) {
  std::vector<PointFileInfo> infos;
  infos.reserve(files.size());
  for (const PointFileSources& file : files) infos.push_back(file.info);
  return commonReference(infos).crs;
}

void checkTimes(const std::vector<PointFileSources>& files) {
  for (const PointFileSources& file : files)
    if (file.info.time_kind != files[0].info.time_kind)
      throw InputError(file.info.path.string() + ": has another kind of GPS time than " +
                       files[0].info.path.string() +
                       " (seconds of the week, adjusted standard time, or none)");
}

/// The ids in the part of each file that is read.
std::vector<PointFileSources> sourcesOf(const std::vector<std::filesystem::path>& paths,
                                        const PointWindow& window) {
  requirePointFiles(paths.size());
  std::vector<PointFileSources> files;
  files.reserve(paths.size());
  for (const auto& path : paths) files.push_back(surveySources(*PointReader::open(path, window)));
  const auto empty = [](const PointFileSources& file) { return file.sources.empty(); };
  if (!window.everything() && std::all_of(files.begin(), files.end(), empty))
    refuseEmptyWindow(paths, window);
  checkTimes(files);
  return files;
}

/// The builders of the strips, by name.
class StripBuilders {
 public:
  explicit StripBuilders(const std::vector<PointFileSources>& files)
      : files_(files), naming_(files) {
    const std::string crs = commonCrs(files);
    for (std::size_t f = 0; f < files.size(); ++f)
      for (const PointSource& source : files[f].sources)
        extend(naming_.nameOf(f, source.id), source, files[f].info.corrections);
    for (auto& [name, builder] : builders_) builder.begin(name, crs);
  }

  void read(detail::ColumnReader& reader) {
    const std::size_t file = reader.file();
    std::map<std::uint16_t, StripBuilder*> of_id;
    for (const PointSource& source : files_[file].sources)
      of_id[source.id] = &builders_[naming_.nameOf(file, source.id)];
    PointChunk chunk;
    while (reader.read(chunk))
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        const auto builder = of_id.find(chunk.point_source_id[i]);
        if (builder == of_id.end())
          throw InputError(files_[file].info.path.string() + ": was changed while it was read");
        builder->second->add(chunk, i, reader);
      }
  }

  std::vector<StripWithColumns> finish() {
    std::vector<StripWithColumns> strips;
    for (const std::string& name : naming_.names()) builders_[name].moveTo(strips);
    return strips;
  }

 private:
  void extend(const std::string& name, const PointSource& source, const std::string& corrections) {
    StripBuilder& builder = builders_[name];
    builder.extend(source);
    builder.recordCorrections(corrections);
  }

  const std::vector<PointFileSources>& files_;
  StripNaming naming_;
  std::map<std::string, StripBuilder> builders_;
};

/// InputError for a column that no file has.
void requireColumns(const std::vector<std::filesystem::path>& paths, const StripLoading& loading) {
  std::set<std::string> missing(loading.columns.begin(), loading.columns.end());
  std::string names;
  for (std::size_t f = 0; f < paths.size() && !missing.empty(); ++f) {
    const detail::ColumnReader reader(paths[f], f, loading);
    for (const LasExtraField& field : reader.fields()) missing.erase(field.name);
    if (f == 0) names = reader.names();
  }
  if (missing.empty()) return;
  throw InputError(paths.front().string() + ": has no field '" + *missing.begin() + "'; it has " +
                   (names.empty() ? "none besides the usual ones" : names));
}

}  // namespace

std::vector<StripWithColumns> loadStrips(const std::vector<std::filesystem::path>& paths,
                                         const StripLoading& loading) {
  const std::vector<PointFileSources> files = sourcesOf(paths, loading.window);
  requireColumns(paths, loading);
  StripBuilders builders(files);
  for (std::size_t f = 0; f < paths.size(); ++f) {
    detail::ColumnReader reader(paths[f], f, loading);
    builders.read(reader);
  }
  return builders.finish();
}

std::vector<Strip<PointLidar>> loadStrips(const std::vector<std::filesystem::path>& paths) {
  std::vector<StripWithColumns> loaded = loadStrips(paths, StripLoading());
  return {std::make_move_iterator(loaded.begin()), std::make_move_iterator(loaded.end())};
}

}  // namespace pcl_als
