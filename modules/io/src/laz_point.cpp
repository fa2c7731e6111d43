// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "laz_point.h"

#include <algorithm>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kRgb = 6, kNir = 2, kWaveform = 29;

void packBits(const laszip_point_struct& point, const LasRecordLayout& layout, std::byte* record) {
  if (!layout.extended) {
    record[14] =
        static_cast<std::byte>(point.return_number | point.number_of_returns << 3 |
                               point.scan_direction_flag << 6 | point.edge_of_flight_line << 7);
    record[15] = static_cast<std::byte>(point.classification | point.synthetic_flag << 5 |
                                        point.keypoint_flag << 6 | point.withheld_flag << 7);
    storeLas(record + layout.scan_angle, point.scan_angle_rank);
    return;
  }
  record[14] =
      static_cast<std::byte>(point.extended_return_number | point.extended_number_of_returns << 4);
  record[15] = static_cast<std::byte>(
      point.extended_classification_flags | point.extended_scanner_channel << 4 |
      point.scan_direction_flag << 6 | point.edge_of_flight_line << 7);
  storeLas(record + layout.classification, point.extended_classification);
  storeLas(record + layout.scan_angle, point.extended_scan_angle);
}

void unpackExtendedBits(const std::byte* record, const LasRecordLayout& layout,
                        laszip_point_struct& point) {
  const auto returns = std::to_integer<unsigned>(record[14]);
  const auto flags = std::to_integer<unsigned>(record[15]);
  const auto type = std::to_integer<unsigned>(record[layout.classification]);
  point.extended_point_type = 1;
  point.extended_return_number = returns & 15U;
  point.extended_number_of_returns = returns >> 4U;
  point.extended_classification_flags = flags & 15U;
  point.extended_scanner_channel = (flags >> 4U) & 3U;
  point.scan_direction_flag = (flags >> 6U) & 1U;
  point.edge_of_flight_line = flags >> 7U;
  point.extended_classification = static_cast<laszip_U8>(type);
  point.extended_scan_angle = loadLas<std::int16_t>(record + layout.scan_angle);
  // LASzip wants the fields of the old formats to agree with the new ones.
  point.return_number = std::min(7U, returns & 15U);
  point.number_of_returns = std::min(7U, returns >> 4U);
  point.synthetic_flag = flags & 1U;
  point.keypoint_flag = (flags >> 1U) & 1U;
  point.withheld_flag = (flags >> 2U) & 1U;
  point.classification = type <= 31U ? type : 0U;
}

void unpackLegacyBits(const std::byte* record, const LasRecordLayout& layout,
                      laszip_point_struct& point) {
  const auto returns = std::to_integer<unsigned>(record[14]);
  const auto type = std::to_integer<unsigned>(record[15]);
  point.extended_point_type = 0;
  point.return_number = returns & 7U;
  point.number_of_returns = (returns >> 3U) & 7U;
  point.scan_direction_flag = (returns >> 6U) & 1U;
  point.edge_of_flight_line = returns >> 7U;
  point.classification = type & 31U;
  point.synthetic_flag = (type >> 5U) & 1U;
  point.keypoint_flag = (type >> 6U) & 1U;
  point.withheld_flag = type >> 7U;
  point.scan_angle_rank = loadLas<std::int8_t>(record + layout.scan_angle);
}

}  // namespace

void packLazPoint(const laszip_point_struct& point, const LasRecordLayout& layout,
                  std::size_t record_length, std::byte* record) {
  storeLas(record, point.X);
  storeLas(record + 4, point.Y);
  storeLas(record + 8, point.Z);
  storeLas(record + 12, point.intensity);
  packBits(point, layout, record);
  storeLas(record + layout.user_data, point.user_data);
  storeLas(record + layout.point_source_id, point.point_source_ID);
  if (layout.gps_time >= 0) storeLas(record + layout.gps_time, point.gps_time);
  if (layout.rgb >= 0) std::memcpy(record + layout.rgb, point.rgb, kRgb);
  if (layout.nir >= 0) std::memcpy(record + layout.nir, &point.rgb[3], kNir);
  if (layout.waveform >= 0) std::memcpy(record + layout.waveform, point.wave_packet, kWaveform);
  const std::size_t extra = record_length - layout.length;
  if (extra > 0) std::memcpy(record + layout.length, point.extra_bytes, extra);
}

void unpackLazPoint(const std::byte* record, const LasRecordLayout& layout,
                    std::size_t record_length, laszip_point_struct& point) {
  point.X = loadLas<std::int32_t>(record);
  point.Y = loadLas<std::int32_t>(record + 4);
  point.Z = loadLas<std::int32_t>(record + 8);
  point.intensity = loadLas<std::uint16_t>(record + 12);
  if (layout.extended)
    unpackExtendedBits(record, layout, point);
  else
    unpackLegacyBits(record, layout, point);
  point.user_data = loadLas<std::uint8_t>(record + layout.user_data);
  point.point_source_ID = loadLas<std::uint16_t>(record + layout.point_source_id);
  if (layout.gps_time >= 0) point.gps_time = loadLas<double>(record + layout.gps_time);
  if (layout.rgb >= 0) std::memcpy(point.rgb, record + layout.rgb, kRgb);
  if (layout.nir >= 0) std::memcpy(&point.rgb[3], record + layout.nir, kNir);
  if (layout.waveform >= 0) std::memcpy(point.wave_packet, record + layout.waveform, kWaveform);
  const std::size_t extra = record_length - layout.length;
  if (extra > 0) std::memcpy(point.extra_bytes, record + layout.length, extra);
}

}  // namespace pcl_als::detail
