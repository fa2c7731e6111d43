// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "laz_codec_target.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/laz_point_reader.h>

namespace pcl_als::fuzz {
namespace {

constexpr std::size_t kFormat = 104, kOffset = 96, kHeader = 94, kCount = 107, kLongCount = 247;
constexpr std::size_t kLeast = 375 + 54;

template <typename T>
T number(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// The points in order, and again as ranges from several places: the same bytes, or a refusal.
void decode(const LazSchema& schema, const LazReadAt& read, const LazPoints& points) {
  constexpr std::uint64_t most_bytes = std::uint64_t{1} << 20U;
  const std::size_t length = schema.recordLength();
  const std::uint64_t count = std::min<std::uint64_t>(points.point_count, most_bytes / length);
  std::vector<std::uint8_t> in_order(count * length), again(count * length);
  LazPointReader(schema, read, points, "a.laz").read(0, count, in_order.data());
  LazPointReader reader(schema, read, points, "a.laz");
  std::vector<LasRecordRange> ranges;
  for (std::uint64_t first = 0; first < count; first += 70)
    ranges.push_back({first, std::min<std::uint64_t>(70, count - first)});
  std::reverse(ranges.begin(), ranges.end());
  reader.read(ranges, again.data());
  const std::uint8_t* at = again.data();
  for (const LasRecordRange& range : ranges) {
    if (!std::equal(at, at + range.count * length, &in_order[range.first * length])) std::abort();
    at += range.count * length;
  }
}

}  // namespace

bool lazCodec(const std::uint8_t* data, std::size_t size) {
  if (size < kLeast) return false;
  const std::size_t vlr = number<std::uint16_t>(data + kHeader);
  if (vlr + 54 > size) return false;
  const std::size_t payload =
      std::min<std::size_t>(size - vlr - 54, number<std::uint16_t>(data + vlr + 20));
  LazPoints points;
  points.offset_to_points = number<std::uint32_t>(data + kOffset);
  points.file_size = size;
  points.point_count = (data[kFormat] & 63U) < 6 ? number<std::uint32_t>(data + kCount)
                                                 : number<std::uint64_t>(data + kLongCount);
  points.threads = 1;
  if (points.offset_to_points > size) return false;
  const LazReadAt read = [data, size](std::uint64_t position, std::size_t bytes, void* out) {
    if (position > size || bytes > size - position) std::abort();  // the reader knows the size
    std::memcpy(out, data + position, bytes);
  };
  try {
    const LazSchema schema = LazSchema::parse(data + vlr + 54, payload, "a.laz");
    decode(schema, read, points);
    points.keep_intact = true;
    if (points.point_count < 100000 && schema.recordLength() < 1000)
      LazPointReader(schema, read, points, "a.laz").findIntact();
  } catch (const Error&) {
    return false;
  }
  return true;
}

}  // namespace pcl_als::fuzz
