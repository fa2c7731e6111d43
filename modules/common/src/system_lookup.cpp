// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_lookup.h>

namespace pcl_als {

SystemLookup::SystemLookup(const CalibrationResult& calibration) {
  const std::vector<SystemEstimate>& systems = calibration.systems;
  several_ = systems.size() > 1;
  fixed_ = static_cast<std::uint8_t>(std::max<std::size_t>(1, systems.size()));
  for (std::size_t i = 0; several_ && i < systems.size(); ++i) {
    for (const std::string& strip : systems[i].group.strips)
      system_[strip] = static_cast<std::uint8_t>(i);
  }
  for (const HeldSurface& surface : calibration.held) {
    for (const std::string& strip : surface.strips) system_[strip] = fixed_;
  }
  const bool by_channel = std::any_of(system_.begin(), system_.end(), [](const auto& entry) {
    return passOfStrip(entry.first) != entry.first;
  });
  if (!by_channel) return;
  channel_field_ =
      calibration.channel_field.empty() ? "scanner_channel" : calibration.channel_field;
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
