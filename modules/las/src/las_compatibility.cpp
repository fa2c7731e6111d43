// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdint>

#include <pcl_als/las/las_compatibility.h>
#include <pcl_als/las/las_record.h>

#include "las_bytes.h"

namespace pcl_als {

using detail::byteAt;

namespace {

/// Position of an extra field; false where the file has none of that name and type.
bool find(const LasFile& file, const char* name, LasExtraType type, std::size_t& position) {
  for (const LasExtraField& field : file.extraFields()) {
    if (field.name != name || field.type != type) continue;
    position = field.position;
    return true;
  }
  return false;
}

}  // namespace

std::optional<LasCompatibility> LasCompatibility::of(const LasFile& file) {
  const int format = file.header().point_format;
  if (format != 1 && (format < 3 || format > 5)) return std::nullopt;
  LasCompatibility found;
  const bool complete =
      find(file, "LAS 1.4 scan angle", LasExtraType::i16, found.angle_) &&
      find(file, "LAS 1.4 extended returns", LasExtraType::u8, found.returns_) &&
      find(file, "LAS 1.4 classification", LasExtraType::u8, found.classification_) &&
      find(file, "LAS 1.4 flags and channel", LasExtraType::u8, found.flags_);
  return complete ? std::optional<LasCompatibility>(found) : std::nullopt;
}

void LasCompatibility::restore(const std::byte* records, std::size_t record_length,
                               PointChunk& chunk) const {
  constexpr unsigned kFour = 15U, kOverlap = 1U, kOverlapFlag = 1U << 3U;
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    const std::byte* record = records + i * record_length;
    const unsigned returns = byteAt(record + returns_), flags = byteAt(record + flags_);
    const auto raised = [](std::uint8_t value, unsigned by) {
      return static_cast<std::uint8_t>(value + by);
    };
    chunk.return_number[i] = raised(chunk.return_number[i], returns >> 4U) & kFour;
    chunk.number_of_returns[i] = raised(chunk.number_of_returns[i], returns & kFour) & kFour;
    chunk.classification[i] = raised(chunk.classification[i], byteAt(record + classification_));
    chunk.flags[i] =
        static_cast<std::uint8_t>(chunk.flags[i] | ((flags & kOverlap) != 0 ? kOverlapFlag : 0U) |
                                  ((flags >> 1U & 3U) << 6U));
    chunk.channel[i] = chunk.flags[i] >> 6U;
    // Whole degrees are rounded to steps of 0.006 degrees; the field is what is missing to them.
    const double steps = std::round(static_cast<double>(chunk.scan_angle[i]) / kLasScanAngleStep) +
                         loadLas<std::int16_t>(record + angle_);
    chunk.scan_angle[i] = static_cast<float>(steps) * static_cast<float>(kLasScanAngleStep);
  }
}

}  // namespace pcl_als
