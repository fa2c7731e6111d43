// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cstring>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/las/external_waveforms.h>
#include <pcl_als/las/las_compatibility.h>
#include <pcl_als/las/las_version.h>

#include "las_crs.h"
#include "las_output.h"
#include "las_statistics.h"
#include "las_tail.h"

namespace pcl_als {
namespace {

constexpr int kFirstExtended = 6;
constexpr std::uint8_t kUnclassified = 1, kOverlapClass = 12;
constexpr std::size_t kCommonBytes = 14;  // X, Y, Z and intensity are alike in all formats

/// The point format of 1.5 that has the fields of another one.
std::uint8_t extendedFormat(std::uint8_t format) {
  constexpr std::uint8_t kExtended[] = {6, 6, 7, 7, 9, 10};
  return format < kFirstExtended ? kExtended[format] : format;
}

bool isCrsRecord(const std::string& user, std::uint16_t id, std::uint16_t first,
                 std::uint16_t last) {
  return user == "LASF_Projection" && id >= first && id <= last;
}
bool isGeoKeys(const std::string& user, std::uint16_t id) {
  return isCrsRecord(user, id, detail::kGeoKeyRecord, detail::kGeoKeyRecord + 2);
}
bool isWkt(const std::string& user, std::uint16_t id) {
  return isCrsRecord(user, id, detail::kWktRecord, detail::kWktRecord);
}

void checkVersion(const LasFile& input, const LasVersion& version) {
  if (version.minor != 4 && version.minor != 5)
    throw UsageError("files are converted to LAS 1.4 and 1.5, not to 1." +
                     std::to_string(version.minor));
  if (!version.time_offset) return;
  if (version.minor < 5) throw UsageError("LAS 1.4 has no time offset; LAS 1.5 has");
  if (input.info().time_kind == TimeKind::week_seconds)
    throw InputError(input.path().string() +
                     ": its times are seconds of the GPS week; an offset needs absolute times");
}

/// The encoding of the times and of the CRS, point format and record length of the new version.
LasHeader headerOf(const LasFile& input, const LasVersion& version) {
  LasHeader h = input.header();
  const bool absolute = (h.global_encoding & kLasAdjustedStandardTime) != 0;
  h.compressed = false;
  h.version_minor = version.minor;
  h.header_size = LasHeader::sizeOf(version.minor);
  h.global_encoding = static_cast<std::uint16_t>(h.global_encoding & ~kLasTimeOffset);
  h.time_offset = version.time_offset.value_or(0);
  if (version.time_offset && absolute) h.global_encoding |= kLasTimeOffset;
  if (version.minor < 5) return h;
  h.global_encoding |= kLasWkt;
  h.point_format = extendedFormat(h.point_format);
  const std::size_t before = LasRecordLayout::of(input.header().point_format).length;
  h.record_length = static_cast<std::uint16_t>(h.record_length - before +
                                               LasRecordLayout::of(h.point_format).length);
  return h;
}

/// Replaces the records of the CRS that the version does not know, by WKT of PROJ. A text that PROJ
/// does not know stays as it is.
void replaceCrs(const LasFile& input, const LasVersion& version, detail::LasHead& head) {
  const detail::LasReference reference = detail::readLasReference(input);
  const std::string& crs = reference.crs;
  const bool is_wkt1 = crs.find("CRS[") == std::string::npos;
  const bool stays = reference.by_wkt ? version.minor >= 5 || is_wkt1 : version.minor < 5;
  const bool known = !crs.empty() && !describeCrs(crs).name.empty();
  const std::string wkt = !stays && known ? crsAsWkt(crs) : std::string();
  if (version.minor >= 5 && (reference.by_wkt || !wkt.empty())) detail::eraseVlrs(head, isGeoKeys);
  if (wkt.empty()) return;
  const std::size_t at = detail::eraseVlrs(head, isWkt);
  for (const LasVlr& vlr : detail::lasCrsRecords(wkt, true))
    detail::insertVlr(head, at, serialiseLasVlr(vlr));
}

detail::LasHead headOf(const LasFile& input, const LasVersion& version) {
  detail::LasHead old = detail::readLasHead(input);
  const std::size_t old_size = old.header.header_size;
  detail::LasHead head;
  head.header = headerOf(input, version);
  const std::size_t size = head.header.header_size;
  head.header.vlr_count = old.header.vlr_count;
  head.header.offset_to_points =
      static_cast<std::uint32_t>(old.header.offset_to_points - old_size + size);
  head.bytes = serialiseLasHeader(head.header);
  head.bytes.insert(head.bytes.end(), old.bytes.begin() + static_cast<std::ptrdiff_t>(old_size),
                    old.bytes.end());
  head.vlrs_end = old.vlrs_end - old_size + size;
  replaceCrs(input, version, head);
  return head;
}

/// Records of a file as those of another version.
class RecordConverter {
 public:
  RecordConverter(const LasFile& input, const LasHeader& output)
      : name_(input.path().string()),
        header_(input.header()),
        from_(input.layout()),
        to_(LasRecordLayout::of(output.point_format)),
        from_length_(header_.record_length),
        to_length_(output.record_length),
        time_change_(header_.timeShift() - output.timeShift()),
        compatibility_(LasCompatibility::of(input)) {}

  const LasRecordLayout& layout() const { return to_; }

  void convert(const std::byte* from, std::size_t count, std::uint64_t first, std::byte* to) {
    if (from_.format == to_.format) {
      std::memcpy(to, from, count * from_length_);
    } else {
      encodeColumns(from, count, first, to);
      for (std::size_t i = 0; i < count; ++i)
        copyFields(from + i * from_length_, to + i * to_length_);
    }
    if (time_change_ == 0.0 || to_.gps_time < 0) return;
    for (std::size_t i = 0; i < count; ++i) {
      std::byte* field = to + i * to_length_ + to_.gps_time;
      const auto time = loadLas<double>(field);
      if (time != 0.0) storeLas(field, time + time_change_);
    }
  }

 private:
  void encodeColumns(const std::byte* from, std::size_t count, std::uint64_t first, std::byte* to) {
    decodeLasRecords(from, count, from_length_, from_, header_.scale, header_.offset, chunk_);
    if (compatibility_) compatibility_->restore(from, from_length_, chunk_);
    for (std::size_t i = 0; i < count; ++i) {
      if (chunk_.classification[i] != kOverlapClass || compatibility_) continue;
      chunk_.classification[i] = kUnclassified;
      chunk_.flags[i] = static_cast<std::uint8_t>(chunk_.flags[i] | kOverlap);
    }
    encodeLasRecords(chunk_, to_length_, to_, header_.scale, header_.offset, first, name_, to);
  }

  /// What columns do not hold, and what they might round.
  void copyFields(const std::byte* from, std::byte* to) const {
    constexpr std::size_t kColour = 6, kWaveform = 29;
    std::memcpy(to, from, kCommonBytes);
    if (from_.gps_time >= 0) std::memcpy(to + to_.gps_time, from + from_.gps_time, sizeof(double));
    if (from_.rgb >= 0) std::memcpy(to + to_.rgb, from + from_.rgb, kColour);
    if (from_.waveform >= 0) std::memcpy(to + to_.waveform, from + from_.waveform, kWaveform);
    std::memcpy(to + to_.length, from + from_.length, from_length_ - from_.length);
  }

  const std::string name_;
  const LasHeader header_;
  const LasRecordLayout from_, to_;
  const std::size_t from_length_, to_length_;
  const double time_change_;  ///< seconds, added to stored times
  const std::optional<LasCompatibility> compatibility_;
  PointChunk chunk_;
};

std::vector<std::string> remarksOf(const LasFile& input, const LasHeader& output,
                                   const WaveformCopy& waveforms) {
  std::vector<std::string> remarks = detail::remarksOf(input, {}, waveforms);
  const LasHeader& h = input.header();
  if (h.point_format != output.point_format)
    remarks.push_back("point format " + std::to_string(h.point_format) + " becomes format " +
                      std::to_string(output.point_format));
  if (output.version_minor >= 5 && input.crs().empty())
    remarks.emplace_back("LAS 1.5 requires a CRS as WKT, and the file states none that is known");
  if (h.header_size > LasHeader::sizeOf(h.version_minor))
    remarks.emplace_back("bytes behind the fields of its header are not copied");
  return remarks;
}

}  // namespace

LasRewriteResult convertLasVersion(const LasFile& input, const std::filesystem::path& output,
                                   const LasVersion& version, int threads) {
  constexpr std::size_t kRecordsAtOnce = 65536;
  std::error_code absent;
  if (std::filesystem::equivalent(input.path(), output, absent))
    throw UsageError(output.string() + ": input and output are the same file");
  checkVersion(input, version);
  const detail::LasHead head = headOf(input, version);
  LasHeader header = head.header;
  RecordConverter converter(input, header);
  WaveformCopy waveforms(input, output);
  detail::LasOutput file(output, head, threads);
  detail::LasStatistics counters;
  std::vector<std::byte> from, to;
  const std::uint64_t points = input.header().point_count;
  for (std::uint64_t first = 0; first < points; first += kRecordsAtOnce) {
    const std::size_t count = std::min<std::uint64_t>(kRecordsAtOnce, points - first);
    from.resize(count * input.header().record_length);
    to.assign(count * header.record_length, std::byte{0});
    input.readRecords(first, count, from.data());
    converter.convert(from.data(), count, first, to.data());
    counters.add(to.data(), count, header.record_length, converter.layout());
    file.append(to.data(), count);
  }
  detail::copyLasTail(input, file);
  counters.store(header);
  file.putCounts(header);
  waveforms.prepare();
  waveforms.commit();
  LasRewriteResult result;
  result.points = points;
  result.remarks = remarksOf(input, header, waveforms);
  file.commit();
  return result;
}

}  // namespace pcl_als
