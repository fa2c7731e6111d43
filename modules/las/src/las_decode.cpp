// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/las/las_record.h>

#include "las_bytes.h"

namespace pcl_als {

using detail::byteAt;

namespace {

// Columns are filled for one block of records after the other, so that the records of a block stay
// in the first-level cache while every column passes over them.
constexpr std::size_t kBlock = 512;

struct Source {
  const std::byte* records;
  std::size_t stride;
  std::size_t count;

  template <typename Out, typename Convert>
  void column(int position, Out* out, Convert convert) const {
    const std::byte* at = records + position;
    for (std::size_t i = 0; i < count; ++i, at += stride) out[i] = convert(at);
  }
};

void decodeCoordinates(const Source& from, const Eigen::Vector3d& scale,
                       const Eigen::Vector3d& offset, double* x, double* y, double* z) {
  const double sx = scale.x(), sy = scale.y(), sz = scale.z();
  const double ox = offset.x(), oy = offset.y(), oz = offset.z();
  const std::byte* at = from.records;
  for (std::size_t i = 0; i < from.count; ++i, at += from.stride) {
    x[i] = loadLas<std::int32_t>(at) * sx + ox;
    y[i] = loadLas<std::int32_t>(at + 4) * sy + oy;
    z[i] = loadLas<std::int32_t>(at + 8) * sz + oz;
  }
}

// Formats 0-5: return number 3 bits, returns 3 bits, direction, edge; class 5 bits, 3 flag bits.
void decodeLegacyBits(const Source& from, PointChunk& to, std::size_t first) {
  from.column(14, &to.return_number[first],
              [](const std::byte* at) { return static_cast<std::uint8_t>(byteAt(at) & 7U); });
  from.column(14, &to.number_of_returns[first], [](const std::byte* at) {
    return static_cast<std::uint8_t>((byteAt(at) >> 3U) & 7U);
  });
  from.column(15, &to.classification[first],
              [](const std::byte* at) { return static_cast<std::uint8_t>(byteAt(at) & 31U); });
  // Bits 6 and 7 of byte 14 are scan direction and edge; 5 to 7 of byte 15 synthetic, key,
  // withheld.
  from.column(14, &to.flags[first], [](const std::byte* at) {
    return static_cast<std::uint8_t>(((byteAt(at) >> 2U) & 0x30U) | (byteAt(at + 1) >> 5U));
  });
  from.column(16, &to.scan_angle[first],
              [](const std::byte* at) { return static_cast<float>(loadLas<std::int8_t>(at)); });
  std::fill_n(&to.channel[first], from.count, std::uint8_t{0});
}

// Formats 6-10: return number 4 bits, returns 4 bits; flags 4 bits, channel 2, direction, edge.
void decodeExtendedBits(const Source& from, PointChunk& to, std::size_t first) {
  from.column(14, &to.return_number[first],
              [](const std::byte* at) { return static_cast<std::uint8_t>(byteAt(at) & 15U); });
  from.column(14, &to.number_of_returns[first],
              [](const std::byte* at) { return static_cast<std::uint8_t>(byteAt(at) >> 4U); });
  from.column(16, &to.classification[first], byteAt);
  // PointFlag keeps direction and edge in bits 4 and 5 and the scanner channel in 6 and 7.
  from.column(15, &to.flags[first], [](const std::byte* at) {
    const unsigned bits = byteAt(at);
    return static_cast<std::uint8_t>((bits & 15U) | ((bits >> 2U) & 0x30U) |
                                     ((bits << 2U) & 0xC0U));
  });
  from.column(15, &to.channel[first],
              [](const std::byte* at) { return static_cast<std::uint8_t>(byteAt(at) >> 4U & 3U); });
  from.column(18, &to.scan_angle[first], [](const std::byte* at) {
    return static_cast<float>(loadLas<std::int16_t>(at)) * static_cast<float>(kLasScanAngleStep);
  });
}

void decodeBlock(const Source& from, const LasRecordLayout& layout, const Eigen::Vector3d& scale,
                 const Eigen::Vector3d& offset, PointChunk& to, std::size_t first) {
  decodeCoordinates(from, scale, offset, &to.x[first], &to.y[first], &to.z[first]);
  from.column(12, &to.intensity[first],
              [](const std::byte* at) { return static_cast<float>(loadLas<std::uint16_t>(at)); });
  from.column(layout.point_source_id, &to.point_source_id[first], loadLas<std::uint16_t>);
  from.column(layout.user_data, &to.user_data[first], byteAt);
  from.column(0, &to.gps_time[first],
              [&layout](const std::byte* record) { return layout.timeOf(record); });
  if (layout.extended)
    decodeExtendedBits(from, to, first);
  else
    decodeLegacyBits(from, to, first);
}

}  // namespace

void decodeLasRecords(const std::byte* records, std::size_t count, std::size_t record_length,
                      const LasRecordLayout& layout, const Eigen::Vector3d& scale,
                      const Eigen::Vector3d& offset, PointChunk& chunk) {
  chunk.resize(count);
  for (std::size_t first = 0; first < count; first += kBlock) {
    const Source block{records + first * record_length, record_length,
                       std::min(kBlock, count - first)};
    decodeBlock(block, layout, scale, offset, chunk, first);
  }
}

}  // namespace pcl_als
