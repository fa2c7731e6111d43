// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als {
namespace {

constexpr std::string_view kChannel = ".ch";

/// A whole number without sign; -1 for anything else.
int numberOf(std::string_view text) {
  const int value = valueIn<int>(text).value_or(-1);
  return value >= 0 && text.front() != '-' ? value : -1;
}

std::vector<std::string_view> partsOf(std::string_view text) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(',', from), text.size());
    parts.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return parts;
}

/// The ids of "7" or "3-7"; an id that is no range of numbers is taken as it is.
void addStrips(std::string_view part, std::vector<std::string>& strips) {
  constexpr int kPointSourceIds = 65536;  // point source ids
  const std::size_t dash = part.find('-');
  const int first = dash == std::string_view::npos ? -1 : numberOf(part.substr(0, dash));
  const int last = dash == std::string_view::npos ? -1 : numberOf(part.substr(dash + 1));
  if (first < 0 || last < first || last - first >= kPointSourceIds) {
    strips.emplace_back(part);
    return;
  }
  for (int id = first; id <= last; ++id) strips.push_back(std::to_string(id));
}

}  // namespace

StripGroup stripGroup(std::string_view text) {
  const auto fail = [&](const std::string& why) -> UsageError {
    return UsageError("system \"" + std::string(text) + "\": " + why);
  };
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0 || equals + 1 == text.size())
    throw fail("must be NAME=STRIPS[:CHANNEL]");
  StripGroup group{std::string(text.substr(0, equals)), {}};
  std::string_view list = text.substr(equals + 1);
  const std::size_t colon = list.rfind(':');
  int channel = -1;
  if (colon != std::string_view::npos) {
    channel = numberOf(list.substr(colon + 1));
    if (channel < 0 || channel > 255) throw fail("the channel must be a number from 0 to 255");
    list = list.substr(0, colon);
  }
  for (const std::string_view part : partsOf(list)) {
    if (part.empty()) throw fail("the id of a strip is empty");
    addStrips(part, group.strips);
  }
  if (channel >= 0) {
    for (std::string& strip : group.strips) strip = channelStrip(strip, channel);
  }
  return group;
}

std::string channelStrip(const std::string& strip, int channel) {
  return strip + std::string(kChannel) + std::to_string(channel);
}

std::string passOfStrip(const std::string& strip) {
  const std::size_t at = strip.rfind(kChannel);
  if (at == std::string::npos || numberOf(std::string_view(strip).substr(at + kChannel.size())) < 0)
    return strip;
  return strip.substr(0, at);
}

std::uint8_t channelOfValue(double value, const std::string& where) {
  if (value >= 0.0 && value <= 255.0) return static_cast<std::uint8_t>(value);
  throw InputError(where + " holds " + std::to_string(value) + ", which is no channel (0 to 255)");
}

PerSystemParameters ownUnknowns(std::string_view text) {
  PerSystemParameters own{{}, false};
  for (const std::string_view part : partsOf(text)) {
    if (part == "offset") {
      own.offset = true;
      continue;
    }
    const std::size_t before = own.parameters.size();
    for (const SystemParameterInfo& info : systemParameters()) {
      const bool group =
          (part == "boresight" || part == "lever_arm") && info.name.substr(0, part.size()) == part;
      if (group || info.name == part) own.parameters.push_back(info.parameter);
    }
    if (own.parameters.size() == before)
      throw UsageError("unknown parameter \"" + std::string(part) +
                       "\" of a system; known are boresight, lever_arm, offset and the names of "
                       "single parameters");
  }
  return own;
}

}  // namespace pcl_als
