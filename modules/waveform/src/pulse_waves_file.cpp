// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/las_record.h>
#include <pcl_als/waveform/pulse_waves_file.h>

#include "pulse_waves_records.h"

namespace pcl_als {
namespace {

constexpr char kSignature[] = "PulseWavesPulse";
constexpr char kSpecUser[] = "PulseWaves_Spec", kProjectionUser[] = "PulseWaves_Proj";
constexpr std::size_t kRecordHeader = 96, kUser = 16;
constexpr std::uint32_t kScanners = 100000, kDescriptors = 200000, kTables = 300000;
constexpr std::uint32_t kMostIndex = 255, kLastAppended = 0xFFFFFFFF;
constexpr std::uint64_t kLargestRecord = std::uint64_t{1} << 26;
constexpr double kWeek = 604800.0, kAdjustment = 1e9;  // seconds
constexpr double kPicoseconds = 1000.0;                // per nanosecond

/// The header of a variable length record, in front of its payload or, appended, behind it.
struct Record {
  std::string user;
  std::uint32_t id = 0;
  std::uint64_t bytes = 0;
};

Record recordAt(const InputFile& file, std::uint64_t position) {
  std::array<std::byte, kRecordHeader> header{};
  file.read(position, header.size(), header.data());
  return {detail::pulseText(header.data(), kUser), loadLas<std::uint32_t>(&header[kUser]),
          loadLas<std::uint64_t>(&header[kUser + 8])};
}

/// Of the ids base + 1 … base + 255, the index; otherwise 0.
unsigned indexOf(std::uint32_t id, std::uint32_t base) {
  return id > base && id <= base + kMostIndex ? id - base : 0;
}

}  // namespace

struct PulseWavesFile::State {
  std::filesystem::path path;
  InputFile file;
  PulseWavesHeader header;
  std::map<unsigned, PulseDescriptor> descriptors;
  std::map<unsigned, PulseScanner> scanners;
  std::map<unsigned, std::vector<SampleTable>> tables;
  std::vector<LasVlr> projection;
  std::map<unsigned, WaveformDescriptor> waveforms;
  bool standard_time = false;

  explicit State(const std::filesystem::path& from) : path(from), file(from) {
    readHeader();
    readRecords();
    readAppendedRecords();
    describeWaveforms();
    standard_time = firstTime() > kWeek;
  }

  std::string name() const { return path.string(); }
  void readHeader() {
    if (lowerExtension(path) == ".plz")
      throw InputError(name() +
                       ": compressed pulses cannot be read; decompress them to .pls and .wvs");
    std::array<std::byte, detail::kPulseHeader> bytes{};
    if (file.size() < bytes.size())
      throw InputError(name() + ": has " + counted(file.size(), "byte") +
                       "; the header of a Pulse file has 352");
    file.read(0, bytes.size(), bytes.data());
    if (detail::pulseText(bytes.data(), sizeof kSignature) != kSignature)
      throw InputError(name() + ": is no Pulse file: it does not begin with " + kSignature);
    header = detail::parsePulseHeader(bytes.data(), file.size(), name());
  }

  void readRecords() {
    std::uint64_t position = header.header_size;
    for (std::uint32_t i = 0; i < header.vlr_count; ++i) {
      const std::string own = name() + ": variable length record " + std::to_string(i);
      if (header.pulse_offset - position < kRecordHeader)
        throw InputError(own + " reaches past the begin of the pulses");
      const Record record = recordAt(file, position);
      position += kRecordHeader;
      if (record.bytes > header.pulse_offset - position)
        throw InputError(own + " has " + std::to_string(record.bytes) +
                         " bytes and reaches past the begin of the pulses");
      take(record, position);
      position += record.bytes;
    }
  }

  /// Appended records are found from the end of the file; an empty one ends them.
  void readAppendedRecords() {
    const std::uint64_t begin = header.pulse_offset + header.pulse_count * header.record_length;
    std::uint64_t end = file.size();
    for (std::int32_t i = 0; i != header.avlr_count; ++i) {
      const std::string own = name() + ": appended record " + std::to_string(i) + " from the end";
      if (end == begin) return;
      if (end - begin < kRecordHeader) throw InputError(own + " reaches into the pulses");
      const Record record = recordAt(file, end - kRecordHeader);
      end -= kRecordHeader;
      if (record.user == kSpecUser && record.id == kLastAppended) return;
      if (record.bytes > end - begin)
        throw InputError(own + " has " + std::to_string(record.bytes) +
                         " bytes and reaches into the pulses");
      end -= record.bytes;
      take(record, end);
    }
  }

  double firstTime() const {
    std::array<std::byte, 8> steps{};
    if (header.pulse_count == 0) return 0.0;
    file.read(header.pulse_offset, steps.size(), steps.data());
    return static_cast<double>(loadLas<std::int64_t>(steps.data())) * header.time_scale +
           header.time_offset;
  }

  void take(const Record& record, std::uint64_t position) {
    const bool known = record.user == kSpecUser || record.user == kProjectionUser;
    if (!known) return;
    const std::string own = name() + ": record " + std::to_string(record.id) + " of " + record.user;
    if (record.bytes > kLargestRecord)
      throw InputError(own + " has " + grouped(record.bytes) + " bytes");
    std::vector<std::byte> payload(record.bytes);
    file.read(position, payload.size(), payload.data());
    if (record.user == kProjectionUser) return addProjection(record, std::move(payload));
    const auto [at, is_new] = payloads_.emplace(record.id, payload);
    if (!is_new && at->second != payload)
      throw InputError(own + " occurs twice, with different values");
    if (const unsigned i = indexOf(record.id, kScanners))
      scanners.emplace(i, detail::parsePulseScanner(payload, own));
    if (const unsigned i = indexOf(record.id, kDescriptors))
      descriptors.emplace(i, detail::parsePulseDescriptor(payload, own));
    if (const unsigned i = indexOf(record.id, kTables))
      tables.emplace(i, detail::parseSampleTables(payload, own));
  }

  /// An appended record replaces the one that it corrects.
  void addProjection(const Record& record, std::vector<std::byte> payload) {
    constexpr std::size_t kLongest = std::numeric_limits<std::uint16_t>::max();
    if (record.id > kLongest || payload.size() > kLongest) return;
    const auto id = static_cast<std::uint16_t>(record.id);
    projection.erase(std::remove_if(projection.begin(), projection.end(),
                                    [id](const LasVlr& vlr) { return vlr.record_id == id; }),
                     projection.end());
    projection.push_back({"LASF_Projection", id, "from a Pulse file", std::move(payload)});
  }

  void describeWaveforms() {
    std::map<std::tuple<std::uint32_t, unsigned, unsigned, std::uint32_t, unsigned>, unsigned>
        kinds;
    for (auto& [index, pulse] : descriptors)
      for (PulseSampling& s : pulse.samplings) {
        if (s.type != PulseSampling::Type::returning) continue;
        WaveformDescriptor d;
        d.bits = s.bits;
        d.spacing_ps = static_cast<std::uint32_t>(std::lround(kPicoseconds * s.spacing_ns));
        const auto next = static_cast<unsigned>(kinds.size() + 1);
        s.waveform =
            kinds.emplace(std::tuple(pulse.scanner, s.channel, s.bits, d.spacing_ps, s.table), next)
                .first->second;
        waveforms.emplace(s.waveform, d);
      }
    payloads_.clear();
  }

 private:
  std::map<std::uint32_t, std::vector<std::byte>> payloads_;  ///< that were read
};

bool isPulseFile(const std::filesystem::path& path) {
  const std::string extension = lowerExtension(path);
  return extension == ".pls" || extension == ".plz";
}

PulseWavesFile::PulseWavesFile(const std::filesystem::path& path)
    : state_(std::make_unique<State>(path)) {}
PulseWavesFile::~PulseWavesFile() = default;

const std::filesystem::path& PulseWavesFile::path() const {
  return state_->path;
}
const PulseWavesHeader& PulseWavesFile::header() const {
  return state_->header;
}
const std::map<unsigned, PulseDescriptor>& PulseWavesFile::descriptors() const {
  return state_->descriptors;
}
const std::map<unsigned, PulseScanner>& PulseWavesFile::scanners() const {
  return state_->scanners;
}
const std::map<unsigned, std::vector<SampleTable>>& PulseWavesFile::tables() const {
  return state_->tables;
}
const std::vector<LasVlr>& PulseWavesFile::projection() const {
  return state_->projection;
}
const std::map<unsigned, WaveformDescriptor>& PulseWavesFile::waveformDescriptors() const {
  return state_->waveforms;
}

void PulseWavesFile::read(std::uint64_t first, std::size_t count,
                          std::vector<PulseRecord>& pulses) const {
  const PulseWavesHeader& h = header();
  std::vector<std::byte> bytes(count * h.record_length);
  state_->file.read(h.pulse_offset + first * h.record_length, bytes.size(), bytes.data());
  pulses.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::byte* at = &bytes[i * h.record_length];
    PulseRecord& p = pulses[i];
    p.time = loadLas<std::int64_t>(at);
    p.waves_offset = loadLas<std::int64_t>(at + 8);
    for (int axis = 0; axis < 3; ++axis) {
      p.anchor[axis] = loadLas<std::int32_t>(at + 16 + 4 * axis) * h.scale[axis] + h.offset[axis];
      p.target[axis] = loadLas<std::int32_t>(at + 28 + 4 * axis) * h.scale[axis] + h.offset[axis];
    }
    p.first_sample = loadLas<std::int16_t>(at + 40);
    p.last_sample = loadLas<std::int16_t>(at + 42);
    const auto flags = loadLas<std::uint16_t>(at + 44);
    p.descriptor = flags & 255U;
    p.edge = (flags >> 12U & 1U) != 0;
    p.scan_direction = (flags >> 13U & 1U) != 0;
    p.facet = flags >> 14U;
    p.intensity = std::to_integer<unsigned>(at[46]);
    p.classification = std::to_integer<unsigned>(at[47]);
    p.source_id = h.file_source_id;
    if ((h.attributes & 1U) != 0) p.source_id = loadLas<std::uint16_t>(at + detail::kPulseRecord);
    if ((h.attributes & 3U) == 2U) p.source_id = loadLas<std::uint32_t>(at + detail::kPulseRecord);
  }
}

bool PulseWavesFile::hasStandardTime() const {
  return state_->standard_time;
}

double PulseWavesFile::timeOf(const PulseRecord& pulse) const {
  // The offset is reduced before the sum, which keeps the digits of the steps.
  const double offset =
      state_->standard_time ? header().time_offset - kAdjustment : header().time_offset;
  return static_cast<double>(pulse.time) * header().time_scale + offset;
}

}  // namespace pcl_als
