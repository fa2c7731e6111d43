// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "laz.h"

#include <algorithm>

#include <pcl_als/common/errors.h>

#include "byte_source.h"
#include "chunk_table.h"
#include "las_bytes.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kUserAt = 2, kRecordAt = 18, kLengthAt = 20, kDescriptionAt = 22;

void checkAgainst(const LazSchema& schema, const LasHeader& header, const std::string& name) {
  if (schema.recordLength() != header.record_length)
    throw InputError(name + ": the record \"laszip encoded\" describes points of " +
                     std::to_string(schema.recordLength()) + " bytes, the header points of " +
                     std::to_string(header.record_length));
  if (schema.layered() != (header.point_format >= 6))
    throw InputError(name + ": the record \"laszip encoded\" does not describe point format " +
                     std::to_string(header.point_format));
}

}  // namespace

std::unique_ptr<LazPointReader> openLazPoints(const InputFile& file, const LasHeader& header,
                                              const std::vector<std::byte>& payload,
                                              unsigned fields, bool keep_intact) {
  LazSchema schema = LazSchema::parse(reinterpret_cast<const std::uint8_t*>(payload.data()),
                                      payload.size(), file.name());
  checkAgainst(schema, header, file.name());
  LazPoints points;
  points.offset_to_points = header.offset_to_points;
  points.file_size = file.size();
  points.point_count = header.point_count;
  points.fields = fields;
  points.keep_intact = keep_intact;
  const auto read = [&file](std::uint64_t position, std::size_t bytes, void* out) {
    file.read(position, bytes, out);
  };
  return std::make_unique<LazPointReader>(std::move(schema), read, points, file.name());
}

LazExtent readLazExtent(const InputFile& file, const LasHeader& header,
                        const std::vector<std::byte>& payload) {
  const auto read = [&file](std::uint64_t position, std::size_t bytes, void* out) {
    file.read(position, bytes, out);
  };
  LazExtent extent;
  try {
    const LazSchema schema = LazSchema::parse(reinterpret_cast<const std::uint8_t*>(payload.data()),
                                              payload.size(), file.name());
    // A table of no points would not be read.
    const std::uint64_t points = std::max<std::uint64_t>(1, header.point_count);
    const laz::ChunkTable table =
        laz::readChunkTable(schema, read, {header.offset_to_points, file.size(), points}, true);
    extent.end = table.end;
    for (const laz::Chunk& chunk : table.chunks)
      if (chunk.first >= header.point_count) extent.surplus_bytes += chunk.end - chunk.begin;
  } catch (const laz::Damage&) {
    // Where the points of such a file end is not known.
  }
  return extent;
}

std::vector<std::byte> lazVlr(const LazSchema& schema) {
  const std::vector<std::uint8_t> payload = schema.serialise();
  std::vector<std::byte> vlr(kLasVlrHeader);
  putTextField(&vlr[kUserAt], 16, kLazUser);
  storeLas(&vlr[kRecordAt], kLazRecord);
  storeLas(&vlr[kLengthAt], static_cast<std::uint16_t>(payload.size()));
  putTextField(&vlr[kDescriptionAt], 32, "compression of the points");
  for (const std::uint8_t byte : payload) vlr.push_back(std::byte{byte});
  return vlr;
}

}  // namespace pcl_als::detail
