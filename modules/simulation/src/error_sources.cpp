// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/simulation/error_sources.h>

namespace pcl_als::simulation {

namespace {

[[noreturn]] void refuse(std::string_view entry, const std::string& why) {
  throw UsageError("error '" + std::string(entry) + "': " + why);
}

constexpr std::array<std::pair<ErrorScope, std::string_view>, 3> kScopes = {
    {{ErrorScope::channel, "channel"},
     {ErrorScope::session, "session"},
     {ErrorScope::strip, "strip"}}};

void readScope(std::string_view text, std::string_view whole, ErrorSources::Entry& entry) {
  for (const auto& [scope, name] : kScopes) {
    if (text.substr(0, name.size()) != name) continue;
    const auto number = valueIn<int>(text.substr(name.size()));
    if (!number || *number < (scope == ErrorScope::channel ? 0 : 1) || *number > 65535) continue;
    entry.scope = scope;
    entry.number = *number;
    return;
  }
  refuse(whole, "'" + std::string(text) + "' is not channelN, sessionN or stripN");
}

/// Sets everything but the value; returns internal units per unit and the largest value.
std::pair<double, double> readName(std::string_view name, std::string_view whole,
                                   ErrorSources::Entry& entry) {
  entry.name = name;
  std::string names;
  for (const ErrorSourceInfo& info : errorSources()) {
    names += (names.empty() ? "" : ", ") + std::string(info.name);
    if (info.name != name) continue;
    if (entry.scope == ErrorScope::channel && info.source >= ErrorSource::offset_x)
      refuse(whole, "a channel has no trajectory of its own");
    entry.index = kSystemParameterCount + static_cast<int>(info.source);
    entry.unit = info.unit;
    return {info.internal_per_unit, info.largest};
  }
  const auto parameter = systemParameterNamed(name);
  if (!parameter)
    refuse(whole, "there are " + names +
                      ", and the system parameters of a channel, session or "
                      "strip");
  if (entry.scope == ErrorScope::block)
    refuse(whole, "a system parameter of the whole block is a bias, not an error source");
  const SystemParameterInfo& info = infoOf(*parameter);
  entry.index = indexOf(*parameter);
  entry.unit = info.unit;
  return {info.internal_per_unit, largestBias(*parameter) / info.internal_per_unit};
}

ErrorSources::Entry entryOf(std::string_view whole) {
  ErrorSources::Entry entry;
  const auto equals = whole.find('=');
  if (equals == std::string_view::npos) refuse(whole, "expected NAME=VALUE");
  std::string_view name = whole.substr(0, equals);
  const auto colon = name.find(':');
  if (colon != std::string_view::npos) {
    readScope(name.substr(0, colon), whole, entry);
    name = name.substr(colon + 1);
  }
  const auto [internal_per_unit, largest] = readName(name, whole, entry);
  const auto value = valueIn<double>(whole.substr(equals + 1));
  if (!value || !(std::abs(*value) <= largest)) {
    std::ostringstream text;
    text << "the value is a number from " << -largest << " to " << largest << ' ' << entry.unit;
    refuse(whole, text.str());
  }
  entry.value = *value;
  entry.internal = *value * internal_per_unit;
  return entry;
}

}  // namespace

const std::array<ErrorSourceInfo, kErrorSourceCount>& errorSources() {
  static constexpr std::array<ErrorSourceInfo, kErrorSourceCount> kSources = {{
      {ErrorSource::time_offset, "time_offset", "ms", 1e-3, 1000.0},
      {ErrorSource::mirror_torsion, "mirror_torsion", "arcsec", kRadiansPerArcsec, 3600.0},
      {ErrorSource::encoder_quadratic, "encoder_quadratic", "1/rad", 1.0, 0.1},
      {ErrorSource::encoder_cubic, "encoder_cubic", "1/rad2", 1.0, 0.1},
      {ErrorSource::encoder_sine, "encoder_sine", "arcsec", kRadiansPerArcsec, 3600.0},
      {ErrorSource::deflection_scale, "deflection_scale", "1", 1.0, 0.05},
      {ErrorSource::range_scale, "range_scale", "1", 1.0, 0.01},
      {ErrorSource::range_walk, "range_walk", "m/decade", 1.0, 1.0},
      {ErrorSource::range_incidence, "range_incidence", "1", 1.0, 1.0},
      {ErrorSource::offset_x, "offset_x", "m", 1.0, 1000.0},
      {ErrorSource::offset_y, "offset_y", "m", 1.0, 1000.0},
      {ErrorSource::offset_z, "offset_z", "m", 1.0, 1000.0},
      {ErrorSource::jump_x, "jump_x", "m", 1.0, 100.0},
      {ErrorSource::jump_y, "jump_y", "m", 1.0, 100.0},
      {ErrorSource::jump_z, "jump_z", "m", 1.0, 100.0},
  }};
  return kSources;
}

std::string ErrorSources::Entry::scopeName() const {
  for (const auto& [known, name] : kScopes) {
    if (known == scope) return std::string(name) + " " + std::to_string(number);
  }
  return "block";
}

void ErrorSources::add(std::string_view list) {
  while (!list.empty()) {
    const auto comma = std::min(list.find(','), list.size());
    if (comma > 0) entries_.push_back(entryOf(list.substr(0, comma)));
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
}

ErrorValues ErrorSources::of(int session, int strip, int channel) const {
  ErrorValues sum;
  for (const Entry& entry : entries_) {
    if (entry.scope == ErrorScope::channel && entry.number != channel) continue;
    if (entry.scope == ErrorScope::session && entry.number != session) continue;
    if (entry.scope == ErrorScope::strip && entry.number != strip) continue;
    if (entry.index < kSystemParameterCount)
      sum.system[entry.index] += entry.internal;
    else
      sum.sources[static_cast<std::size_t>(entry.index - kSystemParameterCount)] += entry.internal;
  }
  return sum;
}

bool ErrorSources::any(ErrorSource source) const {
  return std::any_of(entries_.begin(), entries_.end(), [source](const Entry& entry) {
    return entry.index == kSystemParameterCount + static_cast<int>(source) && entry.value != 0.0;
  });
}

}  // namespace pcl_als::simulation
