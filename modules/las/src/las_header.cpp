// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>
#include <pcl_als/las/damaged_file.h>
#include <pcl_als/las/las_header.h>
#include <pcl_als/las/las_record.h>

#include "las_bytes.h"

// Byte positions are those of LAS 1.5 R00, table "Public Header Block"; older versions have the
// same up to their end.
namespace pcl_als {
namespace {

using detail::putTextField;
using detail::textField;

constexpr std::size_t kShortestHeader = 227;
constexpr std::uint8_t kCompressionBits = 0xC0;
constexpr double kLargestScale = 1e6;  // metres; also keeps every coordinate finite
constexpr double kLegacyLimit = 4294967295.0;

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw InputError(name + ": " + what);
}

void checkSignature(const std::byte* bytes, std::size_t available, std::uint64_t file_size,
                    const std::string& name) {
  if (file_size == 0) fail(name, "the file is empty");
  if (available < 4 || std::memcmp(bytes, "LASF", 4) != 0)
    fail(name, "is not a LAS file (it does not begin with LASF)");
  if (available < kShortestHeader)
    fail(name, "the LAS header is truncated (" + std::to_string(available) + " of at least " +
                   std::to_string(kShortestHeader) + " bytes)");
}

void readBlock(const std::byte* bytes, LasHeader& h) {
  h.file_source_id = loadLas<std::uint16_t>(bytes + 4);
  h.global_encoding = loadLas<std::uint16_t>(bytes + 6);
  std::memcpy(h.project_id.data(), bytes + 8, 16);
  h.system_id = textField(bytes + 26, 32);
  h.generating_software = textField(bytes + 58, 32);
  h.creation_day = loadLas<std::uint16_t>(bytes + 90);
  h.creation_year = loadLas<std::uint16_t>(bytes + 92);
  h.offset_to_points = loadLas<std::uint32_t>(bytes + 96);
  h.vlr_count = loadLas<std::uint32_t>(bytes + 100);
  const auto format = loadLas<std::uint8_t>(bytes + 104);
  h.compressed = (format & kCompressionBits) != 0;
  h.point_format = format & static_cast<std::uint8_t>(~kCompressionBits);
  h.record_length = loadLas<std::uint16_t>(bytes + 105);
  h.legacy_point_count = loadLas<std::uint32_t>(bytes + 107);
  h.point_count = h.legacy_point_count;
  for (int i = 0; i < 5; ++i) h.points_by_return[i] = loadLas<std::uint32_t>(bytes + 111 + 4 * i);
  for (int axis = 0; axis < 3; ++axis) {
    h.scale[axis] = loadLas<double>(bytes + 131 + 8 * axis);
    h.offset[axis] = loadLas<double>(bytes + 155 + 8 * axis);
    h.maximum[axis] = loadLas<double>(bytes + kLasBoxPosition + 16 * axis);
    h.minimum[axis] = loadLas<double>(bytes + kLasBoxPosition + 16 * axis + 8);
  }
}

void readNewerFields(const std::byte* bytes, LasHeader& h) {
  if (h.version_minor >= 3) h.waveform_start = loadLas<std::uint64_t>(bytes + 227);
  if (h.version_minor < 4) return;
  h.evlr_start = loadLas<std::uint64_t>(bytes + 235);
  h.evlr_count = loadLas<std::uint32_t>(bytes + 243);
  const auto count = loadLas<std::uint64_t>(bytes + 247);
  // Some writers of 1.4 fill in the legacy fields only.
  if (count == 0) return;
  h.point_count = count;
  for (int i = 0; i < 15; ++i) h.points_by_return[i] = loadLas<std::uint64_t>(bytes + 255 + 8 * i);
}

void readTimeFields(const std::byte* bytes, LasHeader& h) {
  if (h.version_minor < 5) return;
  h.latest_time = loadLas<double>(bytes + 375);
  h.earliest_time = loadLas<double>(bytes + 383);
  h.time_offset = loadLas<std::uint16_t>(bytes + 391);
}

void checkNumbers(const LasHeader& h, const std::string& name) {
  static const char* const axes[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const double step = std::abs(h.scale[axis]);
    if (step == 0.0)
      fail(name, std::string("the LAS header's ") + axes[axis] +
                     " scale is 0, so that all points would have the same coordinate; write the "
                     "file again with its scale");
    if (!(step <= kLargestScale))
      fail(name, std::string("the LAS header's ") + axes[axis] + " scale is " +
                     std::to_string(h.scale[axis]) + "; it must be a number of metres");
    if (!std::isfinite(h.offset[axis]))
      fail(name, std::string("the LAS header's ") + axes[axis] + " offset is not a number");
  }
}

void checkExtent(const LasHeader& h, std::uint64_t file_size, const std::string& name,
                 bool truncated) {
  if (h.offset_to_points < h.header_size)
    fail(name, "the points are said to begin at byte " + std::to_string(h.offset_to_points) +
                   ", inside the header");
  if (h.offset_to_points > file_size)
    fail(name, "the points are said to begin at byte " + std::to_string(h.offset_to_points) +
                   " of a file of " + std::to_string(file_size) + " bytes (truncated copy?)");
  const LasRecordLayout layout = LasRecordLayout::of(h.point_format);
  if (h.record_length < layout.length)
    fail(name, "point records of " + std::to_string(h.record_length) + " bytes are too short for " +
                   "point format " + std::to_string(h.point_format) + " (" +
                   std::to_string(layout.length) + ")");
  if (h.compressed || truncated) return;
  const std::uint64_t room = (file_size - h.offset_to_points) / h.record_length;
  if (h.point_count > room)
    throw DamagedFile(name + ": the header declares " + std::to_string(h.point_count) +
                      " points but the file holds " + std::to_string(room) + " (truncated copy?)");
}

void writeNewerFields(const LasHeader& h, std::byte* bytes) {
  if (h.version_minor >= 3) storeLas(bytes + 227, h.waveform_start);
  if (h.version_minor < 4) return;
  storeLas(bytes + 235, h.evlr_start);
  storeLas(bytes + 243, h.evlr_count);
  storeLas(bytes + 247, h.point_count);
  for (int i = 0; i < 15; ++i) storeLas(bytes + 255 + 8 * i, h.points_by_return[i]);
  if (h.version_minor < 5) return;
  storeLas(bytes + 375, h.latest_time);
  storeLas(bytes + 383, h.earliest_time);
  storeLas(bytes + 391, h.time_offset);
}

void writeLegacyCounts(const LasHeader& h, std::byte* bytes) {
  // Formats 6-10 and counts past 32 bits leave the legacy fields at zero (LAS 1.4 R15, 2.4).
  if (h.point_format >= 6 && h.version_minor >= 4) return;
  if (static_cast<double>(h.point_count) > kLegacyLimit) return;
  storeLas(bytes + 107, static_cast<std::uint32_t>(h.point_count));
  for (int i = 0; i < 5; ++i)
    storeLas(bytes + 111 + 4 * i, static_cast<std::uint32_t>(h.points_by_return[i]));
}

}  // namespace

std::uint16_t LasHeader::sizeOf(int version_minor) {
  if (version_minor >= 5) return static_cast<std::uint16_t>(kLargestLasHeader);
  if (version_minor == 4) return 375;
  return version_minor == 3 ? 235 : 227;
}

double LasHeader::timeShift() const {
  constexpr unsigned kOffsetTime = kLasAdjustedStandardTime | kLasTimeOffset;
  constexpr double kAdjusted = 1000.0, kUnit = 1e6;  // seconds
  if (version_minor < 5 || (global_encoding & kOffsetTime) != kOffsetTime) return 0.0;
  return (static_cast<double>(time_offset) - kAdjusted) * kUnit;
}

std::string LasHeader::sensor() const {
  // What the specification lists for files that a process made, and names of common writers.
  constexpr std::array<std::string_view, 10> kProcesses{
      "MERGE",      "MODIFICATION", "EXTRACTION", "TRANSFORMATION", "OTHER",
      "SIMULATION", "PDAL",         "LAStools",   "libLAS",         "laspy"};
  for (const std::string_view process : kProcesses)
    if (std::string_view(system_id).substr(0, process.size()) == process) return {};
  return printable(system_id, 32);
}

std::string LasHeader::describe() const {
  return std::string(compressed ? "LAZ" : "LAS") + " 1." + std::to_string(version_minor) +
         ", point format " + std::to_string(point_format);
}

LasHeader parseLasHeader(const std::byte* bytes, std::size_t available, std::uint64_t file_size,
                         const std::string& name, bool truncated) {
  checkSignature(bytes, available, file_size, name);
  LasHeader h;
  const auto major = loadLas<std::uint8_t>(bytes + 24);
  h.version_minor = loadLas<std::uint8_t>(bytes + 25);
  if (major != 1 || h.version_minor > 5)
    fail(name, "LAS version " + std::to_string(major) + "." + std::to_string(h.version_minor) +
                   " is not supported (1.0 to 1.5 are); write it as LAS 1.4 with the software that "
                   "made it");
  h.header_size = loadLas<std::uint16_t>(bytes + 94);
  const std::uint16_t needed = LasHeader::sizeOf(h.version_minor);
  if (h.header_size < needed)
    fail(name, "the LAS header says it has " + std::to_string(h.header_size) +
                   " bytes; version 1." + std::to_string(h.version_minor) + " has " +
                   std::to_string(needed));
  if (h.header_size > file_size || available < needed)
    fail(name, "the LAS header is truncated (" + std::to_string(file_size) + " of " +
                   std::to_string(h.header_size) + " bytes)");
  readBlock(bytes, h);
  readNewerFields(bytes, h);
  readTimeFields(bytes, h);
  if (h.point_format > 10)
    fail(name,
         "point format " + std::to_string(h.point_format) + " is not supported (0 to 10 are)");
  checkNumbers(h, name);
  checkExtent(h, file_size, name, truncated);
  return h;
}

std::vector<std::byte> serialiseLasHeader(const LasHeader& h) {
  std::vector<std::byte> bytes(h.header_size);
  std::byte* at = bytes.data();
  std::memcpy(at, "LASF", 4);
  storeLas(at + 4, h.file_source_id);
  storeLas(at + 6, h.global_encoding);
  std::memcpy(at + 8, h.project_id.data(), 16);
  storeLas(at + 24, std::uint8_t{1});
  storeLas(at + 25, static_cast<std::uint8_t>(h.version_minor));
  putTextField(at + 26, 32, h.system_id);
  putTextField(at + 58, 32, h.generating_software);
  storeLas(at + 90, h.creation_day);
  storeLas(at + 92, h.creation_year);
  storeLas(at + 94, h.header_size);
  storeLas(at + 96, h.offset_to_points);
  storeLas(at + 100, h.vlr_count);
  storeLas(at + 104, h.point_format);
  storeLas(at + 105, h.record_length);
  writeLegacyCounts(h, at);
  for (int axis = 0; axis < 3; ++axis) {
    storeLas(at + 131 + 8 * axis, h.scale[axis]);
    storeLas(at + 155 + 8 * axis, h.offset[axis]);
    storeLas(at + kLasBoxPosition + 16 * axis, h.maximum[axis]);
    storeLas(at + kLasBoxPosition + 16 * axis + 8, h.minimum[axis]);
  }
  writeNewerFields(h, at);
  return bytes;
}

std::vector<std::byte> serialiseLasVlr(const LasVlr& vlr, bool extended) {
  if (!extended && vlr.data.size() > std::numeric_limits<std::uint16_t>::max())
    throw UsageError("LAS record " + vlr.user_id + " " + std::to_string(vlr.record_id) +
                     ": its payload needs an extended VLR");
  std::vector<std::byte> bytes(extended ? kLasEvlrHeader : kLasVlrHeader);
  std::byte* at = bytes.data();
  putTextField(at + 2, 16, vlr.user_id);
  storeLas(at + 18, vlr.record_id);
  if (extended)
    storeLas(at + 20, static_cast<std::uint64_t>(vlr.data.size()));
  else
    storeLas(at + 20, static_cast<std::uint16_t>(vlr.data.size()));
  putTextField(at + (extended ? 28 : 22), 32, vlr.description);
  bytes.insert(bytes.end(), vlr.data.begin(), vlr.data.end());
  return bytes;
}

LasVlr lasCorrectionsVlr(const std::string& corrections) {
  LasVlr vlr{kLasCorrectionsUser, kLasCorrectionsRecord, "corrections applied by pcl_als", {}};
  const auto* bytes = reinterpret_cast<const std::byte*>(corrections.data());
  vlr.data.assign(bytes, bytes + corrections.size());
  return vlr;
}

}  // namespace pcl_als
