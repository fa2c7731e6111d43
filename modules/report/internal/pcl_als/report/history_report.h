// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/history/calibration_history.h>
#include <pcl_als/report/report_origin.h>

namespace pcl_als {

class FieldTable;

/// The content of history.json.
struct HistoryReport {
  CalibrationHistory history;
  CalibrationResult instrument;       ///< pooledInstrument()
  std::vector<std::string> excluded;  ///< calibrations that are not used, and why
};

/// What the history says, in sentences: constancy, changes with what may have caused them, missions
/// that do not fit.
std::vector<std::string> historyFindings(const CalibrationHistory& history);

/// The tables that the tool prints.
std::string historyText(const HistoryReport& report);
/// The text of history.json, and its description.
std::string historyJson(const HistoryReport& report);
const FieldTable& historyFields();

/// report.html with a control chart of each parameter, report.md and tables as CSV.
void writeHistoryPage(const ReportOrigin& origin, const HistoryReport& report);

}  // namespace pcl_als
