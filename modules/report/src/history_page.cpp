// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/drawing/control_chart.h>
#include <pcl_als/report/history_report.h>

#include "report_parts.h"

namespace pcl_als {
namespace {

constexpr PictureSize kChart{1400, 420};

/// "boresight roll, arcsec"
std::string labelOf(SystemParameter parameter) {
  const std::string unit = unitText(parameter);
  return plainName(parameter) + (unit.empty() ? unit : ", " + unit);
}

ReportTable valueTable(const CalibrationHistory& history) {
  ReportTable table{
      "parameters",
      "Values to use from now on, with the standard deviation of the value and that "
      "of the bias of the next flight, which includes changes between flights",
      {"parameter", "unit", "value", "std", "next flight", "change", "missions", "constant"},
      {}};
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterHistory& parameter = history[info.parameter];
    auto& row = table.rows.emplace_back();
    row = {plainName(info.parameter), unitText(info.parameter)};
    if (parameter.missions == 0) {
      row.emplace_back("not determined by any calibration");
      continue;
    }
    const int p = indexOf(info.parameter);
    const double unit = info.internal_per_unit, std = std::sqrt(history.covariance(p, p));
    const int decimals = decimalsOfStd(std / unit);
    for (const double value :
         {history.value[p], std, std::hypot(std, parameter.change_std), parameter.change_std})
      row.push_back(numberText(value / unit, decimals));
    row.push_back(std::to_string(parameter.missions));
    row.emplace_back(parameter.missions < 2 ? "" : parameter.constant ? "yes" : "no");
    if (!parameter.constant) table.failed.push_back(table.rows.size() - 1);
  }
  return table;
}

ReportTable segmentTable(const CalibrationHistory& history) {
  ReportTable table{
      "segments", "Values between steps", {"parameter", "unit", "from", "to", "value", "std"}, {}};
  for (const SystemParameterInfo& info : systemParameters()) {
    const std::vector<ParameterSegment>& segments = history[info.parameter].segments;
    if (segments.size() < 2) continue;
    for (const ParameterSegment& segment : segments) {
      const double unit = info.internal_per_unit;
      const int decimals = decimalsOfStd(segment.std / unit);
      table.rows.push_back({plainName(info.parameter), unitText(info.parameter),
                            history.label(segment.first), history.label(segment.last),
                            numberText(segment.bias / unit, decimals),
                            numberText(segment.std / unit, decimals)});
    }
  }
  return table;
}

ReportTable missionTable(const CalibrationHistory& history) {
  ReportTable table{"missions",
                    "Agreement of each calibration with the prediction from all others: chi "
                    "squared of the differences with its degrees of freedom and probability; the "
                    "parameter that differs most, in standard deviations",
                    {"date", "calibration", "chi squared", "freedom", "p", "differs most", "by"},
                    {}};
  for (std::size_t m = 0; m < history.missions.size(); ++m) {
    const CalibrationMission& mission = history.missions[m];
    const MissionAgreement& agreement = history.agreement[m];
    auto& row = table.rows.emplace_back();
    row = {mission.day ? dateText(*mission.day) : "", mission.name};
    if (agreement.freedom == 0.0) {
      row.emplace_back("the others do not predict it");
      continue;
    }
    row.insert(row.end(),
               {numberText(agreement.chi_squared, 1), numberText(agreement.freedom, 0),
                agreement.p_value < 0.0001 ? "< 0.0001" : numberText(agreement.p_value, 4),
                plainName(agreement.largest), numberText(agreement.deviation, 1)});
    if (!agreement.agrees) table.failed.push_back(m);
  }
  return table;
}

ControlChart chartOf(const CalibrationHistory& history, const SystemParameterInfo& info) {
  const ParameterHistory& parameter = history[info.parameter];
  const int p = indexOf(info.parameter);
  const double unit = info.internal_per_unit;
  ControlChart chart{plainName(info.parameter), labelOf(info.parameter), {}};
  for (std::size_t m = 0; m < history.missions.size(); ++m) {
    const CalibrationMission& mission = history.missions[m];
    const bool known = mission.determines(info.parameter);
    ControlChart::Sample& sample = chart.samples.emplace_back();
    sample.label = history.label(m);
    sample.value = mission.bias[p] / unit;
    sample.std = mission.std[p] / unit;
    sample.expected = parameter.fitted[m] / unit;
    sample.expected_std = std::hypot(known ? mission.std[p] : 0.0, parameter.change_std) / unit;
    sample.marked = std::any_of(
        history.changes.begin(), history.changes.end(), [&](const ParameterChange& change) {
          return change.kind == ChangeKind::outlier && change.parameter == info.parameter &&
                 change.first_after == m;
        });
  }
  return chart;
}

Verdict verdictOf(const HistoryReport& report) {
  const CalibrationHistory& history = report.history;
  Verdict verdict;
  verdict.sentences = historyFindings(history);
  verdict.grade = verdict.sentences.empty() ? VerdictGrade::good : VerdictGrade::attention;
  const std::string missions = counted(history.missions.size(), "calibration");
  verdict.headline = history.missions.size() == 1 ? "One calibration has no history yet."
                     : verdict.sentences.empty()
                         ? "All parameters are constant over " + missions + "."
                         : "Not all parameters are constant over " + missions + ".";
  for (const std::string& excluded : report.excluded) verdict.sentences.push_back(excluded + ".");
  return verdict;
}

}  // namespace

void writeHistoryPage(const ReportOrigin& origin, const HistoryReport& report) {
  const CalibrationHistory& history = report.history;
  HtmlReport page(origin.titleOr("History of calibrations"), origin.program);
  addVerdict(verdictOf(report), page);
  page.addSection("Values to use");
  page.addTable(valueTable(history));
  const ReportTable segments = segmentTable(history);
  if (!segments.rows.empty()) page.addTable(segments);
  page.addSection("Control charts");
  page.addText(
      "Points are the calibrations with their 95 % intervals, the line is the value that "
      "all calibrations together give, and the band has a width of two standard deviations "
      "of a single calibration to either side.");
  for (const SystemParameterInfo& info : systemParameters())
    if (history.knows(info.parameter))
      page.addPicture(drawControlChart(chartOf(history, info), kChart),
                      "History of " + plainName(info.parameter));
  page.addSection("Missions");
  page.addTable(missionTable(history));
  addOrigin(origin, {}, page);
  page.write(origin.folder);
}

}  // namespace pcl_als
