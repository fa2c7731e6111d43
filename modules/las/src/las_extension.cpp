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

constexpr const char* kSpecUser = "LASF_Spec";
constexpr std::uint16_t kExtraBytesRecord = 4;
constexpr std::size_t kOffsetToPoints = 96, kVlrCount = 100, kRecordLength = 105;
constexpr std::size_t kVlrUser = 2, kVlrId = 18, kVlrLength = 20;
constexpr std::size_t kMost16 = std::numeric_limits<std::uint16_t>::max();
/// Bytes that one descriptor of undocumented extra bytes can speak for.
constexpr std::size_t kMostUndocumented = 255;

bool isExtraBytes(const std::string& user, std::uint16_t id) {
  return user == kSpecUser && id == kExtraBytesRecord;
}

/// Descriptors for the record's bytes that no field of the file speaks for.
std::vector<LasExtraField> undocumented(const LasFile& file) {
  std::size_t end = file.layout().length;
  for (const LasExtraField& field : file.extraFields()) {
    end = std::max(end, field.position + field.size);
  }
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

/// Start of the extra-bytes VLR in the head; 0 where there is none.
std::size_t findExtraBytes(const detail::LasHead& head) {
  std::size_t at = head.header.header_size;
  for (std::uint32_t i = 0; i < head.header.vlr_count; ++i) {
    if (at + kLasVlrHeader > head.bytes.size()) return 0;
    const std::string user = detail::textField(&head.bytes[at + kVlrUser], 16);
    if (isExtraBytes(user, loadLas<std::uint16_t>(&head.bytes[at + kVlrId]))) return at;
    at += kLasVlrHeader + loadLas<std::uint16_t>(&head.bytes[at + kVlrLength]);
  }
  return 0;
}

void insert(detail::LasHead& head, std::size_t at, const std::vector<std::byte>& bytes) {
  head.bytes.insert(head.bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin(),
                    bytes.end());
  head.vlrs_end += bytes.size();
  head.header.offset_to_points += static_cast<std::uint32_t>(bytes.size());
}

void describe(detail::LasHead& head, const std::vector<std::byte>& descriptors,
              const std::string& name) {
  const std::size_t vlr = findExtraBytes(head);
  if (vlr == 0) {
    LasVlr made{kSpecUser, kExtraBytesRecord, "Extra Bytes Record", descriptors};
    insert(head, head.vlrs_end, serialiseLasVlr(made));
    head.header.vlr_count += 1;
    return;
  }
  const std::size_t length = loadLas<std::uint16_t>(&head.bytes[vlr + kVlrLength]);
  if (length + descriptors.size() > kMost16)
    throw InputError(name + ": its extra-bytes record is full; no further field can be described");
  storeLas(&head.bytes[vlr + kVlrLength], static_cast<std::uint16_t>(length + descriptors.size()));
  insert(head, vlr + kLasVlrHeader + length, descriptors);
}

}  // namespace

std::vector<LasExtraField> placeExtension(const LasFile& input,
                                          const std::vector<LasExtraField>& fields) {
  const std::string name = input.path().string();
  for (const LasVlrEntry& vlr : input.vlrs()) {
    if (vlr.extended && isExtraBytes(vlr.user_id, vlr.record_id))
      throw InputError(name +
                       ": describes its extra bytes in an extended VLR, which cannot be "
                       "added to; write it anew with a plain VLR");
  }
  std::vector<LasExtraField> placed = fields;
  std::size_t position = input.header().record_length;
  for (LasExtraField& field : placed) {
    for (const LasExtraField& other : input.extraFields()) {
      if (other.name == field.name)
        throw UsageError(name + ": has an extra field " + field.name + " already");
    }
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
  std::vector<LasExtraField> described = undocumented(file);
  described.insert(described.end(), placed.begin(), placed.end());
  describe(head, serialiseLasExtraFields(described), file.path().string());
  head.header.record_length =
      static_cast<std::uint16_t>(placed.back().position + placed.back().size);
  storeLas(&head.bytes[kOffsetToPoints], head.header.offset_to_points);
  storeLas(&head.bytes[kVlrCount], head.header.vlr_count);
  storeLas(&head.bytes[kRecordLength], head.header.record_length);
  return head;
}

}  // namespace detail
}  // namespace pcl_als
