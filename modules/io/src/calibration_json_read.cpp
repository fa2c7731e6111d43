// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/io/survey_io.h>

#include "calibration_json.h"
#include "diagnosis_json.h"
#include "json_node.h"
#include "json_parse.h"
#include "large_corrections_json.h"
#include "prior_json.h"
#include "strip_errors_json.h"

namespace pcl_als {
namespace detail {
namespace {

using Node = JsonNode;

std::vector<std::string> textsOf(const Node& list) {
  std::vector<std::string> texts;
  for (const Node& node : list.items()) texts.push_back(node.text());
  return texts;
}

ParameterStatus statusOf(const Node& node) {
  const std::string text = node.text();
  for (const auto status :
       {ParameterStatus::estimated, ParameterStatus::fixed, ParameterStatus::not_estimable}) {
    if (text == toString(status)) return status;
  }
  node.refuse("is '" + printable(text, kLongestQuotation) +
              "'; it must be estimated, fixed or not_estimable");
}

/// The model by its name, and the source of the attitude where the file says it.
AttitudeSource attitudeOf(const Node& root) {
  AttitudeSource attitude = AttitudeSource::none;
  if (root.has("model")) {
    const std::string model = root["model"].text();
    if (model == modelName(AttitudeSource::trajectory)) {
      attitude = AttitudeSource::trajectory;
    } else if (model != modelName(AttitudeSource::none)) {
      root["model"].refuse("is '" + printable(model, kLongestQuotation) +
                           "'; it must be quasi_rigorous or rigorous");
    }
  }
  if (!root.has("attitude")) return attitude;
  const Node node = root["attitude"];
  const std::string text = node.text();
  for (const auto source : {AttitudeSource::none, AttitudeSource::points,
                            AttitudeSource::trajectory, AttitudeSource::nominal}) {
    if (text == toString(source) && modelName(source) == modelName(attitude)) return source;
  }
  node.refuse("is '" + printable(text, kLongestQuotation) +
              "'; it must be none or points (quasi_rigorous), trajectory or nominal (rigorous)");
}

void readParameters(const Node& parameters,
                    std::array<ParameterEstimate, kSystemParameterCount>& estimates) {
  for (const SystemParameterInfo& info : systemParameters()) {
    const Node node = parameters[std::string(info.name)];
    ParameterEstimate& estimate = estimates[static_cast<std::size_t>(indexOf(info.parameter))];
    const std::string unit = node["unit"].text();
    if (unit != info.unit) {
      node["unit"].refuse("is '" + printable(unit, kLongestQuotation) + "'; it must be '" +
                          std::string(info.unit) + "'");
    }
    estimate.bias = node["bias"].number() * info.internal_per_unit;
    const std::string refused = refusedBias(info.parameter, estimate.bias);
    if (!refused.empty()) node["bias"].refuse("is out of range: " + refused);
    if (node.has("std")) estimate.std = node["std"].numberOrNan() * info.internal_per_unit;
    if (node.has("std_formal")) {
      estimate.std_formal = node["std_formal"].numberOrNan() * info.internal_per_unit;
    }
    if (node.has("status")) estimate.status = statusOf(node["status"]);
    if (node.has("prior_share")) estimate.prior_share = node["prior_share"].numberOrNan();
    if (node.has("determined")) estimate.determined = node["determined"].truth();
    if (node.has("reason")) estimate.reason = node["reason"].text();
  }
}

void readCorrelation(const Node& correlation, CalibrationResult& result) {
  result.correlation_order = parametersNamed(correlation["order"]);
  const std::vector<Node> rows = correlation["matrix"].items();
  const auto size = static_cast<Eigen::Index>(rows.size());
  if (rows.size() != result.correlation_order.size()) {
    correlation["matrix"].refuse("must have one row for each name of 'correlation.order'");
  }
  result.correlation.resize(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const std::vector<Node> values = rows[static_cast<std::size_t>(i)].items();
    if (values.size() != rows.size()) rows[static_cast<std::size_t>(i)].refuse("must be as long");
    for (Eigen::Index k = 0; k < size; ++k) {
      result.correlation(i, k) = values[static_cast<std::size_t>(k)].numberOrNan();
    }
  }
}

void readIterations(const Node& iterations, CalibrationResult& result) {
  for (const Node& node : iterations.items()) {
    result.iterations.push_back({node["correspondences"].count(), node["sigma0"].numberOrNan(),
                                 node["largest_update"].numberOrNan()});
  }
}

void readPairs(const Node& pairs, CalibrationResult& result) {
  for (const Node& node : pairs.items()) {
    PairFit pair;
    pair.a = node["a"].text();
    pair.b = node["b"].text();
    pair.correspondences = node["correspondences"].count();
    pair.rms_before = node["rms_before_m"].numberOrNan();
    pair.rms_after = node["rms_after_m"].numberOrNan();
    pair.mean_before = node["mean_before_m"].numberOrNan();
    pair.mean_after = node["mean_after_m"].numberOrNan();
    if (node.has("rms_strip_corrections_m")) {
      pair.rms_strips = node["rms_strip_corrections_m"].numberOrNan();
      pair.mean_strips = node["mean_strip_corrections_m"].numberOrNan();
    }
    result.pairs.push_back(std::move(pair));
  }
}

void readResiduals(const Node& residuals, ResidualHistogram& histogram) {
  for (const Node& edge : residuals["edges_m"].items()) histogram.edges.push_back(edge.number());
  for (const Node& count : residuals["before"].items()) histogram.before.push_back(count.count());
  for (const Node& count : residuals["after"].items()) histogram.after.push_back(count.count());
  if (histogram.before.size() + 1 != histogram.edges.size() ||
      histogram.after.size() != histogram.before.size()) {
    residuals.refuse("must have one count before and after for each bin between 'edges_m'");
  }
}

/// Files of versions that gave no verdict have one by whether the adjustment converged; a file made
/// by hand, with neither, is usable.
CalibrationVerdict verdictOf(const Node& instrument, const Node& report) {
  CalibrationVerdict verdict;
  if (instrument.has("verdict")) {
    const Node status = instrument["verdict"]["status"];
    const auto known = calibrationStatusNamed(status.text());
    if (!known) {
      status.refuse("is '" + status.text() +
                    "'; it must be usable, parameters_affected, no_improvement, not_determined or "
                    "not_converged");
    }
    verdict.status = *known;
    verdict.reason = instrument["verdict"]["reason"].text();
  } else if (report.has("converged") && !report["converged"].truth()) {
    verdict.downgrade(CalibrationStatus::not_converged, "the adjustment did not converge");
  }
  return verdict;
}

MisfitChange misfitOf(const Node& node) {
  MisfitChange misfit;
  misfit.points = node["points"].count();
  misfit.areas = node["areas"].count();
  misfit.rms_before = node["rms_before_m"].numberOrNan();
  misfit.rms_after = node["rms_after_m"].numberOrNan();
  misfit.limit = node["limit_m"].numberOrNan();
  misfit.change_std = node["change_std_m"].numberOrNan();
  return misfit;
}

void readControlFits(const Node& control, CalibrationResult& result) {
  for (const Node& node : control.items()) {
    ControlFit fit;
    fit.strip = node["strip"].text();
    fit.points = node["points"].count();
    fit.mean_before = node["mean_before_m"].numberOrNan();
    fit.rms_before = node["rms_before_m"].numberOrNan();
    fit.mean_after = node["mean_after_m"].numberOrNan();
    fit.rms_after = node["rms_after_m"].numberOrNan();
    result.control.push_back(std::move(fit));
  }
}

void readControlPoints(const Node& points, CalibrationResult& result) {
  for (const Node& node : points.items()) {
    ControlPointFit fit;
    fit.id = node["id"].text();
    if (node.has("component")) fit.component = node["component"].text();
    fit.strips = node["strips"].count();
    fit.sigma = node["sigma_m"].numberOrNan();
    fit.before = node["before_m"].numberOrNan();
    fit.after = node["after_m"].numberOrNan();
    fit.expected_std = node["expected_std_m"].numberOrNan();
    fit.used = node["used"].truth();
    result.control_points.push_back(std::move(fit));
  }
}

void readHeld(const Node& held, CalibrationResult& result) {
  for (const Node& node : held.items()) {
    FixedSurface& surface = result.held.emplace_back();
    surface.name = node["name"].text();
    surface.strips = textsOf(node["strips"]);
    surface.std = node["std_m"].numberOrNan();
    surface.offset_prior = node["offset_prior_m"].numberOrNan();
    surface.correspondences = node["correspondences"].count();
    surface.mean_before = node["mean_before_m"].numberOrNan();
    surface.rms_before = node["rms_before_m"].numberOrNan();
    surface.mean_after = node["mean_after_m"].numberOrNan();
    surface.rms_after = node["rms_after_m"].numberOrNan();
    surface.offset = node["offset_m"].numberOrNan();
    surface.offset_std = node["offset_std_m"].numberOrNan();
    surface.offset_determined = node["offset_determined"].truth();
  }
}

void readStripOffsets(const Node& strips, CalibrationResult& result) {
  for (const Node& node : strips.items()) {
    result.strip_offsets.push_back({node["strip"].text(), node["offset_m"].numberOrNan(),
                                    node["expected_std_m"].numberOrNan(),
                                    node["consistent"].truth()});
  }
}

void readScanPlanes(const Node& node, CalibrationResult& result) {
  for (const Node& plane : node.items()) {
    const std::vector<Node> values = plane.items();
    if (values.size() != 3) plane.refuse("must have three numbers, the normal of a scan plane");
    const Eigen::Vector3d normal(values[0].number(), values[1].number(), values[2].number());
    if (!(std::abs(normal.norm() - 1.0) < 1e-6)) plane.refuse("must have a length of one");
    result.scan_planes.push_back(normal);
  }
}

void readRecoveredAttitude(const Node& passes, CalibrationResult& result) {
  constexpr double kRightAngle = 324000.0;  // arc-seconds
  for (const Node& node : passes.items()) {
    const std::vector<Node> times = node["times"].items(), pitch = node["pitch_arcsec"].items(),
                            crab = node["crab_arcsec"].items();
    if (times.empty() || times.size() != pitch.size() || times.size() != crab.size()) {
      node.refuse("must have as many times as pitch_arcsec and crab_arcsec, one at least");
    }
    RecoveredAttitude::Pass pass(times.size());
    for (std::size_t i = 0; i < pass.size(); ++i) {
      pass[i].time = times[i].number();
      pass[i].angles = {pitch[i].within(kRightAngle, "arcsec") * kRadiansPerArcsec,
                        crab[i].within(kRightAngle, "arcsec") * kRadiansPerArcsec};
      if (i > 0 && !(pass[i].time > pass[i - 1].time)) times[i].refuse("must be later");
    }
    result.recovered_attitude.addPass(std::move(pass));
  }
}

Eigen::Vector3d vectorOf(const Node& node) {
  const std::vector<Node> items = node.items();
  if (items.size() != 3) node.refuse("must have three numbers");
  return {items[0].numberOrNan(), items[1].numberOrNan(), items[2].numberOrNan()};
}

void readSystems(const Node& systems, CalibrationResult& result) {
  constexpr std::size_t kMaximumChannel = 255;
  constexpr double kLargestOffset = 100.0;  // metres
  for (const Node& node : systems.items()) {
    SystemEstimate& system = result.systems.emplace_back();
    system.group.name = node["name"].text();
    system.group.strips = textsOf(node["strips"]);
    readParameters(node["parameters"], system.parameters);
    for (const SystemParameterInfo& info : systemParameters()) {
      const Node differences = node["difference_std"];
      const std::string name(info.name);
      if (differences.has(name.c_str()))
        system.difference_std[indexOf(info.parameter)] =
            differences[name].numberOrNan() * info.internal_per_unit;
    }
    system.offset = vectorOf(node["offset_m"]);
    if (!(system.offset.cwiseAbs().maxCoeff() < kLargestOffset))
      node["offset_m"].refuse("must be numbers of less than 100 m");
    system.offset_std = vectorOf(node["offset_std_m"]);
  }
  if (result.systems.size() > kMaximumChannel) systems.refuse("must be at most 255");
}

/// The version of a file that can be read.
long versionOf(const Node& root, const std::string& name) {
  if (!root.has("format") || root["format"].text() != kCalibrationFormat) {
    throw InputError(name + ": 'format' is not '" + std::string(kCalibrationFormat) +
                     "'; not a calibration file");
  }
  const long version = root["version"].whole();
  if (version < 1 || version > kCalibrationVersion)
    root["version"].refuse("is " + std::to_string(version) +
                           "; this version of pcl_als reads 1 to " +
                           std::to_string(kCalibrationVersion));
  return version;
}

double lineFitOf(const Node& node) {
  constexpr double kLongestWindow = 60.0;  // seconds, half of it; the tools' limit of -line_fit
  const double width = node.number();
  if (width < 0.0) node.refuse("must not be negative");
  if (width > kLongestWindow)
    node.refuse("must not exceed 60 seconds: the flight is taken as straight within it");
  return width;
}

/// Applying a calibration takes the parameters only: a part made by hand may have no more.
void readInstrument(const Node& part, CalibrationResult& result) {
  if (part.has("system_name")) result.system_name = part["system_name"].text();
  readParameters(part["parameters"], result.parameters);
  if (part.has("systems")) readSystems(part["systems"], result);
  if (part.has("channel_field")) result.channel_field = part["channel_field"].text();
  result.attitude = attitudeOf(part);
  readErrorSources(part, result);
  if (part.has("correlation")) readCorrelation(part["correlation"], result);
  readPrior(part, result);
  if (part.has("line_fit_half_width_s"))
    result.line_fit_half_width = lineFitOf(part["line_fit_half_width_s"]);
  if (part.has("scan_planes")) readScanPlanes(part["scan_planes"], result);
  readErrorLevels(part, result);
}

void loadTrajectory(const Node& part, CalibrationResult& result) {
  if (part.has("date")) {
    result.day = daysOfGps(part["date"].text(), "ymd");
    if (!result.day) part["date"].refuse("is no date such as 2026-05-04");
  }
  readStripErrors(part, result);
  readLargeCorrections(part, result);
  if (part.has("recovered_attitude")) readRecoveredAttitude(part["recovered_attitude"], result);
  if (part.has("held")) readHeld(part["held"], result);
}

void readReport(const Node& part, CalibrationResult& result) {
  if (part.has("sigma0")) result.sigma0 = part["sigma0"].numberOrNan();
  if (part.has("redundancy")) result.redundancy = part["redundancy"].whole();
  if (part.has("converged")) result.converged = part["converged"].truth();
  if (part.has("iterations")) readIterations(part["iterations"], result);
  if (part.has("pairs")) readPairs(part["pairs"], result);
  if (part.has("misfit")) result.misfit = misfitOf(part["misfit"]);
  if (part.has("residuals")) readResiduals(part["residuals"], result.residuals);
  if (part.has("control")) readControlFits(part["control"], result);
  if (part.has("control_points")) readControlPoints(part["control_points"], result);
  if (part.has("strip_offsets")) readStripOffsets(part["strip_offsets"], result);
  readDiagnosis(part, result);
  if (part.has("observability")) result.observability = textsOf(part["observability"]);
  if (!part.has("warnings")) return;
  for (const std::string& text : textsOf(part["warnings"])) result.warnings.emplace_back(text);
}

}  // namespace

CalibrationResult instrumentIn(const JsonNode& part) {
  CalibrationResult result;
  readInstrument(part, result);
  result.verdict = verdictOf(part, part);
  return result;
}

CalibrationResult calibrationFromJson(const std::string& text, const std::string& name) {
  const nlohmann::json json = parseJson(text, name);
  const Node root(json, name);
  const bool in_parts = versionOf(root, name) > 1;
  const nlohmann::json absent = nlohmann::json::object();
  const auto part = [&](const char* key) {
    if (!in_parts) return root;
    return root.has(key) ? root[key] : Node(absent, name, key);
  };
  const Node instrument = part("instrument"), report = part("report");
  CalibrationResult result;
  readInstrument(instrument, result);
  result.verdict = verdictOf(instrument, report);
  loadTrajectory(part("flight"), result);
  readReport(report, result);
  if (root.has("crs")) result.crs = root["crs"].text();
  if (root.has("inputs")) result.inputs = textsOf(root["inputs"]);
  return result;
}

}  // namespace detail

CalibrationResult parseCalibration(const std::string& text, const std::string& name) {
  return detail::calibrationFromJson(text, name);
}

CalibrationResult readCalibration(const std::filesystem::path& path) {
  return detail::calibrationFromJson(readWholeFile(path, kJsonLimits), path.string());
}

}  // namespace pcl_als
