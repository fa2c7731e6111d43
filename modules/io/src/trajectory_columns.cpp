// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "trajectory_columns.h"

#include <algorithm>
#include <string_view>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als::detail {
namespace {

enum class UnitKind { second, metre, angle, week, date, one };

struct QuantityInfo {
  const char* name;  ///< as in this project's own files
  UnitKind unit;
  std::vector<std::string_view> accepted;  ///< as documented; compared without punctuation
};

/// Indexed by TrajectoryQuantity. Course and track are directions of movement, not headings.
const std::array<QuantityInfo, kTrajectoryQuantities>& quantities() {
  static const std::array<QuantityInfo, kTrajectoryQuantities> table = {{
      {"time",
       UnitKind::second,
       {"time", "gps_time", "gps_seconds", "seconds_of_week", "week_seconds", "sow", "tow",
        "gps_tow", "time_of_week", "gps_sow", "corr_time", "timestamp"}},
      {"x", UnitKind::metre, {"x", "easting", "east", "tx", "position_x"}},
      {"y", UnitKind::metre, {"y", "northing", "north", "ty", "position_y"}},
      {"z",
       UnitKind::metre,
       {"z", "height", "elevation", "altitude", "alt", "ellipsoidal_height", "ellipsoid_height",
        "h_ell", "hght", "h", "tz", "position_z"}},
      {"roll", UnitKind::angle, {"roll"}},
      {"pitch", UnitKind::angle, {"pitch"}},
      {"heading",
       UnitKind::angle,
       {"heading", "azimuth", "yaw", "hdg", "head", "true_heading", "heading_true"}},
      {"qw", UnitKind::one, {"qw", "q0", "quat_w", "quaternion_w", "orientation_w", "rot_w"}},
      {"qx", UnitKind::one, {"qx", "q1", "quat_x", "quaternion_x", "orientation_x", "rot_x"}},
      {"qy", UnitKind::one, {"qy", "q2", "quat_y", "quaternion_y", "orientation_y", "rot_y"}},
      {"qz", UnitKind::one, {"qz", "q3", "quat_z", "quaternion_z", "orientation_z", "rot_z"}},
      {"latitude", UnitKind::angle, {"latitude", "lat"}},
      {"longitude", UnitKind::angle, {"longitude", "lon", "long", "lng"}},
      {"geocentric X", UnitKind::metre, {"x_ecef", "ecef_x", "geocentric_x"}},
      {"geocentric Y", UnitKind::metre, {"y_ecef", "ecef_y", "geocentric_y"}},
      {"geocentric Z", UnitKind::metre, {"z_ecef", "ecef_z", "geocentric_z"}},
      {"orthometric height",
       UnitKind::metre,
       {"h_msl", "msl", "orthometric_height", "h_ortho", "ortho_height"}},
      {"week", UnitKind::week, {"week", "gps_week", "wn"}},
      {"UTC time", UnitKind::second, {"utc_time", "utc", "utc_seconds"}},
      {"date", UnitKind::date, {"date", "utc_date", "gps_date", "calendar_date"}},
      {"sd_east", UnitKind::metre, {"sd_east", "east_sd", "se", "std_east"}},
      {"sd_north", UnitKind::metre, {"sd_north", "north_sd", "sn", "std_north"}},
      {"sd_up", UnitKind::metre, {"sd_up", "sd_height", "height_sd", "sh", "std_up"}},
      {"sd_roll", UnitKind::angle, {"sd_roll", "roll_sd", "sr", "std_roll"}},
      {"sd_pitch", UnitKind::angle, {"sd_pitch", "pitch_sd", "ptch_sd", "sp", "std_pitch"}},
      {"sd_heading",
       UnitKind::angle,
       {"sd_heading", "heading_sd", "hdng_sd", "shd", "std_heading"}},
      {"reconstructed", UnitKind::second, {"reconstructed"}},
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
      "radians", "ft",  "feet",   "usft",    "gon",     "grad",  "d"};
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

double factorOf(AngleUnit unit) {
  if (unit == AngleUnit::radians) return 1.0;
  return unit == AngleUnit::gon ? kPi / 200.0 : kRadiansPerDegree;
}

/// Factor from a column's unit to the internal one; 0 for a unit that is not supported.
double factorOf(UnitKind kind, const std::string& unit, AngleUnit angles) {
  const auto any = [&unit](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), unit) != names.end();
  };
  switch (kind) {
    case UnitKind::second:
      return any({"", "s", "sec", "second", "seconds"}) ? 1.0 : 0.0;
    case UnitKind::metre:
      return any({"", "m", "metre", "meter", "metres", "meters"}) ? 1.0 : 0.0;
    case UnitKind::one:
      return any({"", "1"}) ? 1.0 : 0.0;
    case UnitKind::week:
    case UnitKind::date:
      return 1.0;
    case UnitKind::angle:
      break;
  }
  if (unit.empty()) return factorOf(angles);
  if (any({"rad", "rads", "radian", "radians"})) return 1.0;
  if (any({"gon", "gons", "grad", "grads"})) return kPi / 200.0;
  if (any({"arcmin", "amin", "min"})) return kRadiansPerDegree / 60.0;
  if (any({"arcsec", "asec", "sec"})) return kRadiansPerDegree / 3600.0;
  return any({"d", "deg", "degs", "degree", "degrees", "dms", "dm"}) ? kRadiansPerDegree : 0.0;
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

/// The quantity of a plain name; kTrajectoryQuantities for none.
std::size_t quantityNamed(const std::string& name) {
  std::size_t q = 0;
  while (q < kTrajectoryQuantities && !accepts(quantities()[q], name)) ++q;
  return q;
}

}  // namespace

bool TrajectoryColumns::recognise(const std::vector<std::string_view>& names) {
  std::array<bool, kTrajectoryQuantities> found{};
  for (const std::string_view name : names) {
    const std::size_t q = quantityNamed(separated(name).name);
    if (q < kTrajectoryQuantities) found[q] = true;
  }
  const auto all = [&found](std::initializer_list<TrajectoryQuantity> wanted) {
    return std::all_of(wanted.begin(), wanted.end(),
                       [&](TrajectoryQuantity q) { return found[static_cast<std::size_t>(q)]; });
  };
  using Q = TrajectoryQuantity;
  return (all({Q::time}) || all({Q::utc_time})) &&
         (all({Q::x, Q::y}) || all({Q::latitude, Q::longitude}) ||
          all({Q::geocentric_x, Q::geocentric_y}));
}

bool TrajectoryColumns::isGeodetic(std::string_view name) {
  const std::size_t q = quantityNamed(separated(name).name);
  return q == static_cast<std::size_t>(TrajectoryQuantity::latitude) ||
         q == static_cast<std::size_t>(TrajectoryQuantity::longitude);
}

TrajectoryColumns::TrajectoryColumns(const CsvTable& table, AngleUnit angles, bool projects) {
  for (std::size_t index = 0; index < table.header().size(); ++index) assign(table, index, angles);
  chooseAttitude(table);
  chooseCoordinates(table, projects);
}

/// POSPac gives a height beside the map coordinates and another beside latitude and longitude.
bool TrajectoryColumns::mayRepeat(std::size_t quantity) const {
  return quantity == static_cast<std::size_t>(TrajectoryQuantity::z) &&
         has(TrajectoryQuantity::x) && has(TrajectoryQuantity::latitude);
}

void TrajectoryColumns::assign(const CsvTable& table, std::size_t index, AngleUnit angles) {
  const std::string header(table.header()[index]);
  NameAndUnit found = separated(header);
  if (found.unit.empty() && !table.units().empty()) found.unit = plain(table.units()[index]);
  const std::size_t q = quantityNamed(found.name);
  if (q == kTrajectoryQuantities) return;
  const QuantityInfo& info = quantities()[q];
  TrajectoryColumn& column = columns_[q];
  if (column.present() && mayRepeat(q)) return;
  if (column.present() && plain(column.name) == plain(header))
    table.refuseHeader("column '" + header + "' appears twice");
  if (column.present()) {
    table.refuseHeader("columns '" + column.name + "' and '" + header + "' both name the " +
                       info.name + "; rename or remove the one that is not meant");
  }
  column = {index, header, factorOf(info.unit, found.unit, angles), found.unit};
  if (column.factor == 0.0 && q >= static_cast<std::size_t>(TrajectoryQuantity::sd_east)) {
    column = {};  // TerraPOS gives metres for standard deviations of angles
  } else if (column.factor == 0.0) {
    table.refuseHeader("column '" + header + "': the unit " + found.unit +
                       " is not supported; give metres, seconds and degrees (or radians, named "
                       "so: roll_rad)");
  }
  if (q == static_cast<std::size_t>(TrajectoryQuantity::heading)) {
    if (found.name == "yaw") attitude_ = AttitudeForm::yaw;
    heading_is_true_ = found.name == "trueheading" || found.name == "headingtrue";
  }
}

/// Roll, pitch and heading say more than a quaternion, which does not name its axes; what is not
/// used is dropped.
void TrajectoryColumns::chooseAttitude(const CsvTable& table) {
  using Q = TrajectoryQuantity;
  const std::array<Q, 4> quaternion = {Q::quaternion_w, Q::quaternion_x, Q::quaternion_y,
                                       Q::quaternion_z};
  const auto drop = [this](Q quantity) { columns_[static_cast<std::size_t>(quantity)] = {}; };
  const auto count = std::count_if(quaternion.begin(), quaternion.end(),
                                   [this](Q quantity) { return has(quantity); });
  const bool angles = has(Q::roll) && has(Q::pitch) && has(Q::heading);
  if (count == 3 && !angles)
    refuseIncomplete(table, *std::find_if_not(quaternion.begin(), quaternion.end(),
                                              [this](Q quantity) { return has(quantity); }));
  if (count == 4 && !angles) {
    for (const Q angle : {Q::roll, Q::pitch, Q::heading}) drop(angle);
    attitude_ = AttitudeForm::quaternion;
    heading_is_true_ = false;
    return;
  }
  for (const Q part : quaternion) drop(part);
}

bool TrajectoryColumns::orthometric() const {
  return coordinates_ != TrajectoryCoordinates::geocentric && !has(TrajectoryQuantity::z);
}

std::array<TrajectoryQuantity, 3> TrajectoryColumns::place() const {
  using Q = TrajectoryQuantity;
  const Q height = has(Q::z) ? Q::z : Q::orthometric_height;
  switch (coordinates_) {
    case TrajectoryCoordinates::geographic:
      return {Q::latitude, Q::longitude, height};
    case TrajectoryCoordinates::geocentric:
      return {Q::geocentric_x, Q::geocentric_y, Q::geocentric_z};
    case TrajectoryCoordinates::map:
      break;
  }
  return {Q::x, Q::y, height};
}

/// Latitude and longitude say more than map coordinates of a projection that is not stated.
void TrajectoryColumns::chooseCoordinates(const CsvTable& table, bool projects) {
  using Q = TrajectoryQuantity;
  const bool geographic = has(Q::latitude) && has(Q::longitude);
  const bool geocentric = has(Q::geocentric_x) && has(Q::geocentric_y) && has(Q::geocentric_z);
  const bool map = has(Q::x) && has(Q::y);
  if (geographic && (projects || !map)) {
    coordinates_ = TrajectoryCoordinates::geographic;
  } else if (geocentric && (projects || !map)) {
    coordinates_ = TrajectoryCoordinates::geocentric;
  }
  if (!has(Q::time) && !has(Q::utc_time)) refuseIncomplete(table, Q::time);
  for (const Q needed : place()) {
    if (!has(needed)) refuseIncomplete(table, needed == Q::orthometric_height ? Q::z : needed);
  }
}

void TrajectoryColumns::refuseIncomplete(const CsvTable& table, TrajectoryQuantity missing) const {
  const QuantityInfo& info = quantities()[static_cast<std::size_t>(missing)];
  throw InputError(table.at(table.lackOf(info.name) +
                            "; accepted names (in any case): " + listOf(info.accepted)),
                   Hint::columns);
}

std::string TrajectoryColumns::describe() const {
  std::string text;
  for (std::size_t q = 0; q < kTrajectoryQuantities; ++q) {
    const TrajectoryColumn& column = columns_[q];
    if (!column.present() || plain(column.name) == quantities()[q].name) continue;
    text.append(text.empty() ? "columns: " : ", ").append(quantities()[q].name);
    text.append(" from ").append(printable(column.name, kLongestQuotation));
  }
  return text;
}

}  // namespace pcl_als::detail
