// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/report/history_report.h>

#include "formatted.h"

namespace pcl_als {
namespace {

using namespace field;

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

/// A parameter, a segment, a change or a mission with the history that it is of.
template <typename Item>
struct OfHistory {
  const CalibrationHistory* history;
  const SystemParameterInfo* info;
  const Item* item;
  double in(double value) const { return value / info->internal_per_unit; }
  const std::string& mission(std::size_t m) const { return history->missions[m].name; }
};

/// Items with the history and their parameter.
template <typename Item, typename InfoOf>
std::vector<OfHistory<Item>> itemsOf(const CalibrationHistory& history,
                                     const std::vector<Item>& items, InfoOf info) {
  std::vector<OfHistory<Item>> all;
  for (const Item& item : items) all.push_back({&history, info(item), &item});
  return all;
}

NamedValues<OfHistory<ParameterHistory>> historyParametersOf(const CalibrationHistory& history) {
  NamedValues<OfHistory<ParameterHistory>> all;
  for (const SystemParameterInfo& info : systemParameters())
    if (history.knows(info.parameter))
      all.push_back({std::string(info.name), {&history, &info, &history[info.parameter]}});
  return all;
}

const Fields<OfHistory<ParameterHistory>>& historyParameterFields() {
  using P = OfHistory<ParameterHistory>;
  using S = OfHistory<ParameterSegment>;
  static const Fields<S> segment(
      "segment", "A value that held over consecutive missions.",
      {{"first", [](const S& s) { return s.mission(s.item->first); }, "First mission"},
       {"last", [](const S& s) { return s.mission(s.item->last); }, "Last mission"},
       {"bias", [](const S& s) { return s.in(s.item->bias); }, "Assumed - true value"},
       {"std", [](const S& s) { return s.in(s.item->std); }, "Standard deviation"}});
  static const Fields<P> fields(
      "parameter_history", "The history of a parameter, in its unit.",
      {{"missions", [](const P& p) { return p.item->missions; }, "Missions that determine it"},
       {"unit", [](const P& p) { return p.info->unit; }, "Unit of its values"},
       {"chi_squared", [](const P& p) { return p.item->chi_squared; }, "Test of constancy"},
       {"p_value", [](const P& p) { return p.item->p_value; }, "Its probability"},
       {"constant", [](const P& p) { return p.item->constant; }, "Whether it is constant"},
       {"segments",
        [](const P& p) {
          return itemsOf(*p.history, p.item->segments, [&p](const auto&) { return p.info; });
        },
        segment, "Its values between steps"}});
  return fields;
}

const Fields<OfHistory<ParameterChange>>& parameterChangeFields() {
  using C = OfHistory<ParameterChange>;
  static const Fields<C> fields(
      "change", "A significant change of a parameter.",
      {{"kind", [](const C& c) { return toString(c.item->kind); }, "What it looks like",
        oneOf({"step", "drift", "outlier"})},
       {"parameter", [](const C& c) { return c.info->name; }, "Name of the parameter"},
       {"last_before", [](const C& c) { return c.mission(c.item->last_before); },
        "Last mission before a step; the outlier; the first of a drift"},
       {"first_after", [](const C& c) { return c.mission(c.item->first_after); },
        "First mission after a step; the outlier; the last of a drift"},
       {"size", [](const C& c) { return c.in(c.item->size); }, "Change, in `unit`"},
       {"std", [](const C& c) { return c.in(c.item->std); }, "Standard deviation"},
       {"unit", [](const C& c) { return c.info->unit; }, "Unit of both"},
       {"p_value", [](const C& c) { return c.item->p_value; }, "Probability without a change"},
       {"position_probability", [](const C& c) { return c.item->position_probability; },
        "Of a step: probability of this place"},
       {"probability", [](const C& c) { return c.item->probability; },
        "Against random changes between missions"},
       {"text", [](const C& c) { return changeText(*c.history, *c.item); }, "As a sentence"},
       {"per", [](const C& c) { return c.item->covariate; }, "Covariate of a drift", unlessEmpty}});
  return fields;
}

/// A value of a parameter in its unit.
struct MissionValue {
  double bias, std;
};

NamedValues<MissionValue> valuesOf(const CalibrationMission& mission) {
  NamedValues<MissionValue> all;
  for (const SystemParameterInfo& info : systemParameters()) {
    if (!mission.determines(info.parameter)) continue;
    const int p = indexOf(info.parameter);
    const double unit = info.internal_per_unit;
    all.push_back({std::string(info.name), {mission.bias[p] / unit, mission.std[p] / unit}});
  }
  return all;
}

/// A mission with its agreement.
struct ListedMission {
  const CalibrationMission* mission;
  const MissionAgreement* agreement;
};

std::vector<ListedMission> missionsOf(const CalibrationHistory& history) {
  std::vector<ListedMission> all;
  for (std::size_t m = 0; m < history.missions.size(); ++m)
    all.push_back({&history.missions[m], &history.agreement[m]});
  return all;
}

const Fields<ListedMission>& missionFields() {
  using A = MissionAgreement;
  using M = ListedMission;
  static const Fields<MissionValue> value("mission_value", "A parameter by this flight alone.",
                                          {{"bias", &MissionValue::bias, "Assumed - true value"},
                                           {"std", &MissionValue::std, "Standard deviation"}});
  static const Fields<A> agreement(
      "agreement", "How a mission agrees with the others.",
      {{"chi_squared", &A::chi_squared, "Of the differences from the prediction"},
       {"degrees_of_freedom", &A::freedom, "Parameters that were compared"},
       {"p_value", &A::p_value, "Probability of larger differences"},
       {"agrees", &A::agrees, "Whether it agrees"}});
  static const Fields<M> fields(
      "mission", "A calibration.",
      {{"calibration", [](const M& m) { return m.mission->name; }, "Its file"},
       {"date", [](const M& m) { return m.mission->day ? dateText(*m.mission->day) : ""; },
        "Date of the flight", unlessEmpty},
       {"covariates", [](const M& m) { return m.mission->covariates; }, "Such as the temperature",
        unlessEmpty},
       {"parameters", [](const M& m) { return valuesOf(*m.mission); }, value,
        "Parameters that it determines, each in its unit"},
       {"agreement", [](const M& m) { return *m.agreement; }, agreement, "With the others"}});
  return fields;
}

/// NaN where it is not known: a zero from fewer missions is no estimate.
SystemVector changesOf(const HistoryReport& report) {
  SystemVector all = SystemVector::Constant(std::nan(""));
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterHistory& known = report.history[info.parameter];
    if (known.missions == 0) continue;
    if (known.change_std > 0.0 || known.missions >= CalibrationHistory::kFewestForChange)
      all[indexOf(info.parameter)] = known.change_std;
  }
  return all;
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

const FieldTable& historyFields() {
  using F = Field<HistoryReport>;
  using R = HistoryReport;
  const auto changes = [](const R& r) {
    return itemsOf(r.history, r.history.changes,
                   [](const ParameterChange& change) { return &infoOf(change.parameter); });
  };
  static const Fields<R> fields(
      "history", "Result of `pcl_als_history`.",
      {F::constant("format", "pcl_als history", ""),
       F::constant("version", 1, ""),
       toolVersionField<R>(),
       {"instrument", &R::instrument, calibrationInstrumentFields(),
        "The value from now on, as in calibration.json"},
       {"change_std", changesOf, deviationFields(), "Of changes between missions"},
       {"parameters", [](const R& r) { return historyParametersOf(r.history); },
        historyParameterFields(), "Parameters that a mission determines"},
       {"changes", changes, parameterChangeFields(), "Significant changes"},
       {"missions", [](const R& r) { return missionsOf(r.history); }, missionFields(),
        "In the order of their dates"},
       {"findings", [](const R& r) { return historyFindings(r.history); }, "In sentences"},
       {"excluded", &R::excluded, "Calibrations that are not used, and why"}});
  return fields;
}

std::string historyJson(const HistoryReport& report) {
  return jsonText(historyFields().write(&report));
}

}  // namespace pcl_als
