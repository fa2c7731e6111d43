// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "file_uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_record.h>

#include "deviation_sum.h"

namespace pcl_als::detail {
namespace {

constexpr const char* kHorizontal = "sigma_horizontal";
constexpr const char* kVertical = "sigma_vertical";
constexpr const char* kRangeStd = "range_std";  ///< of decomposeWaveforms()

LasExtraField fieldOf(const char* name, const char* description) {
  LasExtraField field;
  field.name = name;
  field.description = description;
  field.type = LasExtraType::f32;
  return field;
}

std::vector<LasExtraField> wantedFields() {
  return {fieldOf(kHorizontal, "std. deviation in the plane, m"),
          fieldOf(kVertical, "std. deviation of the height, m")};
}

std::vector<TrajectoryErrorKnot> knotsOf(const std::vector<TrajectoryAccuracy>& accuracy) {
  std::vector<TrajectoryErrorKnot> knots;
  for (const TrajectoryAccuracy& at : accuracy) {
    TrajectoryErrorKnot& knot = knots.emplace_back();
    knot.time = at.time;
    knot.position_std = at.position;
    knot.angles_std = {at.angles.y(), at.angles.x(), at.angles.z()};
  }
  std::stable_sort(knots.begin(), knots.end(),
                   [](const auto& a, const auto& b) { return a.time < b.time; });
  return knots;
}

bool isPlain(const LasExtraField& field) {
  return field.type == LasExtraType::f32 && field.components == 1 && field.scale == 1.0 &&
         field.offset == 0.0;
}

}  // namespace

FileUncertainty::FileUncertainty(const LasFile& file, const SystemCorrection& correction,
                                 const IntegerBiasCorrection::Layout& layout,
                                 const CalibrationResult& calibration,
                                 const FileCorrectionOptions& options)
    : input_(IntensityInput::open(file.path().string(),
                                  {{}, IntensityInput::kWindow, options.threads})),
      layout_(layout),
      correction_(correction),
      uncertainty_(calibration, correction.flight(),
                   {options.strip_corrections, knotsOf(options.trajectory_accuracy)}) {
  if (options.deviation_cell > 0.0) {
    const Eigen::AlignedBox3d box = input_->survey().sources.box();
    cells_ = std::make_unique<DeviationCells>(box.min().head<2>(), box.max().head<2>(),
                                              options.deviation_cell);
  }
  surveyed_.push_back(withoutTracks(input_->survey().sources));
  StripChoice choice;
  choice.keep_timeless = true;
  arrangement_.emplace(surveyed_, choice, FlownTimes());
  chooseRadius();
  placeFields(file);
}

/// That of about 16 points of the sparsest strip in the middle of the file.
void FileUncertainty::chooseRadius() {
  if (input_->windows() == 0) return;
  IntensityWindow window;
  WindowRequest request;
  request.arrangement = &*arrangement_;
  input_->load(input_->windows() / 2, request, window);
  double largest = 0.0;
  for (const auto& [strip, points] : window.surface_points)
    largest = std::max(largest, LocalSurfaces::radiusFor(points));
  if (largest > 0.0) radius_ = largest;
}

/// Fields that the file has from an earlier correction are overwritten.
void FileUncertainty::placeFields(const LasFile& file) {
  const auto find = [&file](const std::vector<LasExtraField>& fields, const char* name) {
    return findLasExtraField(fields, name, file.path().string());
  };
  for (const LasExtraField& field : wantedFields()) {
    const LasExtraField* known = find(file.extraFields(), field.name.c_str());
    if (known == nullptr) {
      extension_.fields.push_back(field);
    } else if (!isPlain(*known)) {
      throw InputError(file.path().string() + ": has a field " + field.name +
                       " of another type than a float in metres; rename or remove it");
    }
  }
  extension_.block_records = input_->windowSize();
  const std::vector<LasExtraField> added = placeExtension(file, extension_.fields);
  const auto positionOf = [&](const char* name) {
    const LasExtraField* field = find(added, name);
    return (field != nullptr ? field : find(file.extraFields(), name))->position;
  };
  horizontal_at_ = positionOf(kHorizontal);
  vertical_at_ = positionOf(kVertical);
  const LasExtraField* range_std = find(file.extraFields(), kRangeStd);
  if (range_std != nullptr && isPlain(*range_std)) range_std_at_ = range_std->position;
}

double FileUncertainty::rangeStdOf(const std::byte* record) const {
  if (!range_std_at_) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(loadLas<float>(record + *range_std_at_));
}

std::vector<Eigen::Vector3f> FileUncertainty::normalsOf(const LasRecordBlock& block) const {
  WindowRequest request;
  request.arrangement = &*arrangement_;
  request.records = block.records;
  request.record_length = block.record_length;
  for (const PointSource& source : surveyed_.front().sources.sources)
    request.margins[source.id] = radius_;
  IntensityWindow window;
  input_->load(block.first / input_->windowSize(), request, window);
  LocalSurfaceSettings settings;
  settings.radius = radius_;
  std::map<int, LocalSurfaces> surfaces;
  for (const auto& [strip, points] : window.surface_points)
    surfaces.emplace(strip, LocalSurfaces(points, settings));
  std::vector<Eigen::Vector3f> normals;
  for (const IntensityPoint& point : window.points) {
    normals.push_back(LocalSurface().normal);
    const auto strip = surfaces.find(arrangement_->labels()[point.label].index);
    if (strip == surfaces.end() || !point.isLast()) continue;
    const LocalSurface surface = strip->second.at(window.relative(point.position));
    if (surface.found()) normals.back() = surface.normal;
  }
  return normals;
}

std::size_t FileUncertainty::systemOf(const std::byte* record) const {
  if (correction_.systems().single()) return 0;
  const std::uint16_t source = layout_.fields.sourceOf(record);
  std::uint8_t channel = 0;
  if (layout_.channel.recorded())
    layout_.channel.decode(record, 1, layout_.record_length, &channel);
  const std::uint8_t system = correction_.systems().of(source, channel);
  if (system == correction_.systems().fixed())
    throw InputError("strip " + std::to_string(source) +
                     " was held fixed by the calibration, which therefore states no standard "
                     "deviations of its points");
  return system;
}

void FileUncertainty::store(const LasRecordBlock& block,
                            const std::vector<Eigen::Vector3f>& normals) {
  constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
  std::vector<PointDeviation> points(block.count);
  PointUncertainty::Cursor cursor;
  Eigen::Matrix3d covariance;
  for (std::size_t i = 0; i < block.count; ++i) {
    std::byte* record = block.records + i * block.record_length;
    const Eigen::Vector3d position =
        LasRecordLayout::positionOf(record, layout_.metres.scale, layout_.metres.offset);
    const double time = correction_.flightTime(layout_.fields.timeOf(record));
    points[i] = {position.x(), position.y(), kNone, kNone};
    if (correction_.knowsAttitude(time) &&
        uncertainty_.covarianceAt(time, position, normals[i].cast<double>(), cursor, covariance,
                                  systemOf(record), rangeStdOf(record))) {
      const PointUncertainty::Sigma sigma = PointUncertainty::sigmaOf(covariance);
      points[i].horizontal = static_cast<float>(sigma.horizontal);
      points[i].vertical = static_cast<float>(sigma.vertical);
    }
    storeLas(record + horizontal_at_, points[i].horizontal);
    storeLas(record + vertical_at_, points[i].vertical);
  }
  count(points, normals);
  if (cells_) cells_->add(points);
}

void FileUncertainty::count(const std::vector<PointDeviation>& points,
                            const std::vector<Eigen::Vector3f>& normals) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].horizontal)) {
      ++summary_.unknown;
      continue;
    }
    ++summary_.points;
    summary_.on_surface += normals[i].allFinite() ? 1 : 0;
    horizontal_ += squareUnits(points[i].horizontal);
    vertical_ += squareUnits(points[i].vertical);
  }
}

void FileUncertainty::finish(FileCorrectionResult& result) const {
  result.deviations = summary_;
  result.deviations.horizontal = rootMeanSquare(horizontal_, summary_.points);
  result.deviations.vertical = rootMeanSquare(vertical_, summary_.points);
  if (cells_) result.deviation_raster = cells_->raster();
}

}  // namespace pcl_als::detail
