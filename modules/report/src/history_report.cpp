// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/report/history_report.h>

#include "formatted.h"
#include "json_number.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kMostFromZero = 3.0, kLeastFromZero = 5.0;  // standard deviations

/// The segments before and after a step.
std::pair<const ParameterSegment*, const ParameterSegment*> around(
    const CalibrationHistory& history, const ParameterChange& step) {
  const std::vector<ParameterSegment>& segments = history[step.parameter].segments;
  for (std::size_t i = 1; i < segments.size(); ++i)
    if (segments[i].first == step.first_after) return {&segments[i - 1], &segments[i]};
  return {nullptr, nullptr};
}

/// What steps between the same missions have in common.
std::string causeOf(const CalibrationHistory& history,
                    const std::vector<const ParameterChange*>& steps) {
  const auto became_zero = [&](const ParameterChange* step) {
    const auto [before, after] = around(history, *step);
    return before != nullptr && std::abs(before->bias) > kLeastFromZero * before->std &&
           std::abs(after->bias) < kMostFromZero * after->std;
  };
  if (std::all_of(steps.begin(), steps.end(), became_zero))
    return "After " + history.label(steps.front()->last_before) +
           " the bias is zero within its standard deviation: an earlier calibration was probably "
           "entered into the processing software.";
  if (steps.size() > 1)
    return counted(steps.size(), "parameter") + " changed between " +
           history.label(steps.front()->last_before) + " and " +
           history.label(steps.front()->first_after) +
           ": the scanner was probably mounted anew, or other mounting values were entered.";
  return {};
}

std::string parameterLine(const CalibrationHistory& history, const SystemParameterInfo& info) {
  const ParameterHistory& parameter = history[info.parameter];
  const int p = indexOf(info.parameter);
  const double unit = info.internal_per_unit;
  if (parameter.missions == 0) return formatted("  %-18s not determined\n", info.name.data());
  const double std = std::sqrt(history.covariance(p, p)), change = parameter.change_std;
  const int digits = tableDecimals(info.parameter);
  return formatted("  %-18s %11.*f %10.*f %10.*f %10.*f  %-6s %6zu  %s\n", info.name.data(), digits,
                   history.value[p] / unit, digits, std / unit, digits,
                   std::hypot(std, change) / unit, digits, change / unit, info.unit.data(),
                   parameter.missions,
                   parameter.missions < 2 ? "-"
                   : parameter.constant   ? "yes"
                                          : "no");
}

Json parameterJson(const CalibrationHistory& history, const SystemParameterInfo& info) {
  const ParameterHistory& parameter = history[info.parameter];
  const double unit = info.internal_per_unit;
  Json json = {{"missions", parameter.missions},       {"unit", info.unit},
               {"chi_squared", parameter.chi_squared}, {"p_value", parameter.p_value},
               {"constant", parameter.constant},       {"segments", Json::array()}};
  for (const ParameterSegment& segment : parameter.segments)
    json["segments"].push_back({{"first", history.missions[segment.first].name},
                                {"last", history.missions[segment.last].name},
                                {"bias", segment.bias / unit},
                                {"std", segment.std / unit}});
  return json;
}

Json changeJson(const CalibrationHistory& history, const ParameterChange& change) {
  const SystemParameterInfo& info = infoOf(change.parameter);
  Json json = {{"kind", toString(change.kind)},
               {"parameter", info.name},
               {"last_before", history.missions[change.last_before].name},
               {"first_after", history.missions[change.first_after].name},
               {"size", change.size / info.internal_per_unit},
               {"std", change.std / info.internal_per_unit},
               {"unit", info.unit},
               {"p_value", change.p_value},
               {"position_probability", change.position_probability},
               {"probability", change.probability},
               {"text", changeText(history, change)}};
  if (!change.covariate.empty()) json["per"] = change.covariate;
  return json;
}

Json missionJson(const CalibrationHistory& history, std::size_t m) {
  const CalibrationMission& mission = history.missions[m];
  const MissionAgreement& agreement = history.agreement[m];
  Json json = {{"calibration", mission.name}};
  if (mission.day) json["date"] = dateText(*mission.day);
  for (const auto& [name, value] : mission.covariates) json["covariates"][name] = value;
  Json& parameters = json["parameters"] = Json::object();
  for (const SystemParameterInfo& info : systemParameters()) {
    if (!mission.determines(info.parameter)) continue;
    const int p = indexOf(info.parameter);
    parameters[std::string(info.name)] = {
        {"bias", number(mission.bias[p] / info.internal_per_unit)},
        {"std", number(mission.std[p] / info.internal_per_unit)}};
  }
  json["agreement"] = {{"chi_squared", agreement.chi_squared},
                       {"degrees_of_freedom", agreement.freedom},
                       {"p_value", agreement.p_value},
                       {"agrees", agreement.agrees}};
  return json;
}

}  // namespace

std::vector<std::string> historyFindings(const CalibrationHistory& history) {
  std::vector<std::string> findings;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<const ParameterChange*>> steps;
  for (const ParameterChange& change : history.changes) {
    findings.push_back(changeText(history, change) + ".");
    if (change.kind == ChangeKind::step)
      steps[{change.last_before, change.first_after}].push_back(&change);
  }
  for (const auto& [position, together] : steps) {
    const std::string cause = causeOf(history, together);
    if (!cause.empty()) findings.push_back(cause);
  }
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterHistory& parameter = history[info.parameter];
    const auto is_own = [&](const ParameterChange& c) { return c.parameter == info.parameter; };
    if (parameter.constant || std::any_of(history.changes.begin(), history.changes.end(), is_own))
      continue;
    findings.push_back(std::string(info.name) +
                       " varies between missions by more than its standard deviations: " +
                       significantText(parameter.change_std / info.internal_per_unit, 2) +
                       unitSuffix(info.parameter) + " (standard deviation).");
  }
  for (std::size_t m = 0; m < history.missions.size(); ++m) {
    const MissionAgreement& agreement = history.agreement[m];
    if (agreement.agrees) continue;
    findings.push_back(history.missions[m].name + " does not fit the others: " +
                       std::string(infoOf(agreement.largest).name) + " by " +
                       numberText(std::abs(agreement.deviation), 1) + " standard deviations.");
  }
  return findings;
}

std::string historyText(const HistoryReport& report) {
  const CalibrationHistory& history = report.history;
  std::string text = "History of " + counted(history.missions.size(), "calibration");
  if (history.dated)
    text += ", " + history.label(0) + " to " + history.label(history.missions.size() - 1);
  text +=
      "\n\n  parameter          value now        std   next one     change  unit   missions  "
      "constant\n";
  for (const SystemParameterInfo& info : systemParameters()) text += parameterLine(history, info);
  text +=
      "  std: of the value; next one: of the bias of the next flight; change: from flight to "
      "flight\n";
  const std::vector<std::string> findings = historyFindings(history);
  if (!findings.empty()) text += '\n';
  for (const std::string& finding : findings) text += "  " + finding + "\n";
  for (const std::string& excluded : report.excluded) text += "  " + excluded + "\n";
  return text;
}

std::string historyJson(const HistoryReport& report) {
  const CalibrationHistory& history = report.history;
  Json json;
  json["format"] = "pcl_als history";
  json["version"] = 1;
  json["tool_version"] = PCL_ALS_VERSION;
  json["instrument"] = Json::parse(calibrationJson(report.instrument))["instrument"];
  Json& change = json["change_std"] = Json::object();
  Json& parameters = json["parameters"] = Json::object();
  for (const SystemParameterInfo& info : systemParameters()) {
    if (!history.knows(info.parameter)) continue;
    const std::string name(info.name);
    // A zero from fewer missions is no estimate.
    const ParameterHistory& parameter = history[info.parameter];
    if (parameter.change_std > 0.0 || parameter.missions >= CalibrationHistory::kFewestForChange)
      change[name] = parameter.change_std / info.internal_per_unit;
    parameters[name] = parameterJson(history, info);
  }
  json["changes"] = Json::array();
  for (const ParameterChange& found : history.changes)
    json["changes"].push_back(changeJson(history, found));
  json["missions"] = Json::array();
  for (std::size_t m = 0; m < history.missions.size(); ++m)
    json["missions"].push_back(missionJson(history, m));
  json["findings"] = historyFindings(history);
  json["excluded"] = report.excluded;
  return json.dump(1) + "\n";
}

void writeHistory(const std::filesystem::path& path, const HistoryReport& report) {
  writeFile(path, historyJson(report));
}

}  // namespace pcl_als
