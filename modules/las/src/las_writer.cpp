// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <optional>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/las/las_writer.h>

#include "las_crs.h"
#include "las_output.h"
#include "las_statistics.h"

namespace pcl_als {

struct LasWriter::State {
  std::string name;
  LasHeader header;
  LasRecordLayout layout;
  LinearUnits units;
  std::vector<LasExtraField> extra_fields;
  detail::LasStatistics counters;
  std::vector<std::byte> buffer;
  std::optional<detail::LasOutput> output;
};

namespace {

constexpr int kLeastFormat[] = {0, 0, 0, 0, 0, 6}, kMostFormat[] = {1, 1, 3, 5, 10, 10};

void checkOptions(const LasWriterOptions& options) {
  if (options.version_minor < 2 || options.version_minor > 5)
    throw UsageError("LAS 1." + std::to_string(options.version_minor) +
                     " cannot be written (1.2 to 1.5 can)");
  if (options.point_format < kLeastFormat[options.version_minor] ||
      options.point_format > kMostFormat[options.version_minor])
    throw UsageError("LAS 1." + std::to_string(options.version_minor) + " has no point format " +
                     std::to_string(options.point_format));
  if (options.time_offset &&
      (options.version_minor < 5 || options.time_kind != TimeKind::adjusted_standard))
    throw UsageError("a time offset needs LAS 1.5 and absolute times");
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(options.scale[axis]) || options.scale[axis] <= 0.0)
      throw UsageError("LAS scale must be a positive number");
    if (!std::isfinite(options.offset[axis])) throw UsageError("LAS offset must be a number");
  }
}

/// Places the fields behind the standard ones; returns the record length.
std::uint16_t placeExtraFields(const LasRecordLayout& layout, std::vector<LasExtraField>& fields) {
  std::size_t position = layout.length;
  for (LasExtraField& field : fields) {
    field.size = lasExtraSize(field);
    field.position = position;
    position += field.size;
  }
  if (position > std::numeric_limits<std::uint16_t>::max())
    throw UsageError("LAS extra fields do not fit a record of 65535 bytes");
  return static_cast<std::uint16_t>(position);
}

void stampDate(LasHeader& header) {
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  gmtime_r(&now, &date);
  header.creation_day = static_cast<std::uint16_t>(date.tm_yday + 1);
  header.creation_year = static_cast<std::uint16_t>(date.tm_year + 1900);
}

bool hasCrsRecord(const std::vector<LasVlr>& vlrs, std::uint16_t id) {
  return std::any_of(vlrs.begin(), vlrs.end(), [id](const LasVlr& vlr) {
    return vlr.user_id == "LASF_Projection" && vlr.record_id == id;
  });
}

bool hasPacketDescriptor(const std::vector<LasVlr>& vlrs) {
  constexpr std::uint16_t kFirst = 100, kLast = 354;
  return std::any_of(vlrs.begin(), vlrs.end(), [](const LasVlr& vlr) {
    return vlr.user_id == kLasSpecUser && vlr.record_id >= kFirst && vlr.record_id <= kLast;
  });
}

std::vector<LasVlr> collectVlrs(const LasWriterOptions& options,
                                const std::vector<LasExtraField>& fields) {
  std::vector<LasVlr> vlrs = detail::lasCrsRecords(options.crs, options.point_format >= 6);
  if (!fields.empty())
    vlrs.push_back({kLasSpecUser, kLasExtraBytesRecord, "Extra Bytes Record",
                    serialiseLasExtraFields(fields)});
  vlrs.insert(vlrs.end(), options.vlrs.begin(), options.vlrs.end());
  return vlrs;
}

LasHeader makeHeader(const LasWriterOptions& options, const std::vector<LasVlr>& vlrs,
                     std::size_t vlr_bytes, std::uint16_t record_length) {
  LasHeader h;
  h.version_minor = options.version_minor;
  h.file_source_id = options.file_source_id;
  if (options.time_kind == TimeKind::adjusted_standard)
    h.global_encoding |= kLasAdjustedStandardTime;
  if (options.time_offset) h.global_encoding |= kLasTimeOffset;
  // This class writes no packets: descriptors of them describe those of another file.
  if (hasPacketDescriptor(vlrs) && LasRecordLayout::of(options.point_format).waveform >= 0)
    h.global_encoding |= kLasWaveformExternal;
  h.time_offset = options.time_offset.value_or(0);
  // Formats 6-10 have to declare WKT, even where no CRS is known.
  if (hasCrsRecord(vlrs, detail::kWktRecord) ||
      (options.point_format >= 6 && !hasCrsRecord(vlrs, detail::kGeoKeyRecord)))
    h.global_encoding |= kLasWkt;
  h.system_id = options.system_id;
  h.generating_software = options.generating_software;
  stampDate(h);
  h.header_size = LasHeader::sizeOf(options.version_minor);
  h.offset_to_points = static_cast<std::uint32_t>(h.header_size + vlr_bytes);
  h.vlr_count = static_cast<std::uint32_t>(vlrs.size());
  h.point_format = static_cast<std::uint8_t>(options.point_format);
  h.record_length = record_length;
  h.scale = options.scale;
  h.offset = options.offset;
  return h;
}

}  // namespace

LasWriter::LasWriter(const std::filesystem::path& path, const LasWriterOptions& options)
    : state_(std::make_unique<State>()) {
  checkOptions(options);
  State& s = *state_;
  s.name = path.string();
  s.layout = LasRecordLayout::of(options.point_format);
  s.units = unitsOfCrs(options.crs);
  s.extra_fields = options.extra_fields;
  const std::uint16_t length = placeExtraFields(s.layout, s.extra_fields);
  const std::vector<LasVlr> vlrs = collectVlrs(options, s.extra_fields);
  std::vector<std::byte> vlr_bytes;
  for (const LasVlr& vlr : vlrs) {
    const std::vector<std::byte> bytes = serialiseLasVlr(vlr);
    vlr_bytes.insert(vlr_bytes.end(), bytes.begin(), bytes.end());
  }
  s.header = makeHeader(options, vlrs, vlr_bytes.size(), length);
  s.layout.time_shift = s.header.timeShift();
  detail::LasHead head{serialiseLasHeader(s.header), s.header, 0};
  head.bytes.insert(head.bytes.end(), vlr_bytes.begin(), vlr_bytes.end());
  head.vlrs_end = head.bytes.size();
  s.output.emplace(path, std::move(head));
}

LasWriter::~LasWriter() = default;
LasWriter::LasWriter(LasWriter&&) noexcept = default;

const LasHeader& LasWriter::header() const {
  return state_->header;
}
const LasRecordLayout& LasWriter::layout() const {
  return state_->layout;
}
const LinearUnits& LasWriter::units() const {
  return state_->units;
}
const std::vector<LasExtraField>& LasWriter::extraFields() const {
  return state_->extra_fields;
}
std::uint64_t LasWriter::pointCount() const {
  return state_->counters.points;
}

void LasWriter::append(const PointChunk& chunk,
                       const std::vector<std::vector<double>>& extra_columns) {
  State& s = *state_;
  if (!extra_columns.empty() && extra_columns.size() != s.extra_fields.size())
    throw UsageError(s.name + ": " + std::to_string(extra_columns.size()) + " extra columns for " +
                     std::to_string(s.extra_fields.size()) + " extra fields");
  const std::size_t length = s.header.record_length;
  s.buffer.resize(chunk.size() * length);
  const Eigen::Vector3d metres = s.units.metres();
  encodeLasRecords(chunk, length, s.layout, s.header.scale.cwiseProduct(metres),
                   s.header.offset.cwiseProduct(metres), s.counters.points, s.name,
                   s.buffer.data());
  for (std::size_t k = 0; k < extra_columns.size(); ++k) {
    if (extra_columns[k].size() != chunk.size())
      throw UsageError(s.name + ": extra column " + s.extra_fields[k].name +
                       " and the points differ in number");
    encodeLasExtraField(extra_columns[k], length, s.extra_fields[k], s.name, s.buffer.data());
  }
  appendRecords(s.buffer.data(), chunk.size());
}

void LasWriter::appendRecords(const std::byte* records, std::size_t count) {
  State& s = *state_;
  s.counters.add(records, count, s.header.record_length, s.layout);
  s.output->append(records, count);
}

void LasWriter::finish() {
  State& s = *state_;
  s.counters.store(s.header);
  s.output->endPoints();
  s.output->putCounts(s.header);
  s.output->commit();
}

}  // namespace pcl_als
