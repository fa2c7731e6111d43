// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/class_name.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/picture/picture_source.h>
#include <pcl_als/processing/picture/section_places.h>

namespace pcl_als {
namespace {

constexpr double kSmoothRms = 0.15;  // m: cells rougher than this are no surface to compare with

std::string extraFieldNames(const std::vector<SurveyedFile>& files) {
  std::string names;
  for (const SurveyedFile& file : files) {
    const PointFileInfo& info = file.sources.info;
    if (info.format.rfind("LA", 0) != 0) continue;  // LAS and LAZ only
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
    : survey_(paths, 0, window) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  minimum_.setConstant(infinity);
  maximum_.setConstant(-infinity);
  first_time_ = infinity;
  for (const SurveyedFile& file : files()) {
    for (const PointSource& source : file.sources.sources) {
      if (!source.minimum.allFinite() || !source.maximum.allFinite()) continue;
      minimum_ = minimum_.cwiseMin(source.minimum);
      maximum_ = maximum_.cwiseMax(source.maximum);
      first_time_ = std::min(first_time_, source.first_time);
    }
  }
  if (!minimum_.allFinite()) {
    throw InputError(paths.front() + (paths.size() > 1 ? " and the other files hold" : ": holds") +
                     " no point to draw");
  }
  survey_.choose(StripChoice{{}, {}, split, true}, {});
}

double PictureSource::sectionCell(const std::vector<bool>& chosen) const {
  return pcl_als::sectionCell(stripDensities(files(), survey_.arrangement()), chosen);
}

double PictureSource::cellFor(int strip, double points) const {
  return stripDensities(files(), survey_.arrangement())[static_cast<std::size_t>(strip)].cellFor(
      points);
}

void PictureSource::read(const std::function<void(const Point&)>& sink,
                         const std::string& extra_field) const {
  SurveyReader::Reading reading;
  reading.threads = 1;  // in file order
  reading.extra_field = extra_field;
  survey_.read(
      [&sink](const SurveyReader::Run& run) {
        for (std::size_t row = run.from; row < run.to; ++row)
          sink({run.position(row), run.strip, row, &run.chunk});
      },
      reading);
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
  if (!extra_field_.empty())
    return chunk.extra.empty() ? std::numeric_limits<float>::quiet_NaN()
                               : static_cast<float>(chunk.extra[i]);
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
