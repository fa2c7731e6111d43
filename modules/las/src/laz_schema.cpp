// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstring>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/laz_schema.h>

#include "point_context.h"

namespace pcl_als {
namespace {

using laz::load;
using laz::store;

constexpr std::size_t kFixedPart = 34, kItemPart = 6;
constexpr std::size_t kCompressor = 0, kCoder = 2, kVersion = 4, kOptions = 8, kChunkSize = 12,
                      kSpecialEvlrs = 16, kItemCount = 32;
// The version of LASzip's format that has everything written here.
constexpr std::uint8_t kMajor = 3, kMinor = 4;

/// Size and versions of an item; size 0: any.
struct Kind {
  std::uint16_t size, oldest, newest;
  bool layered;
};

const Kind* kindOf(LazItemType type) {
  static const Kind bytes{0, 1, 2, false}, point10{20, 1, 2, false}, gps_time11{8, 1, 2, false},
      rgb12{6, 1, 2, false}, wave_packet13{29, 1, 1, false}, point14{30, 2, 4, true},
      rgb14{6, 2, 4, true}, rgb_nir14{8, 2, 4, true}, wave_packet14{29, 3, 4, true},
      bytes14{0, 2, 4, true};
  switch (type) {
    case LazItemType::bytes:
      return &bytes;
    case LazItemType::point10:
      return &point10;
    case LazItemType::gps_time11:
      return &gps_time11;
    case LazItemType::rgb12:
      return &rgb12;
    case LazItemType::wave_packet13:
      return &wave_packet13;
    case LazItemType::point14:
      return &point14;
    case LazItemType::rgb14:
      return &rgb14;
    case LazItemType::rgb_nir14:
      return &rgb_nir14;
    case LazItemType::wave_packet14:
      return &wave_packet14;
    case LazItemType::bytes14:
      return &bytes14;
  }
  return nullptr;
}

[[noreturn]] void refuse(const std::string& name, const std::string& what) {
  throw InputError(name + ": the record \"laszip encoded\" " + what);
}

void checkItem(const LazItem& item, bool layered, bool first, const std::string& name) {
  const Kind* kind = kindOf(item.type);
  const std::string label = "item of type " + std::to_string(static_cast<unsigned>(item.type));
  if (kind == nullptr) refuse(name, "has an " + label + ", which is unknown");
  if (kind->layered != layered) refuse(name, "has an " + label + ", which its compressor lacks");
  if (item.size == 0 || (kind->size != 0 && item.size != kind->size))
    refuse(name, "has an " + label + " of " + std::to_string(item.size) + " bytes");
  if (item.version < kind->oldest || item.version > kind->newest)
    refuse(name, "has an " + label + " of version " + std::to_string(item.version) +
                     ", which is unknown");
  const bool leads = item.type == LazItemType::point10 || item.type == LazItemType::point14;
  if (leads != first) refuse(name, "does not begin with the one item of the coordinates");
}

void check(const LazSchema& schema, const std::string& name) {
  for (std::size_t i = 0; i < schema.items.size(); ++i)
    checkItem(schema.items[i], schema.layered(), i == 0, name);
  if (schema.recordLength() > 0xFFFF) refuse(name, "describes points of more than 65535 bytes");
}

}  // namespace

LazSchema LazSchema::forFormat(int format, std::size_t record_length, std::uint32_t chunk_size) {
  const bool layered = format >= 6;
  const bool colour =
      format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
  const bool infrared = format == 8 || format == 10;
  const bool wave = format == 4 || format == 5 || format == 9 || format == 10;
  const std::uint16_t version = layered ? 3 : 2;
  LazSchema schema;
  schema.compressor = layered ? LazCompressor::layered_chunked : LazCompressor::pointwise_chunked;
  schema.chunk_size = chunk_size;
  const auto add = [&schema](LazItemType type, std::size_t size, std::uint16_t item_version) {
    schema.items.push_back({type, static_cast<std::uint16_t>(size), item_version});
  };
  add(layered ? LazItemType::point14 : LazItemType::point10, layered ? 30 : 20, version);
  if (!layered && format != 0 && format != 2) add(LazItemType::gps_time11, 8, version);
  if (infrared) add(LazItemType::rgb_nir14, 8, version);
  if (colour && !infrared) add(layered ? LazItemType::rgb14 : LazItemType::rgb12, 6, version);
  if (wave) {
    if (layered)
      add(LazItemType::wave_packet14, 29, version);
    else
      add(LazItemType::wave_packet13, 29, 1);
  }
  const std::size_t standard = schema.recordLength();
  if (format < 0 || format > 10 || record_length < standard)
    throw UsageError("point format " + std::to_string(format) + " has no records of " +
                     std::to_string(record_length) + " bytes");
  if (record_length > standard)
    add(layered ? LazItemType::bytes14 : LazItemType::bytes, record_length - standard, version);
  return schema;
}

LazSchema LazSchema::parse(const std::uint8_t* payload, std::size_t size, const std::string& name) {
  if (size < kFixedPart) refuse(name, "is too short");
  const auto compressor = load<std::uint16_t>(payload + kCompressor);
  if (compressor < 1 || compressor > 3)
    refuse(name, "names compressor " + std::to_string(compressor) + ", which is unknown");
  if (load<std::uint16_t>(payload + kCoder) != 0)
    refuse(name, "names an entropy coder that is unknown");
  const std::size_t items = load<std::uint16_t>(payload + kItemCount);
  if (items == 0 || size < kFixedPart + items * kItemPart)
    refuse(name, "does not hold the items that it announces");
  LazSchema schema;
  schema.compressor = static_cast<LazCompressor>(compressor);
  schema.chunk_size = load<std::uint32_t>(payload + kChunkSize);
  if (schema.chunk_size == 0) schema.chunk_size = kLazVariableChunks;
  for (std::size_t i = 0; i < items; ++i) {
    const std::uint8_t* at = payload + kFixedPart + i * kItemPart;
    schema.items.push_back({static_cast<LazItemType>(load<std::uint16_t>(at)),
                            load<std::uint16_t>(at + 2), load<std::uint16_t>(at + 4)});
  }
  check(schema, name);
  return schema;
}

std::vector<std::uint8_t> LazSchema::serialise() const {
  std::vector<std::uint8_t> payload(kFixedPart + items.size() * kItemPart);
  store(&payload[kCompressor], static_cast<std::uint16_t>(compressor));
  payload[kVersion] = kMajor;
  payload[kVersion + 1] = kMinor;
  store(&payload[kOptions], std::uint32_t{0});
  store(&payload[kChunkSize], chunk_size);
  std::memset(&payload[kSpecialEvlrs], 0xFF, 16);  // number and position: none
  store(&payload[kItemCount], static_cast<std::uint16_t>(items.size()));
  std::uint8_t* at = payload.data() + kFixedPart;
  for (const LazItem& item : items) {
    store(at, static_cast<std::uint16_t>(item.type));
    store(at + 2, item.size);
    store(at + 4, item.version);
    at += kItemPart;
  }
  return payload;
}

std::size_t LazSchema::recordLength() const {
  std::size_t length = 0;
  for (const LazItem& item : items) length += item.size;
  return length;
}

}  // namespace pcl_als
