// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <set>

#include <pcl_als/common/calendar_date.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/mission_table.h>

#include "csv_table.h"

namespace pcl_als {

std::vector<MissionRow> readMissionTable(const std::filesystem::path& path) {
  detail::CsvTable table(path);
  const std::size_t calibration = table.required("calibration"), date = table.optional("date");
  std::vector<MissionRow> rows;
  std::set<std::string> names;
  while (table.next()) {
    MissionRow& row = rows.emplace_back();
    row.calibration = table.text(calibration);
    if (!names.insert(row.calibration).second) table.refuse(calibration, "has a row already");
    if (date != detail::CsvTable::npos && !table.text(date).empty()) {
      row.day = daysOfGps(table.text(date), {});
      if (!row.day) table.refuse(date, "is no date such as 2026-05-04");
    }
    for (std::size_t column = 0; column < table.header().size(); ++column) {
      if (column == calibration || column == date) continue;
      const double value = table.numberOrNan(column);
      if (!std::isnan(value)) row.values[std::string(table.header()[column])] = value;
    }
  }
  if (rows.empty()) throw InputError(path.string() + ": has no rows below the header");
  return rows;
}

}  // namespace pcl_als
