// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "laz.h"

#include <pcl_als/common/errors.h>

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
