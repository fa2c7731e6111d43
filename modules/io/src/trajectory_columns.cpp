// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "trajectory_columns.h"

#include <algorithm>
#include <string_view>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als::detail {
namespace {

enum class UnitKind { second, metre, angle };

struct QuantityInfo {
  const char* name;  ///< as in this project's own files
  UnitKind unit;
  std::vector<std::string_view> accepted;  ///< as documented; compared without punctuation
};

/// Indexed by TrajectoryQuantity. Course and track are directions of movement, not headings, and a
/// true heading differs from a grid heading by the meridian convergence: neither is accepted.
const std::array<QuantityInfo, kTrajectoryQuantities>& quantities() {
  static const std::array<QuantityInfo, kTrajectoryQuantities> table = {{
      {"time",
       UnitKind::second,
       {"time", "gps_time", "gps_seconds", "seconds_of_week", "week_seconds", "sow"}},
      {"x", UnitKind::metre, {"x", "easting", "east"}},
      {"y", UnitKind::metre, {"y", "northing", "north"}},
      {"z", UnitKind::metre, {"z", "height", "elevation", "altitude", "alt", "ellipsoidal_height"}},
      {"roll", UnitKind::angle, {"roll"}},
      {"pitch", UnitKind::angle, {"pitch"}},
      {"heading", UnitKind::angle, {"heading", "azimuth", "yaw", "hdg"}},
  }};
  return table;
}

/// Letters and digits in lower case.
std::string plain(std::string_view text) {
  std::string result;
  for (char c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) result += c;
  }
  return result;
}

/// The name of a column without its unit, and the unit; both plain.
struct NameAndUnit {
  std::string name, unit;
};

bool isUnit(const std::string& text) {
  static const std::vector<std::string_view> known = {
      "s",       "sec", "second", "seconds", "m",       "metre", "meter", "metres",
      "meters",  "deg", "degs",   "degree",  "degrees", "rad",   "rads",  "radian",
      "radians", "ft",  "feet",   "usft",    "gon",     "grad"};
  return std::find(known.begin(), known.end(), text) != known.end();
}

NameAndUnit separated(std::string_view header) {
  const std::size_t bracket = header.find_first_of("([");
  if (bracket != std::string_view::npos) {
    return {plain(header.substr(0, bracket)), plain(header.substr(bracket))};
  }
  const std::size_t last = header.find_last_of("_ ");
  if (last != std::string_view::npos && isUnit(plain(header.substr(last)))) {
    return {plain(header.substr(0, last)), plain(header.substr(last))};
  }
  return {plain(header), {}};
}

/// Factor from a column's unit to the internal one; 0 for a unit that is not supported.
double factorOf(UnitKind kind, const std::string& unit) {
  const auto any = [&unit](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), unit) != names.end();
  };
  switch (kind) {
    case UnitKind::second:
      return any({"", "s", "sec", "second", "seconds"}) ? 1.0 : 0.0;
    case UnitKind::metre:
      return any({"", "m", "metre", "meter", "metres", "meters"}) ? 1.0 : 0.0;
    case UnitKind::angle:
      break;
  }
  if (any({"rad", "rads", "radian", "radians"})) return 1.0;
  return any({"", "deg", "degs", "degree", "degrees"}) ? kRadiansPerDegree : 0.0;
}

std::string listOf(const std::vector<std::string_view>& names) {
  std::string text;
  for (const std::string_view name : names) text.append(text.empty() ? "" : ", ").append(name);
  return text;
}

bool accepts(const QuantityInfo& info, const std::string& name) {
  return std::any_of(info.accepted.begin(), info.accepted.end(),
                     [&name](std::string_view accepted) { return plain(accepted) == name; });
}

}  // namespace

TrajectoryColumns::TrajectoryColumns(const CsvTable& table) {
  for (std::size_t index = 0; index < table.header().size(); ++index) assign(table, index);
  checkComplete(table);
}

void TrajectoryColumns::assign(const CsvTable& table, std::size_t index) {
  const std::string header(table.header()[index]);
  const NameAndUnit found = separated(header);
  for (std::size_t q = 0; q < kTrajectoryQuantities; ++q) {
    const QuantityInfo& info = quantities()[q];
    if (!accepts(info, found.name)) continue;
    TrajectoryColumn& column = columns_[q];
    if (column.present()) {
      table.refuseHeader("columns '" + column.name + "' and '" + header + "' both name the " +
                         info.name + "; rename or remove the one that is not meant");
    }
    column = {index, header, factorOf(info.unit, found.unit)};
    if (column.factor == 0.0) {
      table.refuseHeader("column '" + header + "': the unit " + found.unit +
                         " is not supported; give metres, seconds and degrees (or radians, named "
                         "so: roll_rad)");
    }
    if (q == static_cast<std::size_t>(TrajectoryQuantity::heading)) {
      heading_is_yaw_ = found.name == "yaw";
    }
  }
}

void TrajectoryColumns::checkComplete(const CsvTable& table) const {
  for (const TrajectoryQuantity needed : {TrajectoryQuantity::time, TrajectoryQuantity::x,
                                          TrajectoryQuantity::y, TrajectoryQuantity::z}) {
    if ((*this)[needed].present()) continue;
    const QuantityInfo& info = quantities()[static_cast<std::size_t>(needed)];
    table.refuseHeader(std::string("no column '") + info.name + "' in the header '" +
                       table.headerText() +
                       "'; accepted names (in any case): " + listOf(info.accepted));
  }
}

std::string TrajectoryColumns::describe() const {
  std::string text;
  for (std::size_t q = 0; q < kTrajectoryQuantities; ++q) {
    const TrajectoryColumn& column = columns_[q];
    if (!column.present() || plain(column.name) == quantities()[q].name) continue;
    text.append(text.empty() ? "columns: " : ", ").append(quantities()[q].name);
    text.append(" from ").append(column.name);
  }
  return text;
}

}  // namespace pcl_als::detail
