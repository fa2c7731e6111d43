// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>

namespace pcl_als {

SystemLookup::SystemLookup(const CalibrationResult& calibration) {
  const std::vector<SystemEstimate>& systems = calibration.systems;
  several_ = systems.size() > 1;
  fixed_ = static_cast<std::uint8_t>(std::max<std::size_t>(1, systems.size()));
  for (std::size_t i = 0; several_ && i < systems.size(); ++i) {
    for (const std::string& strip : systems[i].group.strips)
      system_[strip] = static_cast<std::uint8_t>(i);
  }
  for (const FixedSurface& surface : calibration.held) {
    for (const std::string& strip : surface.strips) system_[strip] = fixed_;
  }
  for (const auto& [strip, system] : system_) {
    const std::string pass = passOfStrip(strip);
    if (pass == strip) continue;
    channel_field_ =
        calibration.channel_field.empty() ? "scanner_channel" : calibration.channel_field;
    needs_channels_ = needs_channels_ || strip != channelStrip(pass, 0);
  }
}

std::string SystemLookup::objection(bool with_sources, bool with_channels) const {
  if (single()) return {};
  if (!with_sources && strip_.empty())
    return "the calibration has several systems or fixed strips, and the points have no point "
           "source id: the id of their strip is needed";
  if (!with_channels && needs_channels_)
    return "the calibration divides strips by the channel of the scanner in the field " +
           channel_field_ + ", which the points do not have";
  return {};
}

std::uint8_t SystemLookup::of(std::uint16_t source, std::uint8_t channel) const {
  if (single()) return 0;
  const std::string number = std::to_string(source);
  for (const std::string& strip :
       {channelStrip(number, channel), number, channelStrip(strip_, channel), strip_}) {
    const auto found = system_.find(strip);
    if (found != system_.end()) return found->second;
  }
  if (source == 0 && strip_.empty())
    throw InputError(
        "points without a point source id: give the id of their strip, on which the system of the "
        "calibration depends");
  if (!several_) return 0;
  throw InputError("points of strip " + (source != 0 ? number : "'" + strip_ + "'") + ", channel " +
                   std::to_string(channel) + " belong to none of the systems of the calibration");
}

}  // namespace pcl_als
