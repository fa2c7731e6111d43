// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "calibration_json.h"

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/io/survey_io.h>

namespace pcl_als {
namespace detail {
namespace {

using namespace field;
using Result = CalibrationResult;

/// The version of a file that can be read.
long versionOf(const FieldNode& root, const std::string& name) {
  if (!root.has("format") || root["format"].text() != kCalibrationFormat)
    throw InputError(name + ": 'format' is not '" + std::string(kCalibrationFormat) +
                     "'; not a calibration file");
  const long version = root["version"].whole();
  if (version < 1 || version > kCalibrationVersion)
    root["version"].refuse("is " + std::to_string(version) +
                           "; this version of pcl_als reads 1 to " +
                           std::to_string(kCalibrationVersion));
  return version;
}

/// Files of versions that gave no verdict have one by whether the adjustment converged; a file made
/// by hand, with neither, is usable.
void addVerdict(const FieldNode& instrument, const FieldNode& report, Result& result) {
  if (!instrument.has("verdict") && report.has("converged") && !report["converged"].truth())
    result.verdict.downgrade(CalibrationStatus::not_converged, "the adjustment did not converge");
}

/// What all parts have in common.
const Fields<Result>& commonFields() {
  using F = Field<Result>;
  static const Fields<Result> fields(
      "common", "What all parts have in common.",
      {F("crs", &Result::crs, "Coordinate system of the ground frame, WKT or \"EPSG:…\"",
         unlessEmpty),
       F("inputs", &Result::inputs, "Files of the points", mayBeMissing)});
  return fields;
}

}  // namespace

CalibrationResult instrumentIn(const FieldNode& part) {
  CalibrationResult result;
  instrumentFields().read(result, part);
  addVerdict(part, part, result);
  return result;
}

CalibrationResult calibrationIn(const FieldNode& root, const std::string& name) {
  const bool in_parts = versionOf(root, name) > 1;
  const FieldValue absent = FieldValue::Object();
  const auto part = [&](const char* key) {
    if (!in_parts) return root;
    return root.has(key) ? root[key] : FieldNode(absent, name, key);
  };
  const FieldNode instrument = part("instrument"), report = part("report");
  CalibrationResult result;
  instrumentFields().read(result, instrument);
  flightFields().read(result, part("flight"));
  reportFields().read(result, report);
  commonFields().read(result, root);
  addVerdict(instrument, report, result);
  return result;
}

}  // namespace detail

const FieldTable& calibrationFields() {
  using Result = CalibrationResult;
  using F = Field<Result>;
  static const Fields<Result> fields(
      "calibration",
      "Result of `pcl_als_calibrate`. Biases and errors are the assumed minus the true value.",
      {F::constant("format", detail::kCalibrationFormat, ""),
       F::constant("version", detail::kCalibrationVersion, "Files of version 1 are read as well"),
       toolVersionField<Result>(),
       F(
           "id", [](const Result& result) { return calibrationId(result); },
           "Identifies what the calibration changes in points, as corrected files record it"),
       F::all(kSameObject, detail::commonFields()),
       F("instrument", kSameObject, detail::instrumentFields(),
         "Applies to every flight with the instrument"),
       F("flight", kSameObject, detail::flightFields(),
         "Applies only to the flight that was calibrated with"),
       F("report", kSameObject, detail::reportFields(),
         "What the calibration found; changes no point")});
  return fields;
}

const Fields<CalibrationResult>& calibrationInstrumentFields() {
  return detail::instrumentFields();
}

const Fields<ExcludedPoints>& excludedFields() {
  using F = Field<ExcludedPoints>;
  using Reason = ExclusionReason;
  static const Fields<ExcludedPoints> fields(
      "left_out", "Points of one strip that took no part, for one reason.",
      {F("strip", &ExcludedPoints::strip, "Strip"),
       F("reason", &ExcludedPoints::reason,
         FieldNames<Reason>(toString,
                            {Reason::excluded, Reason::zero_time, Reason::before_trajectory,
                             Reason::after_trajectory, Reason::in_trajectory_gap,
                             Reason::strip_uncovered, Reason::in_turn, Reason::hovering,
                             Reason::rounded_times, Reason::too_few_points, Reason::copy}),
         "Why they were excluded"),
       F("points", &ExcludedPoints::points, "Number of these points"),
       F("of", &ExcludedPoints::of, "Number of all points of the strip")});
  return fields;
}

std::string calibrationJson(const CalibrationResult& result) {
  return jsonText(calibrationFields().write(&result));
}

void writeCalibration(const std::filesystem::path& path, const CalibrationResult& result) {
  writeFile(path, calibrationJson(result));
}

CalibrationResult parseCalibration(const std::string& text, const std::string& name) {
  const FieldValue root = parseJson(text, name);
  return detail::calibrationIn({root, name}, name);
}

CalibrationResult readCalibration(const std::filesystem::path& path) {
  return parseCalibration(readWholeFile(path, kJsonLimits), path.string());
}

std::string_view toolVersion() {
  return PCL_ALS_VERSION;
}

}  // namespace pcl_als
