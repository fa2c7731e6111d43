// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/plan_io.h>

#include "csv_table.h"

namespace pcl_als {
namespace {

std::optional<double> positive(const detail::CsvTable& table, std::size_t column) {
  if (column == detail::CsvTable::npos || table.text(column).empty()) return std::nullopt;
  const double value = table.number(column);
  if (value <= 0.0) table.refuse(column, "must be more than 0");
  return value;
}

}  // namespace

std::vector<FlightLineRecord> readFlightLines(const std::filesystem::path& path) {
  detail::CsvTable table(path);
  const std::size_t id = table.required("id");
  const std::size_t x1 = table.required("x1"), y1 = table.required("y1");
  const std::size_t x2 = table.required("x2"), y2 = table.required("y2");
  const std::size_t height = table.required("height");
  const std::size_t speed = table.optional("speed"), density = table.optional("density");
  std::vector<FlightLineRecord> lines;
  std::set<std::string> ids;
  while (table.next()) {
    FlightLineRecord line;
    line.id = table.text(id);
    if (line.id.empty()) table.refuse(id, "must name the line");
    if (!ids.insert(line.id).second) table.refuse(id, "names two lines");
    line.start = {table.number(x1), table.number(y1)};
    line.end = {table.number(x2), table.number(y2)};
    if (line.start == line.end) table.refuse(x2, "ends the line where it starts: it has no length");
    line.height = table.number(height);
    if (line.height <= 0.0) table.refuse(height, "must be more than 0 metres");
    line.speed = positive(table, speed);
    line.density = positive(table, density);
    lines.push_back(std::move(line));
  }
  if (lines.empty()) throw InputError(path.string() + ": has a header but no lines");
  return lines;
}

}  // namespace pcl_als
