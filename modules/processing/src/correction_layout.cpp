// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "correction_layout.h"

#include <string>

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {
namespace {

/// Sets where a record has the channel of the scanner, which divided the strips of the calibration.
void setChannel(const LasFile& file, const std::string& field,
                IntegerBiasCorrection::Layout& layout) {
  const std::string name = file.path().string();
  constexpr std::size_t kFlags = 15;
  if (field == "scanner_channel") {
    layout.channel_position = kFlags;
    layout.channel_shift = 4;
    layout.channel_mask = file.layout().format < 6 ? 0U : 3U;
    return;
  }
  layout.channel_mask = 0xFF;
  layout.channel_position = file.layout().user_data;
  if (field == "user_data") return;
  if (const LasExtraField* extra = findLasExtraField(file.extraFields(), field, name)) {
    if (lasExtraSize(*extra) != 1)
      throw InputError(name + ": field '" + field + "' with the channel has more than a byte");
    layout.channel_position = extra->position;
    return;
  }
  throw InputError(name + ": has no field '" + field +
                   "' with the channel of the scanner, by which the calibration divides strips");
}

}  // namespace

IntegerBiasCorrection::Layout correctionLayout(const LasFile& file, const SystemLookup& systems) {
  // Bytes of a record, which all formats up to 5, and all later ones, have in common.
  constexpr std::size_t kIntensity = 12, kReturns = 14, kFlags = 15, kSource = 18,
                        kLaterSource = 20;
  const LasScaling metres = file.toMetres();
  const bool early = file.layout().format < 6;
  IntegerBiasCorrection::Layout layout;
  layout.record_length = file.header().record_length;
  layout.time_position = static_cast<std::size_t>(file.layout().gps_time);
  layout.time_shift = file.layout().time_shift;
  layout.intensity_position = kIntensity;
  layout.scan_direction_position = early ? kReturns : kFlags;
  layout.scale = metres.scale;
  layout.offset = metres.offset;
  layout.source_position = early ? kSource : kLaterSource;
  if (!systems.channelField().empty()) setChannel(file, systems.channelField(), layout);
  return layout;
}

}  // namespace pcl_als::detail
