// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <mutex>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/las/damaged_file.h>
#include <pcl_als/las/las_file.h>

#include "copc.h"
#include "las_bytes.h"
#include "las_crs.h"
#include "las_vlrs.h"
#include "laz.h"

namespace pcl_als {

struct LasFile::State {
  std::filesystem::path path;
  InputFile file;
  LasHeader header;
  LasRecordLayout layout;
  std::vector<LasVlrEntry> vlrs;
  LasExtraBytes extra;
  std::vector<std::string> remarks;
  std::unique_ptr<LazPointReader> laz;
  LasDamage damage = LasDamage::refuse;
  LasIntact intact;
  std::once_flag intact_found;
  const LasVlrEntry* copc = nullptr;  ///< the record "copc" 1 among vlrs
  detail::LasReference reference;

  explicit State(std::filesystem::path p) : path(std::move(p)), file(path) {}
  void keepIntact();
};

namespace {

/// A record has room for this many fields of a byte; what is behind describes nothing.
constexpr std::uint64_t kLargestExtraRecord = 65535 * kLasExtraDescriptor;

LasHeader readHeader(const InputFile& file, LasDamage damage) {
  std::array<std::byte, kLargestLasHeader> block{};
  const std::size_t available = std::min<std::uint64_t>(block.size(), file.size());
  file.read(0, available, block.data());
  return parseLasHeader(block.data(), available, file.size(), file.name(),
                        damage == LasDamage::keep_intact);
}

bool isRecord(const LasVlrEntry& entry, const char* user, std::uint16_t id) {
  return entry.user_id == user && entry.record_id == id;
}

/// What contradicts the version of the file, and how it is taken.
void remarkVersion(const LasHeader& h, std::vector<std::string>& remarks) {
  if (h.version_minor < 5) return;
  if (h.point_format < 6)
    remarks.push_back("LAS 1.5 has no point format " + std::to_string(h.point_format) +
                      "; the points are read as those of an older version");
  if ((h.global_encoding & kLasTimeOffset) != 0 &&
      (h.global_encoding & kLasAdjustedStandardTime) == 0)
    remarks.emplace_back(
        "the header declares offset GPS time without standard GPS time, which is no encoding of "
        "LAS 1.5; the times are taken as seconds of the GPS week");
}

std::vector<std::byte> lazPayload(const LasFile& file) {
  for (const LasVlrEntry& vlr : file.vlrs())
    if (isRecord(vlr, kLazUser, kLazRecord)) return file.payload(vlr);
  throw InputError(
      file.path().string() +
      ": the points are compressed, but the record \"laszip encoded\" that says how is "
      "missing");
}

LasExtraBytes readExtraBytes(const LasFile& file) {
  std::vector<std::vector<std::byte>> payloads;
  for (const LasVlrEntry& vlr : file.vlrs()) {
    if (!isRecord(vlr, kLasSpecUser, kLasExtraBytesRecord)) continue;
    std::vector<std::byte>& payload =
        payloads.emplace_back(std::min(vlr.length, kLargestExtraRecord));
    file.readBytes(vlr.position, payload.size(), payload.data());
  }
  LasExtraBytes extra =
      joinLasExtraBytes(payloads, file.layout().length, file.header().record_length);
  if (payloads.size() > 1)
    extra.remarks.insert(extra.remarks.begin(),
                         "the " + std::to_string(payloads.size()) +
                             " records that describe the extra bytes are read as one, in the order "
                             "of the file");
  return extra;
}

/// The record of applied corrections; empty where there is none.
std::string correctionsOf(const LasFile& file) {
  constexpr std::uint64_t kLongest = std::numeric_limits<std::uint16_t>::max();
  for (const LasVlrEntry& vlr : file.vlrs()) {
    if (!isRecord(vlr, kLasCorrectionsUser, kLasCorrectionsRecord) || vlr.length > kLongest)
      continue;
    const std::vector<std::byte> bytes = file.payload(vlr);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }
  return {};
}

/// The chunks of the nodes that are wanted, in file order; every node must be a chunk.
std::vector<LasRecordRange> chunksOf(const std::vector<detail::CopcNode>& nodes,
                                     LazPointReader& laz, const LasFile& file) {
  const auto refuse = [&](const detail::CopcNode& node, const char* what) {
    throw InputError(file.path().string() + ": the node of " + std::to_string(node.points) +
                     " points at byte " + std::to_string(node.offset) + ' ' + what +
                     " (damaged COPC hierarchy; a conversion without bounds makes a file without)");
  };
  std::vector<LasRecordRange> ranges;
  std::set<std::uint64_t> used;  // first records
  for (const detail::CopcNode& node : nodes) {
    const LasRecordRange chunk = laz.chunkAt(node.offset, node.offset + node.bytes);
    if (chunk.count != node.points || chunk.first > file.header().point_count ||
        chunk.count > file.header().point_count - chunk.first)
      refuse(node, "is no chunk of the chunk table");
    if (!used.insert(chunk.first).second)
      throw InputError(file.path().string() + ": two nodes of its COPC hierarchy are one chunk");
    if (node.wanted) ranges.push_back(chunk);
  }
  std::sort(ranges.begin(), ranges.end(),
            [](const LasRecordRange& a, const LasRecordRange& b) { return a.first < b.first; });
  return ranges;
}

}  // namespace

/// Limits the header to what a truncated file holds.
void LasFile::State::keepIntact() {
  intact.lost_evlrs = detail::readIntactEntries(file, header, vlrs);
  if (header.compressed) return;
  const std::uint64_t room = (file.size() - header.offset_to_points) / header.record_length;
  header.point_count = std::min(header.point_count, room);
}

LasFile::LasFile(std::filesystem::path path, unsigned laz_fields, LasDamage damage)
    : state_(std::make_unique<State>(std::move(path))) {
  State& s = *state_;
  s.damage = damage;
  s.header = readHeader(s.file, damage);
  s.intact.announced = s.header.point_count;
  s.layout = LasRecordLayout::of(s.header.point_format);
  s.layout.time_shift = s.header.timeShift();
  const bool keep_intact = damage == LasDamage::keep_intact;
  const std::string wrong_number = detail::readVlrs(s.file, keep_intact, s.header, s.vlrs);
  if (!wrong_number.empty()) s.remarks.push_back(wrong_number);
  if (keep_intact)
    s.keepIntact();
  else
    detail::readExtendedEntries(s.file, s.header, s.vlrs);
  if (s.header.compressed) {
    s.laz = detail::openLazPoints(s.file, s.header, lazPayload(*this), laz_fields, keep_intact);
    for (const LasVlrEntry& entry : s.vlrs)
      if (!entry.extended && isRecord(entry, kCopcUser, detail::kCopcInfoRecord)) s.copc = &entry;
  }
  s.reference = detail::readLasReference(*this);
  s.extra = readExtraBytes(*this);
  remarkVersion(s.header, s.remarks);
  s.remarks.insert(s.remarks.end(), s.extra.remarks.begin(), s.extra.remarks.end());
}

LasFile::~LasFile() = default;
LasFile::LasFile(LasFile&&) noexcept = default;

const std::filesystem::path& LasFile::path() const {
  return state_->path;
}
const LasHeader& LasFile::header() const {
  return state_->header;
}
const LasRecordLayout& LasFile::layout() const {
  return state_->layout;
}
const std::vector<LasVlrEntry>& LasFile::vlrs() const {
  return state_->vlrs;
}
const LasExtraBytes& LasFile::extraBytes() const {
  return state_->extra;
}
const std::vector<std::string>& LasFile::remarks() const {
  return state_->remarks;
}
std::string LasFile::crs() const {
  return state_->reference.crs;
}
CrsKind LasFile::crsKind() const {
  return state_->reference.kind;
}
const LinearUnits& LasFile::units() const {
  return state_->reference.units;
}
std::uint64_t LasFile::fileSize() const {
  return state_->file.size();
}
std::uint64_t LasFile::pointsEnd() const {
  const LasHeader& h = header();
  if (state_->laz) return detail::readLazExtent(state_->file, h, lazPayload(*this)).end;
  return h.offset_to_points + h.point_count * h.record_length;
}
std::uint64_t LasFile::surplusPointBytes() const {
  if (!state_->laz) return 0;
  return detail::readLazExtent(state_->file, header(), lazPayload(*this)).surplus_bytes;
}

LasScaling LasFile::toMetres() const {
  requireMapCoordinates(info());
  const Eigen::Vector3d metres = units().metres();
  return {header().scale.cwiseProduct(metres), header().offset.cwiseProduct(metres)};
}

PointFileInfo LasFile::info() const {
  const LasHeader& h = header();
  const Eigen::Vector3d metres = units().metres();
  PointFileInfo info;
  info.path = path();
  info.version = state_->file.version();
  info.point_count = h.point_count;
  info.minimum = h.minimum.cwiseProduct(metres);
  info.maximum = h.maximum.cwiseProduct(metres);
  info.resolution = h.scale.cwiseAbs().cwiseProduct(metres);
  info.crs = crs();
  info.crs_ignored = state_->reference.ignored;
  info.crs_kind = crsKind();
  info.units = units();
  if (layout().gps_time >= 0)
    info.time_kind = (h.global_encoding & kLasAdjustedStandardTime) != 0
                         ? TimeKind::adjusted_standard
                         : TimeKind::week_seconds;
  info.time_shift = h.timeShift();
  info.system = h.sensor();
  info.format = h.describe() + (isCopc() ? ", COPC" : "");
  info.corrections = correctionsOf(*this);
  return info;
}

std::vector<std::byte> LasFile::payload(const LasVlrEntry& vlr, std::size_t limit) const {
  if (vlr.length > limit)
    throw InputError(state_->file.name() + ": VLR " + vlr.user_id + " " +
                     std::to_string(vlr.record_id) + " of " + std::to_string(vlr.length) +
                     " bytes is too large to be read");
  std::vector<std::byte> bytes(vlr.length);
  readBytes(vlr.position, bytes.size(), bytes.data());
  return bytes;
}

void LasFile::readBytes(std::uint64_t position, std::size_t bytes, std::byte* out) const {
  state_->file.read(position, bytes, out);
}

const LasIntact& LasFile::intact() const {
  State& s = *state_;
  if (s.damage == LasDamage::refuse)
    throw UsageError(s.file.name() + ": was opened as a file without damage");
  std::call_once(s.intact_found, [&s] {
    if (s.laz) {
      LazIntact found = s.laz->findIntact();
      s.intact.records = std::move(found.chunks);
      s.intact.chunks = s.intact.records.size();
      s.intact.chunk_count = found.chunk_count;
    } else if (s.header.point_count > 0) {
      s.intact.records = {{0, s.header.point_count}};
    }
    for (const LasRecordRange& range : s.intact.records) s.intact.record_count += range.count;
  });
  return s.intact;
}

bool LasFile::isTruncated() const {
  const LasIntact& intact = state_->intact;
  return intact.lost_evlrs > 0 || state_->header.point_count < intact.announced;
}

std::string LasIntact::describe() const {
  std::string text;
  if (chunk_count > 0)
    text =
        std::to_string(chunks) + " of " + counted(chunk_count, "chunk") + " can be decoded, with ";
  else if (chunks > 0)
    text = "without a chunk table, " + counted(chunks, "chunk") + " can be decoded, with ";
  text += grouped(record_count) + " of " + grouped(announced) + " points";
  if (lost_evlrs > 0) text += "; " + counted(lost_evlrs, "extended VLR") + " lost";
  return text;
}

bool LasFile::isCopc() const {
  return state_->copc != nullptr;
}

std::vector<LasRecordRange> LasFile::recordsWithin(const LasWindow& window) const {
  const State& s = *state_;
  // The octree of a damaged file may be lost, and refers to chunks that are.
  if (s.damage == LasDamage::keep_intact && !(window.resolution > 0.0)) return intact().records;
  if (!isCopc() || s.damage == LasDamage::keep_intact) {
    if (window.resolution > 0.0)
      throw InputError(s.file.name() +
                       ": is no COPC file; only these can be read at a lower resolution");
    return {{0, s.header.point_count}};
  }
  if (!window.bounds && !(window.resolution > 0.0)) return {{0, s.header.point_count}};
  detail::CopcFile file;
  file.name = s.file.name();
  file.size = s.file.size();
  file.points = s.header.point_count;
  file.scale = s.header.scale;
  file.offset = s.header.offset;
  file.read = [this](std::uint64_t position, std::size_t bytes, std::byte* out) {
    readBytes(position, bytes, out);
  };
  const detail::CopcInfo info = detail::parseCopcInfo(payload(*s.copc), file);
  return chunksOf(detail::copcNodes(info, file, window), *s.laz, *this);
}

void LasFile::readRanges(const std::vector<LasRecordRange>& ranges, std::byte* out) const {
  if (state_->laz) return state_->laz->read(ranges, out);
  for (const LasRecordRange& range : ranges) {
    readRecords(range.first, range.count, out);
    out += range.count * state_->header.record_length;
  }
}

void LasFile::readRecords(std::uint64_t first, std::size_t count, std::byte* out) const {
  const State& s = *state_;
  if (first > s.header.point_count || count > s.header.point_count - first)
    throw UsageError(s.file.name() + ": point records past the end were asked for");
  if (s.laz)
    s.laz->read(first, count, out);
  else
    s.file.read(s.header.offset_to_points + first * s.header.record_length,
                count * s.header.record_length, out);
}

}  // namespace pcl_als
