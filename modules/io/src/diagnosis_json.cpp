// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "diagnosis_json.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/error_source.h>

#include "json_node.h"
#include "json_number.h"

namespace pcl_als::detail {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kLargestAngle = "largest_scan_angle_deg";
constexpr const char* kMedianIntensity = "median_intensity";
constexpr const char* kAboutAxis = "deflected_about_axis";

/// Values beyond these are refused, internal units: an error of the file.
double largestOf(ErrorSource source) {
  switch (source) {
    case ErrorSource::slope_ranging:
    case ErrorSource::intensity_ranging:
      return 1.0;
    case ErrorSource::time_offset:
    case ErrorSource::height_offset:
    case ErrorSource::east_offset:
    case ErrorSource::north_offset:
      return 10.0;
    case ErrorSource::range_scale:
    case ErrorSource::deflection_scale:
      return 0.01;
    default:
      return kRadiansPerDegree;
  }
}

}  // namespace

void writeErrorSources(const CalibrationResult& result, Json& part) {
  const ErrorSourceScale& scale = result.source_scale;
  const bool diagnosed = scale.largest_angle > 0.0 || scale.median_intensity > 0.0;
  if (!diagnosed && result.sources.isZero(0.0)) return;
  Json values = Json::object();
  for (const ErrorSourceInfo& info : errorSources()) {
    const double value = result.sources[indexOf(info.source)];
    if (value == 0.0) continue;
    values[std::string(info.name)] =
        Json{{"value", number(value / info.internal_per_unit)}, {"unit", info.unit}};
  }
  values[kLargestAngle] = number(scale.largest_angle / kRadiansPerDegree);
  values[kMedianIntensity] = number(scale.median_intensity);
  if (scale.about_axis) values[kAboutAxis] = true;
  part["error_sources"] = std::move(values);
}

void writeDiagnosis(const CalibrationResult& result, Json& part) {
  if (result.diagnosis.empty()) return;
  Json findings = Json::array();
  for (const ErrorFinding& f : result.diagnosis) {
    findings.push_back(Json{{"source", f.source},
                            {"title", f.title},
                            {"probability", number(f.probability)},
                            {"value", number(f.value)},
                            {"std", number(f.std)},
                            {"unit", f.unit},
                            {"effect_m", number(f.effect)},
                            {"determined", f.determined},
                            {"corrected", f.corrected},
                            {"evidence", f.evidence},
                            {"remedy", f.hint}});
  }
  part["diagnosis"] = std::move(findings);
  if (result.scan_angle_curve.empty()) return;
  Json curve = Json::array();
  for (const AngleError& e : result.scan_angle_curve)
    curve.push_back(Json{{"angle_deg", number(e.angle / kRadiansPerDegree)},
                         {"error_arcsec", number(e.error / kRadiansPerArcsec)},
                         {"std_arcsec", number(e.std / kRadiansPerArcsec)}});
  part["scan_angle_curve"] = std::move(curve);
}

void readErrorSources(const JsonNode& part, CalibrationResult& result) {
  if (!part.has("error_sources")) return;
  const JsonNode values = part["error_sources"];
  for (const ErrorSourceInfo& info : errorSources()) {
    const std::string name(info.name);
    if (!values.has(name.c_str())) continue;
    const JsonNode node = values[name];
    if (node["unit"].text() != info.unit)
      node["unit"].refuse("must be '" + std::string(info.unit) + "'");
    const double most = largestOf(info.source) / info.internal_per_unit;
    result.sources[indexOf(info.source)] =
        node["value"].within(most, std::string(info.unit).c_str()) * info.internal_per_unit;
  }
  result.source_scale.largest_angle =
      values[kLargestAngle].within(90.0, "degrees") * kRadiansPerDegree;
  result.source_scale.median_intensity = values[kMedianIntensity].number();
  result.source_scale.about_axis = values.has(kAboutAxis) && values[kAboutAxis].truth();
}

void readDiagnosis(const JsonNode& part, CalibrationResult& result) {
  if (part.has("scan_angle_curve")) {
    for (const JsonNode& node : part["scan_angle_curve"].items())
      result.scan_angle_curve.push_back(
          {node["angle_deg"].within(90.0, "degrees") * kRadiansPerDegree,
           node["error_arcsec"].number() * kRadiansPerArcsec,
           node["std_arcsec"].number() * kRadiansPerArcsec});
  }
  if (!part.has("diagnosis")) return;
  for (const JsonNode& node : part["diagnosis"].items()) {
    ErrorFinding f;
    f.source = node["source"].text();
    f.title = node["title"].text();
    f.probability = node["probability"].numberOrNan();
    f.value = node["value"].numberOrNan();
    f.std = node["std"].numberOrNan();
    f.unit = node["unit"].text();
    f.effect = node["effect_m"].numberOrNan();
    f.determined = node["determined"].truth();
    f.corrected = node["corrected"].truth();
    f.evidence = node["evidence"].text();
    f.hint = node["remedy"].text();
    result.diagnosis.push_back(std::move(f));
  }
}

}  // namespace pcl_als::detail
