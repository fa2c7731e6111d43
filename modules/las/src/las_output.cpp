// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "las_output.h"

#include <algorithm>
#include <limits>

#include <sys/stat.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>

#include "las_bytes.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kOffsetToPoints = 96, kVlrCount = 100, kFormat = 104;
constexpr std::size_t kLegacyCounts = 107, kLegacyCountsEnd = 131, kCounts = 247, kCountsEnd = 375;
constexpr std::size_t kTimes = 375, kTimesEnd = 391;
constexpr std::size_t kBoxBytes = 48;
constexpr std::uint8_t kCompressed = 0x80;

/// Stores the fields of the header that the record of the compression changes.
void storeChanged(LasHead& head, bool compressed) {
  const LasHeader& h = head.header;
  storeLas(&head.bytes[kOffsetToPoints], h.offset_to_points);
  storeLas(&head.bytes[kVlrCount], h.vlr_count);
  const std::uint8_t format = compressed ? h.point_format | kCompressed : h.point_format;
  storeLas(&head.bytes[kFormat], format);
}

constexpr std::size_t kVlrUser = 2, kVlrId = 18, kVlrLength = 20;

}  // namespace

bool describesChunks(const std::string& user_id, std::uint16_t record_id) {
  return (user_id == kLazUser && record_id == kLazRecord) || user_id == kCopcUser;
}

bool describesExtraBytes(const std::string& user_id, std::uint16_t record_id) {
  return user_id == kLasSpecUser && record_id == kLasExtraBytesRecord;
}

std::size_t eraseVlrs(LasHead& head, const VlrKind& is_erased) {
  std::size_t first = 0;
  for (std::size_t at = head.header.header_size; at < head.vlrs_end;) {
    const std::size_t size = kLasVlrHeader + loadLas<std::uint16_t>(&head.bytes[at + kVlrLength]);
    if (!is_erased(textField(&head.bytes[at + kVlrUser], 16),
                   loadLas<std::uint16_t>(&head.bytes[at + kVlrId]))) {
      at += size;
      continue;
    }
    const auto begin = head.bytes.begin() + static_cast<std::ptrdiff_t>(at);
    head.bytes.erase(begin, begin + static_cast<std::ptrdiff_t>(size));
    head.vlrs_end -= size;
    head.header.offset_to_points -= static_cast<std::uint32_t>(size);
    head.header.vlr_count -= 1;
    if (first == 0) first = at;
  }
  storeChanged(head, false);
  return first == 0 ? head.vlrs_end : first;
}

void insertVlr(LasHead& head, std::size_t at, const std::vector<std::byte>& vlr) {
  head.bytes.insert(head.bytes.begin() + static_cast<std::ptrdiff_t>(at), vlr.begin(), vlr.end());
  head.vlrs_end += vlr.size();
  head.header.offset_to_points += static_cast<std::uint32_t>(vlr.size());
  head.header.vlr_count += 1;
  storeChanged(head, false);
}

LasHead readLasHead(const LasFile& file) {
  LasHead head;
  head.header = file.header();
  head.bytes.resize(head.header.offset_to_points);
  file.readBytes(0, head.bytes.size(), head.bytes.data());
  head.vlrs_end = head.header.header_size;
  for (const LasVlrEntry& vlr : file.vlrs())
    if (!vlr.extended) head.vlrs_end = vlr.position + vlr.length;
  const bool compressed = head.header.compressed;
  head.header.compressed = false;
  storeChanged(head, false);
  if (!compressed) return head;
  eraseVlrs(head, describesChunks);
  return head;
}

LasOutput::LasOutput(const std::filesystem::path& path, LasHead head, int threads)
    : name_(path.string()), file_(path), record_length_(head.header.record_length) {
  const LazSchema schema = LazSchema::forFormat(head.header.point_format, record_length_);
  const bool compressed = lowerExtension(path) == ".laz";
  if (compressed) {
    insertVlr(head, head.vlrs_end, lazVlr(schema));
    storeChanged(head, true);
  }
  offset_to_points_ = head.header.offset_to_points;
  file_.write(head.bytes.data(), head.bytes.size());
  if (!compressed) return;
  const auto write = [this](std::uint64_t position, std::size_t bytes, const void* data) {
    file_.writeAt(position, data, bytes);
  };
  laz_ = std::make_unique<LazPointWriter>(schema, write, offset_to_points_, threads);
}

void LasOutput::append(const std::byte* records, std::size_t count) {
  if (laz_)
    laz_->write(records, count);
  else
    file_.write(records, count * record_length_);
}

void LasOutput::putAt(std::uint64_t first, const std::byte* records, std::size_t count) {
  const std::lock_guard<std::mutex> lock(one_writer_);
  file_.writeAt(offset_to_points_ + first * record_length_, records, count * record_length_);
}

std::uint64_t LasOutput::endPoints() {
  if (laz_) return laz_->finish();
  struct stat status {};
  fstat(file_.descriptor(), &status);
  return static_cast<std::uint64_t>(status.st_size);
}

void LasOutput::put(std::uint64_t position, const std::byte* bytes, std::size_t count) {
  file_.writeAt(position, bytes, count);
}

void LasOutput::putCounts(const LasHeader& header) {
  if (header.version_minor < 4 && header.point_count > std::numeric_limits<std::uint32_t>::max())
    throw InputError(name_ + ": LAS 1." + std::to_string(header.version_minor) +
                     " cannot hold more than 4294967295 points; use LAS 1.4");
  // Only these: compression changes other fields of the header.
  const std::vector<std::byte> bytes = serialiseLasHeader(header);
  const auto store = [&](std::size_t begin, std::size_t end) {
    put(begin, &bytes[begin], end - begin);
  };
  store(kLegacyCounts, kLegacyCountsEnd);
  store(kLasBoxPosition, kLasBoxPosition + kBoxBytes);
  if (header.version_minor >= 4) store(kCounts, kCountsEnd);
  if (header.version_minor >= 5) store(kTimes, kTimesEnd);
}

}  // namespace pcl_als::detail
