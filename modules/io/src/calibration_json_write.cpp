// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/applied_correction.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/io/survey_io.h>

#include "calibration_json.h"
#include "diagnosis_json.h"
#include "json_number.h"
#include "large_corrections_json.h"
#include "prior_json.h"
#include "strip_errors_json.h"

namespace pcl_als {
namespace detail {
namespace {

// Keys stay in the order of the schema. Numbers are written with the fewest digits (at most 17)
// that read back to the same double.
using Json = nlohmann::ordered_json;

using Parameters = std::array<ParameterEstimate, kSystemParameterCount>;

Json parametersOf(const Parameters& estimates) {
  Json parameters = Json::object();
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate =
        estimates[static_cast<std::size_t>(indexOf(info.parameter))];
    if (!std::isfinite(estimate.bias)) {
      throw UsageError("calibration: the bias of " + std::string(info.name) +
                       " is not a finite number and cannot be written");
    }
    Json entry;
    entry["bias"] = number(estimate.bias / info.internal_per_unit);
    entry["std"] = number(estimate.std / info.internal_per_unit);
    entry["std_formal"] = number(estimate.std_formal / info.internal_per_unit);
    entry["unit"] = info.unit;
    entry["status"] = toString(estimate.status);
    if (estimate.prior_share > 0.0) entry["prior_share"] = number(estimate.prior_share);
    if (!estimate.determined) entry["determined"] = false;
    if (!estimate.reason.empty()) entry["reason"] = estimate.reason;
    parameters[std::string(info.name)] = std::move(entry);
  }
  return parameters;
}

Json systemsOf(const CalibrationResult& result) {
  Json systems = Json::array();
  for (const SystemEstimate& system : result.systems) {
    Json entry;
    entry["name"] = system.group.name;
    entry["strips"] = system.group.strips;
    entry["parameters"] = parametersOf(system.parameters);
    Json& differences = entry["difference_std"] = Json::object();
    for (const SystemParameterInfo& info : systemParameters()) {
      const double std = system.difference_std[indexOf(info.parameter)];
      if (std > 0.0) differences[std::string(info.name)] = number(std / info.internal_per_unit);
    }
    for (const auto& [key, vector] :
         {std::pair("offset_m", system.offset), std::pair("offset_std_m", system.offset_std)}) {
      entry[key] = Json::array();
      for (const double value : vector) entry[key].push_back(number(value));
    }
    systems.push_back(std::move(entry));
  }
  return systems;
}

Json correlationOf(const CalibrationResult& result) {
  Json order = Json::array(), matrix = Json::array();
  for (const SystemParameter parameter : result.correlation_order) {
    order.push_back(infoOf(parameter).name);
  }
  for (Eigen::Index row = 0; row < result.correlation.rows(); ++row) {
    Json values = Json::array();
    for (Eigen::Index column = 0; column < result.correlation.cols(); ++column) {
      values.push_back(number(result.correlation(row, column)));
    }
    matrix.push_back(std::move(values));
  }
  return Json{{"order", std::move(order)}, {"matrix", std::move(matrix)}};
}

Json iterationsOf(const CalibrationResult& result) {
  Json iterations = Json::array();
  for (const CalibrationIteration& iteration : result.iterations) {
    iterations.push_back(Json{{"correspondences", iteration.correspondences},
                              {"sigma0", number(iteration.sigma0)},
                              {"largest_update", number(iteration.largest_update)}});
  }
  return iterations;
}

Json pairsOf(const CalibrationResult& result) {
  Json pairs = Json::array();
  for (const PairFit& pair : result.pairs) {
    pairs.push_back(Json{{"a", pair.a},
                         {"b", pair.b},
                         {"correspondences", pair.correspondences},
                         {"rms_before_m", number(pair.rms_before)},
                         {"rms_after_m", number(pair.rms_after)},
                         {"mean_before_m", number(pair.mean_before)},
                         {"mean_after_m", number(pair.mean_after)},
                         {"rms_strip_corrections_m", number(pair.rms_strips)},
                         {"mean_strip_corrections_m", number(pair.mean_strips)}});
  }
  return pairs;
}

Json histogramOf(const ResidualHistogram& histogram) {
  return Json{
      {"edges_m", histogram.edges}, {"before", histogram.before}, {"after", histogram.after}};
}

Json scanPlanesOf(const ScanPlanes& planes) {
  Json normals = Json::array();
  for (const Eigen::Vector3d& normal : planes)
    normals.push_back({normal.x(), normal.y(), normal.z()});
  return normals;
}

/// Lists by column: a knot of a long flight takes a fifth of what an object with names would.
Json recoveredAttitudeOf(const CalibrationResult& result) {
  Json passes = Json::array();
  for (const RecoveredAttitude::Pass& pass : result.recovered_attitude.passes()) {
    Json times = Json::array(), pitch = Json::array(), crab = Json::array();
    for (const RecoveredAttitude::Knot& knot : pass) {
      times.push_back(knot.time);
      pitch.push_back(knot.angles.pitch / kRadiansPerArcsec);
      crab.push_back(knot.angles.crab / kRadiansPerArcsec);
    }
    passes.push_back(Json{{"times", std::move(times)},
                          {"pitch_arcsec", std::move(pitch)},
                          {"crab_arcsec", std::move(crab)}});
  }
  return passes;
}

Json verdictOf(const CalibrationVerdict& verdict) {
  return Json{{"status", toString(verdict.status)}, {"reason", verdict.reason}};
}

Json misfitOf(const MisfitChange& misfit) {
  return Json{{"points", misfit.points},
              {"areas", misfit.areas},
              {"rms_before_m", number(misfit.rms_before)},
              {"rms_after_m", number(misfit.rms_after)},
              {"limit_m", number(misfit.limit)},
              {"change_std_m", number(misfit.change_std)}};
}

Json stripOffsetsOf(const CalibrationResult& result) {
  Json strips = Json::array();
  for (const StripOffset& strip : result.strip_offsets) {
    strips.push_back(Json{{"strip", strip.strip},
                          {"offset_m", number(strip.offset)},
                          {"expected_std_m", number(strip.expected_std)},
                          {"consistent", strip.consistent}});
  }
  return strips;
}

Json heldOf(const CalibrationResult& result) {
  Json held = Json::array();
  for (const FixedSurface& surface : result.held) {
    held.push_back(Json{{"name", surface.name},
                        {"strips", surface.strips},
                        {"std_m", number(surface.std)},
                        {"offset_prior_m", number(surface.offset_prior)},
                        {"correspondences", surface.correspondences},
                        {"mean_before_m", number(surface.mean_before)},
                        {"rms_before_m", number(surface.rms_before)},
                        {"mean_after_m", number(surface.mean_after)},
                        {"rms_after_m", number(surface.rms_after)},
                        {"offset_m", number(surface.offset)},
                        {"offset_std_m", number(surface.offset_std)},
                        {"offset_determined", surface.offset_determined}});
  }
  return held;
}

Json controlPointsOf(const CalibrationResult& result) {
  Json points = Json::array();
  for (const ControlPointFit& fit : result.control_points) {
    points.push_back(Json{{"id", fit.id},
                          {"component", fit.component},
                          {"strips", fit.strips},
                          {"sigma_m", number(fit.sigma)},
                          {"before_m", number(fit.before)},
                          {"after_m", number(fit.after)},
                          {"expected_std_m", number(fit.expected_std)},
                          {"used", fit.used}});
  }
  return points;
}

Json controlOf(const CalibrationResult& result) {
  Json control = Json::array();
  for (const ControlFit& fit : result.control) {
    control.push_back(Json{{"strip", fit.strip},
                           {"points", fit.points},
                           {"mean_before_m", number(fit.mean_before)},
                           {"rms_before_m", number(fit.rms_before)},
                           {"mean_after_m", number(fit.mean_after)},
                           {"rms_after_m", number(fit.rms_after)}});
  }
  return control;
}

Json leftOutOf(const CalibrationResult& result) {
  Json parts = Json::array();
  for (const ExcludedPoints& part : result.excluded) {
    parts.push_back(Json{{"strip", part.strip},
                         {"reason", toString(part.reason)},
                         {"points", part.points},
                         {"of", part.of}});
  }
  return parts;
}

/// What applies to every flight with the instrument.
Json instrumentJson(const CalibrationResult& result) {
  Json part;
  if (!result.system_name.empty()) part["system_name"] = result.system_name;
  part["verdict"] = verdictOf(result.verdict);
  part["model"] = modelName(result.attitude);
  part["attitude"] = toString(result.attitude);
  part["parameters"] = parametersOf(result.parameters);
  if (!result.systems.empty()) part["systems"] = systemsOf(result);
  if (!result.channel_field.empty()) part["channel_field"] = result.channel_field;
  writeErrorSources(result, part);
  part["correlation"] = correlationOf(result);
  writePrior(result, part);
  part["line_fit_half_width_s"] = number(result.line_fit_half_width);
  if (!result.scan_planes.empty()) part["scan_planes"] = scanPlanesOf(result.scan_planes);
  writeErrorLevels(result, part);
  return part;
}

/// What applies to the flight alone that was calibrated with.
Json flightJson(const CalibrationResult& result) {
  Json part;
  if (result.day) part["date"] = dateText(*result.day);
  part["strip_corrections"] = stripErrorsOf(result);
  if (!result.large_corrections.empty()) part["large_corrections"] = largeCorrectionsOf(result);
  if (!result.recovered_attitude.empty()) part["recovered_attitude"] = recoveredAttitudeOf(result);
  if (!result.held.empty()) part["held"] = heldOf(result);
  return part;
}

/// What the calibration found, which applies to no points.
Json reportJson(const CalibrationResult& result) {
  Json part;
  part["sigma0"] = number(result.sigma0);
  part["redundancy"] = result.redundancy;
  part["converged"] = result.converged;
  part["iterations"] = iterationsOf(result);
  part["pairs"] = pairsOf(result);
  part["misfit"] = misfitOf(result.misfit);
  if (!result.residuals.edges.empty()) part["residuals"] = histogramOf(result.residuals);
  part["control"] = controlOf(result);
  part["control_points"] = controlPointsOf(result);
  part["strip_offsets"] = stripOffsetsOf(result);
  writeDiagnosis(result, part);
  part["observability"] = result.observability;
  part["warnings"] = textsOf(result.warnings);
  part["left_out"] = leftOutOf(result);
  return part;
}

}  // namespace

std::string calibrationToJson(const CalibrationResult& result) {
  Json root;
  root["format"] = kCalibrationFormat;
  root["version"] = kCalibrationVersion;
  root["tool_version"] = PCL_ALS_VERSION;
  root["id"] = calibrationId(result);
  if (!result.crs.empty()) root["crs"] = result.crs;
  root["inputs"] = result.inputs;
  root["instrument"] = instrumentJson(result);
  root["flight"] = flightJson(result);
  root["report"] = reportJson(result);
  // A file name may hold bytes that are no UTF-8.
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace detail

std::string calibrationJson(const CalibrationResult& result) {
  return detail::calibrationToJson(result);
}

void writeCalibration(const std::filesystem::path& path, const CalibrationResult& result) {
  writeFile(path, calibrationJson(result));
}

}  // namespace pcl_als
