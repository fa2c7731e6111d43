// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "las_extension.h"

#include <algorithm>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_rewriter.h>

#include "las_bytes.h"

namespace pcl_als {
namespace {

constexpr std::size_t kRecordLengthAt = 105;
constexpr std::size_t kMost16 = std::numeric_limits<std::uint16_t>::max();
/// Bytes that one descriptor of undocumented extra bytes can describe.
constexpr std::size_t kMostUndocumented = 255;

/// Descriptors of the bytes of the record that no field of the file describes.
std::vector<LasExtraField> undocumented(const LasFile& file) {
  std::size_t end = file.extraBytes().end;
  std::vector<LasExtraField> fields;
  while (end < file.header().record_length) {
    LasExtraField field;
    field.name = "undocumented";
    field.type = LasExtraType::undocumented;
    field.size = std::min(kMostUndocumented, file.header().record_length - end);
    end += field.size;
    fields.push_back(field);
  }
  return fields;
}

/// Replaces the descriptions of extra bytes by one of all bytes of the longer records.
void describe(const LasFile& file, const std::vector<LasExtraField>& placed,
              detail::LasHead& head) {
  LasVlr vlr{kLasSpecUser, kLasExtraBytesRecord, "Extra Bytes Record",
             file.extraBytes().descriptors};
  for (const auto& fields : {undocumented(file), placed}) {
    const std::vector<std::byte> descriptors = serialiseLasExtraFields(fields);
    vlr.data.insert(vlr.data.end(), descriptors.begin(), descriptors.end());
  }
  if (vlr.data.size() > kMost16)
    throw InputError(file.path().string() + ": a VLR describes at most " +
                     std::to_string(kMost16 / kLasExtraDescriptor) +
                     " extra fields; with the new ones there would be " +
                     std::to_string(vlr.data.size() / kLasExtraDescriptor));
  const std::size_t at = detail::eraseVlrs(head, detail::describesExtraBytes);
  insertVlr(head, at, serialiseLasVlr(vlr));
}

}  // namespace

std::vector<LasExtraField> placeExtension(const LasFile& input,
                                          const std::vector<LasExtraField>& fields) {
  const std::string name = input.path().string();
  std::vector<LasExtraField> placed = fields;
  std::size_t position = input.header().record_length;
  for (LasExtraField& field : placed) {
    for (const LasExtraField& other : input.extraFields())
      if (other.name == field.name)
        throw UsageError(name + ": has an extra field " + field.name + " already");
    field.size = lasExtraSize(field);
    field.position = position;
    position += field.size;
  }
  if (position > kMost16)
    throw UsageError(name + ": its records have no room for the extra fields");
  return placed;
}

namespace detail {

LasHead extendedHead(const LasFile& file, const std::vector<LasExtraField>& fields) {
  LasHead head = readLasHead(file);
  if (fields.empty()) return head;
  const std::vector<LasExtraField> placed = placeExtension(file, fields);
  describe(file, placed, head);
  head.header.record_length =
      static_cast<std::uint16_t>(placed.back().position + placed.back().size);
  storeLas(&head.bytes[kRecordLengthAt], head.header.record_length);
  return head;
}

}  // namespace detail
}  // namespace pcl_als
