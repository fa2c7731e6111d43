// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/report/plan_report.h>

#include "json_number.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

void lineTable(const FlightPlanResult& result, std::ostream& out) {
  out << "| line       | height m | course deg | length m | time s | swath m | per m2 |\n"
      << "|------------|----------|------------|----------|--------|---------|--------|\n"
      << std::fixed;
  for (const StripGeometry& line : result.lines) {
    out << "| " << std::left << std::setw(10) << line.id << std::right << std::setprecision(0)
        << " | " << std::setw(8) << line.height << " | " << std::setw(10)
        << line.course() / kRadiansPerDegree << " | " << std::setw(8) << line.length() << " | "
        << std::setw(6) << line.duration() << " | " << std::setw(7) << 2.0 * line.halfSwath()
        << " | " << std::setprecision(2) << std::setw(6) << line.density << " |\n";
  }
}

void parameterTable(const FlightPlanResult& result, std::ostream& out) {
  out << "\nStandard deviations to expect\n\n"
      << "| parameter          |          std | unit   | status         |\n"
      << "|--------------------|--------------|--------|----------------|\n";
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result.expected[info.parameter];
    out << "| " << std::left << std::setw(18) << info.name << std::right << " | ";
    if (estimate.status == ParameterStatus::estimated) {
      const int digits = tableDecimals(info.parameter);
      out << std::setprecision(digits) << std::setw(12) << estimate.std / info.internal_per_unit;
    } else {
      out << "           -";
    }
    out << " | " << std::left << std::setw(6) << info.unit << " | " << std::setw(14)
        << toString(estimate.status) << std::right << " |\n";
  }
}

Json lineJson(const StripGeometry& line) {
  return Json{{"id", line.id},
              {"start_m", {line.start.x(), line.start.y()}},
              {"end_m", {line.end.x(), line.end.y()}},
              {"height_m", line.height},
              {"course_deg", line.course() / kRadiansPerDegree},
              {"length_m", line.length()},
              {"duration_s", line.duration()},
              {"speed_m_s", line.speed},
              {"field_of_view_deg", 2.0 * line.half_angle / kRadiansPerDegree},
              {"density_per_m2", line.density}};
}

Json parametersJson(const CalibrationResult& result) {
  Json parameters = Json::object();
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result[info.parameter];
    const bool estimated = estimate.status == ParameterStatus::estimated;
    Json entry;
    entry["std"] = estimated ? number(estimate.std / info.internal_per_unit) : Json(nullptr);
    entry["unit"] = info.unit;
    entry["status"] = toString(estimate.status);
    if (!estimate.reason.empty()) entry["reason"] = estimate.reason;
    parameters[std::string(info.name)] = std::move(entry);
  }
  return parameters;
}

Json deviationsJson(const SystemVector& std) {
  Json json = Json::object();
  for (const SystemParameterInfo& info : systemParameters()) {
    const double value = std[indexOf(info.parameter)];
    if (std::isfinite(value)) json[std::string(info.name)] = value / info.internal_per_unit;
  }
  return json;
}

Json adviceJson(const Advice& advice) {
  Json json{{"text", advice.text}, {"benefit", number(advice.benefit)}};
  if (advice.is_line) json["line"] = lineJson(advice.line);
  if (!advice.is_line) {
    json["control_m"] = Json::array();
    for (const Eigen::Vector2d& place : advice.control) {
      json["control_m"].push_back({place.x(), place.y()});
    }
  }
  json["std_before"] = deviationsJson(advice.before);
  json["std_after"] = deviationsJson(advice.after);
  return json;
}

Json observabilityJson(const ObservabilityReport& report) {
  Json json;
  json["block"] = report.facts;
  json["weak"] = Json::array();
  for (const WeakCombination& weak : report.weak) {
    Json names = Json::array();
    for (const SystemParameter p : weak.parameters) names.push_back(infoOf(p).name);
    json["weak"].push_back(Json{{"parameters", std::move(names)},
                                {"correlation", number(weak.correlation)},
                                {"cause", weak.cause},
                                {"text", weak.text}});
  }
  json["directions"] = Json::array();
  for (const ParameterDirection& direction : report.directions) {
    json["directions"].push_back(
        Json{{"std_on_ground_m", number(direction.std)}, {"text", direction.text}});
  }
  json["advice"] = Json::array();
  for (const Advice& advice : report.advice) json["advice"].push_back(adviceJson(advice));
  if (const Advice* cheapest = report.cheapestLine()) json["cheapest_line"] = adviceJson(*cheapest);
  return json;
}

Json correlationJson(const CalibrationResult& result) {
  Json order = Json::array(), matrix = Json::array();
  for (const SystemParameter p : result.correlation_order) order.push_back(infoOf(p).name);
  for (Eigen::Index r = 0; r < result.correlation.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < result.correlation.cols(); ++c) {
      row.push_back(number(result.correlation(r, c)));
    }
    matrix.push_back(std::move(row));
  }
  return Json{{"order", std::move(order)}, {"matrix", std::move(matrix)}};
}

}  // namespace

std::string planTables(const FlightPlanResult& result) {
  std::ostringstream out;
  lineTable(result, out);
  parameterTable(result, out);
  for (const Warning& warning : result.expected.warnings) out << "\nwarning: " << warning.text;
  out << (result.expected.warnings.empty() ? "\n" : "\n\n");
  for (const std::string& text : result.observability.text()) out << text << '\n';
  if (const Advice* cheapest = result.observability.cheapestLine()) {
    out << "most for its flying time: " << cheapest->what << '\n';
  }
  return out.str();
}

std::string planJson(const FlightPlanResult& result, const std::vector<std::string>& inputs) {
  Json root;
  root["format"] = "pcl_als plan";
  root["version"] = 1;
  root["determined"] = result.expected.converged;
  root["parameters"] = parametersJson(result.expected);
  root["correlation"] = correlationJson(result.expected);
  root["lines"] = Json::array();
  for (const StripGeometry& line : result.lines) root["lines"].push_back(lineJson(line));
  root["pairs"] = Json::array();
  for (const auto& overlap : result.overlaps) {
    root["pairs"].push_back(Json{{"a", overlap.a},
                                 {"b", overlap.b},
                                 {"areas", overlap.areas},
                                 {"correspondences", std::llround(overlap.pairs)}});
  }
  root["control_points"] = result.control_points;
  root["observability"] = observabilityJson(result.observability);
  root["warnings"] = textsOf(result.expected.warnings);
  root["inputs"] = inputs;
  root["tool_version"] = PCL_ALS_VERSION;
  return root.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void writePlan(const std::filesystem::path& path, const FlightPlanResult& result,
               const std::vector<std::string>& inputs) {
  writeFile(path, planJson(result, inputs));
}

std::string notDetermined(const CalibrationResult& expected) {
  std::string why;
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = expected[info.parameter];
    if (estimate.status != ParameterStatus::not_estimable) continue;
    why += (why.empty() ? "" : "; ") + std::string(info.name) + " will not be determined (" +
           estimate.reason + ")";
  }
  return why;
}

}  // namespace pcl_als
