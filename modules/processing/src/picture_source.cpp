// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/class_name.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/io/las_point_reader.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/picture/picture_source.h>
#include <pcl_als/processing/picture/section_places.h>

namespace pcl_als {
namespace {

constexpr double kSmoothRms = 0.15;  // m: cells rougher than this are no surface to compare with

/// The points of a file, with the values of an extra-bytes field where it has that.
class PictureReader {
 public:
  PictureReader(const std::filesystem::path& path, const PointWindow& window,
                const std::string& field) {
    const std::string extension = lowerExtension(path);
    if (field.empty() || (extension != ".las" && extension != ".laz")) {
      reader_ = PointReader::open(path, window);
      return;
    }
    auto las = std::make_unique<LasPointReader>(path, window, PointReader::OtherCoordinates::refuse,
                                                LasPointReader::kColumns | kLazExtraBytes);
    field_ = findLasExtraField(las->file().extraFields(), field, path.string());
    las_ = las.get();
    reader_ = std::move(las);
  }

  bool read(PointChunk& chunk) {
    const bool more = reader_->read(chunk);
    values_.assign(chunk.size(), std::numeric_limits<double>::quiet_NaN());
    if (field_ != nullptr)
      decodeLasExtraField(las_->records(), chunk.size(), las_->file().header().record_length,
                          *field_, values_);
    return more;
  }
  double extra(std::size_t i) const { return values_[i]; }

 private:
  std::unique_ptr<PointReader> reader_;
  LasPointReader* las_ = nullptr;
  const LasExtraField* field_ = nullptr;
  std::vector<double> values_;
};

std::string extraFieldNames(const std::vector<SurveyedFile>& files) {
  std::string names;
  for (const SurveyedFile& file : files) {
    const PointFileInfo& info = file.sources.info;
    if (info.format.rfind("PCD", 0) == 0) continue;
    const LasFile las(info.path);
    for (const LasExtraField& field : las.extraFields()) {
      if ((" " + names + ",").find(" " + field.name + ",") != std::string::npos) continue;
      names += (names.empty() ? "" : ", ") + field.name;
    }
  }
  return names;
}

const std::array<const char*, 8> kNames = {"elevation", "intensity",  "strip", "class",
                                           "return",    "scan_angle", "time",  "difference"};

enum ReturnKind { kSingle, kFirst, kMiddle, kLast };

}  // namespace

PictureSource::PictureSource(const std::vector<std::string>& paths, bool split,
                             const PointWindow& window)
    : window_(window) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  minimum_.setConstant(infinity);
  maximum_.setConstant(-infinity);
  first_time_ = infinity;
  for (const std::string& path : paths) {
    const SurveyedFile& file = files_.emplace_back(surveyFile(SurveyInput::ofFile(path, window)));
    for (const PointSource& source : file.sources.sources) {
      if (!source.minimum.allFinite() || !source.maximum.allFinite()) continue;
      minimum_ = minimum_.cwiseMin(source.minimum);
      maximum_ = maximum_.cwiseMax(source.maximum);
      first_time_ = std::min(first_time_, source.first_time);
    }
  }
  std::vector<PointFileInfo> infos;
  for (const SurveyedFile& file : files_) infos.push_back(file.sources.info);
  remarks_ = commonReference(infos).remarks;
  for (const SurveyedFile& file : files_)
    for (const std::string& remark : {file.sources.damage, file.sources.box_remark})
      if (!remark.empty()) remarks_.push_back(remark);
  arrangement_.emplace(files_, StripChoice{{}, {}, split, true}, FlownTimes());
  if (pointCount() == 0 && !window.everything())
    refuseEmptyWindow({paths.begin(), paths.end()}, window);
  if (!minimum_.allFinite()) {
    throw InputError(paths.front() + (paths.size() > 1 ? " and the other files hold" : ": holds") +
                     " no point to draw");
  }
}

std::uint64_t PictureSource::pointCount() const {
  std::uint64_t count = 0;
  for (const SurveyedFile& file : files_) count += file.sources.info.point_count;
  return count;
}

double PictureSource::sectionCell(const std::vector<bool>& chosen) const {
  return pcl_als::sectionCell(stripDensities(files_, *arrangement_), chosen);
}

double PictureSource::cellFor(int strip, double points) const {
  return stripDensities(files_, *arrangement_)[static_cast<std::size_t>(strip)].cellFor(points);
}

void PictureSource::read(const std::function<void(const Point&)>& sink,
                         const std::string& extra_field) const {
  for (std::size_t file = 0; file < files_.size(); ++file) {
    StripArrangement::Sorter sorter(*arrangement_, file);
    PictureReader reader(files_[file].sources.info.path, window_, extra_field);
    PointChunk chunk;
    while (reader.read(chunk)) {
      Point point{{}, 0, 0, &chunk, 0.0};
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        const std::size_t label = sorter.label(chunk.point_source_id[i], chunk.gps_time[i]);
        point.strip = arrangement_->labels()[label].index;
        if (point.strip < 0) continue;
        point.position = {chunk.x[i], chunk.y[i], chunk.z[i]};
        point.index = i;
        point.extra = reader.extra(i);
        sink(point);
      }
    }
  }
}

PointAttribute::PointAttribute(std::string name, const PictureSource& source,
                               const std::string& reference)
    : name_(std::move(name)), source_(source) {
  if (name_ == "difference") {
    if (reference.empty()) {
      throw UsageError("colour by difference needs a reference: the strip to compare with");
    }
    reference_ = static_cast<int>(stripNamed(source.strips(), reference, "reference"));
    if (source.strips().size() < 2)
      throw UsageError("colour by difference needs a second strip besides " + reference);
    return;
  }
  if (!reference.empty()) throw UsageError("a reference strip serves colour by difference only");
  if (std::find(kNames.begin(), kNames.end(), name_) != kNames.end()) return;
  const std::string fields = extraFieldNames(source.files());
  if ((", " + fields + ",").find(", " + name_ + ",") == std::string::npos || name_.empty()) {
    std::string known;
    for (const char* each : kNames) known += (known.empty() ? "" : ", ") + std::string(each);
    throw UsageError("colour of points: '" + name_ + "' is none of " + known +
                     (fields.empty() ? ", and the files have no extra-bytes fields"
                                     : ", nor of the extra-bytes fields " + fields));
  }
  extra_field_ = name_;
}

void PointAttribute::prepare(double cell) {
  if (reference_ < 0) return;
  if (cell <= 0.0) cell = source_.cellFor(reference_, 15.0);
  planes_.emplace(source_.minimum().head<2>(), source_.maximum().head<2>(), cell);
  source_.read([&](const PictureSource::Point& point) {
    if (point.strip == reference_ && point.chunk->number_of_returns[point.index] <= 1) {
      planes_->add(point.position);
    }
  });
}

float PointAttribute::differenceOf(const PictureSource::Point& point) const {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  if (point.strip == reference_ || point.chunk->number_of_returns[point.index] > 1) return none;
  const auto plane = planes_->planeAt(point.position.x(), point.position.y());
  if (!plane || plane->rms > kSmoothRms) return none;
  const double difference =
      point.position.z() - plane->heightAt(point.position.x(), point.position.y());
  // Further off it is another surface: a roof above a street.
  return std::abs(difference) < 2.0 ? static_cast<float>(difference) : none;
}

float PointAttribute::valueOf(const PictureSource::Point& point) const {
  const PointChunk& chunk = *point.chunk;
  const std::size_t i = point.index;
  if (!extra_field_.empty()) return static_cast<float>(point.extra);
  if (name_ == "elevation") return static_cast<float>(point.position.z());
  if (name_ == "intensity") return chunk.intensity[i];
  if (name_ == "strip") return static_cast<float>(point.strip);
  if (name_ == "class") return chunk.classification[i];
  if (name_ == "scan_angle") return chunk.scan_angle[i];
  if (name_ == "time") return static_cast<float>(chunk.gps_time[i] - source_.firstTime());
  if (name_ == "difference") return differenceOf(point);
  if (chunk.number_of_returns[i] <= 1) return kSingle;
  if (chunk.return_number[i] <= 1) return kFirst;
  return chunk.return_number[i] >= chunk.number_of_returns[i] ? kLast : kMiddle;
}

PointColoring PointAttribute::coloring() const {
  PointColoring coloring;
  coloring.heading = name_;
  if (name_ == "elevation") coloring.heading = "elevation, m";
  if (name_ == "scan_angle") coloring.heading = "scan angle, degrees";
  if (name_ == "time") coloring.heading = "time from first, s";
  if (name_ == "intensity") coloring.map = ColorMap::named("gray");
  if (name_ == "scan_angle") coloring.map = ColorMap::named("diverging");
  if (name_ == "difference") {
    coloring.heading =
        "above strip " + source_.strips()[static_cast<std::size_t>(reference_)] + ", m";
    coloring.map = ColorMap::named("diverging");
    coloring.no_value = "not comparable";
    coloring.no_value_color = {0xd8, 0xd8, 0xd8};
  }
  if (name_ == "strip") {
    for (std::size_t i = 0; i < source_.strips().size(); ++i) {
      coloring.categories.push_back({static_cast<float>(i), source_.strips()[i], categoryColor(i)});
    }
  }
  if (name_ == "class") {
    for (int code = 0; code < 256; ++code) {
      coloring.categories.push_back({static_cast<float>(code), className(code), classColor(code)});
    }
  }
  if (name_ == "return") {
    coloring.categories = {{kSingle, "single", Color::rgb(0xb8b8b8)},
                           {kFirst, "first of several", Color::rgb(0x009e73)},
                           {kMiddle, "between", Color::rgb(0xe69f00)},
                           {kLast, "last of several", Color::rgb(0x0072b2)}};
  }
  return coloring;
}

}  // namespace pcl_als
