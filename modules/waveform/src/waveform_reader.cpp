// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/external_waveforms.h>
#include <pcl_als/waveform/waveform_reader.h>

namespace pcl_als {
namespace {

constexpr std::uint16_t kPacketsRecord = 65535;
constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

bool isPacketsRecord(const LasVlrEntry& vlr) {
  return vlr.extended && vlr.user_id == kLasSpecUser && vlr.record_id == kPacketsRecord;
}

/// Begin and end of a record of packets, header included, in a file.
struct PacketRange {
  std::uint64_t begin = 0, end = 0;
};

/// Reads the header of the record of packets at a position that the header of the file states.
PacketRange rangeAt(const LasFile& las, std::uint64_t position) {
  const std::string name = las.path().string() + ": ";
  if (position > las.fileSize() || las.fileSize() - position < kLasEvlrHeader)
    throw InputError(name + "its header states that waveform packets begin at byte " +
                     std::to_string(position) + ", and the file has " +
                     std::to_string(las.fileSize()) + " bytes");
  std::array<std::byte, kLasEvlrHeader> header{};
  las.readBytes(position, header.size(), header.data());
  const auto* user = reinterpret_cast<const char*>(header.data() + 2);
  const bool known = std::string(user, user + 16).rfind(kLasSpecUser, 0) == 0 &&
                     loadLas<std::uint16_t>(&header[18]) == kPacketsRecord;
  if (!known)
    throw InputError(name + "no record of waveform packets (" + kLasSpecUser +
                     " 65535) begins at byte " + std::to_string(position) +
                     ", which its header states");
  const auto length = loadLas<std::uint64_t>(&header[20]);
  const std::uint64_t payload = position + kLasEvlrHeader;
  if (length > las.fileSize() - payload)
    throw InputError(name + "the record of waveform packets (" + kLasSpecUser + " 65535) has " +
                     std::to_string(length) + " bytes and reaches past the end of the file");
  return {position, payload + length};
}

/// The record of packets within a file; none if there is no such record.
std::optional<PacketRange> internalRange(const LasFile& las) {
  if (las.header().waveform_start > 0) return rangeAt(las, las.header().waveform_start);
  for (const LasVlrEntry& vlr : las.vlrs())
    if (isPacketsRecord(vlr))
      return PacketRange{vlr.position - kLasEvlrHeader, vlr.position + vlr.length};
  return std::nullopt;
}

std::string pointName(const WaveformSource& source, std::uint64_t point) {
  return source.las().path().string() + ": point " + std::to_string(point) + ": ";
}

void checkPacket(const WaveformSource& source, std::uint64_t point, const WaveformReference& r,
                 const WaveformDescriptor& d) {
  if (r.bytes != d.packedBytes() && r.bytes != d.alignedBytes())
    throw InputError(pointName(source, point) + "its waveform packet has " +
                     counted(r.bytes, "byte") + ", and descriptor " + std::to_string(r.descriptor) +
                     " (record " + std::to_string(r.descriptor + 99) + ") describes " +
                     d.describe() + ", " + counted(d.packedBytes(), "byte"));
  if (r.byte_offset > source.packetBytes() || source.packetBytes() - r.byte_offset < r.bytes)
    throw InputError(pointName(source, point) + "its waveform packet at byte " +
                     std::to_string(r.byte_offset) + " reaches past the end of the packets in " +
                     source.packetFile() + " (" + std::to_string(source.packetBytes()) + " bytes)");
  if (!std::isfinite(r.location_ps) || !r.direction.allFinite())
    throw InputError(pointName(source, point) +
                     "the location or direction of its waveform is no number");
}

}  // namespace

struct WaveformSource::State {
  const LasFile& las;
  std::map<unsigned, WaveformDescriptor> descriptors;
  std::optional<InputFile> external;
  PacketRange range;
  std::string packet_file;

  explicit State(const LasFile& file) : las(file), descriptors(readWaveformDescriptors(file)) {
    const std::string name = las.path().string();
    if (las.layout().waveform < 0)
      throw InputError(name + ": point format " + std::to_string(las.header().point_format) +
                       " has no waveforms; formats 4, 5, 9 and 10 have");
    if (descriptors.empty())
      throw InputError(name + ": has no waveform packet descriptor (" + kLasSpecUser +
                       " 100 to 354)");
    const ExternalWaveforms beside = ExternalWaveforms::of(las);
    if (beside.expected)
      openExternal(beside);
    else
      openInternal();
  }

  void openExternal(const ExternalWaveforms& beside) {
    std::filesystem::path expected = las.path();
    expected.replace_extension(".wdp");
    if (beside.file.empty())
      throw InputError(las.path().string() + ": its waveforms are in " +
                       expected.filename().string() + ", which is missing beside it");
    const std::string extension = beside.file.extension().string();
    if (extension == ".wdz" || extension == ".WDZ")
      throw InputError(beside.file.string() +
                       ": compressed waveforms cannot be read; decompress them to " +
                       expected.filename().string());
    external.emplace(beside.file);
    packet_file = beside.file.string();
    range = {0, external->size()};
  }

  void openInternal() {
    const std::optional<PacketRange> found = internalRange(las);
    if (!found)
      throw InputError(las.path().string() + ": has no record of waveform packets (" +
                       kLasSpecUser + " 65535)");
    range = *found;
    packet_file = las.path().string();
  }
};

WaveformSource::WaveformSource(const LasFile& las) : state_(std::make_unique<State>(las)) {}
WaveformSource::~WaveformSource() = default;

const LasFile& WaveformSource::las() const {
  return state_->las;
}
const std::map<unsigned, WaveformDescriptor>& WaveformSource::descriptors() const {
  return state_->descriptors;
}
const std::string& WaveformSource::packetFile() const {
  return state_->packet_file;
}
std::uint64_t WaveformSource::packetBytes() const {
  return state_->range.end - state_->range.begin;
}

void WaveformSource::read(std::uint64_t offset, std::size_t bytes, std::byte* out) const {
  const State& s = *state_;
  if (s.external)
    s.external->read(offset, bytes, out);
  else
    s.las.readBytes(s.range.begin + offset, bytes, out);
}

const std::byte* WaveformReader::packet(std::uint64_t offset, std::size_t bytes) {
  if (offset < begin_ || offset + bytes > end_) {
    const std::uint64_t rest = source_.packetBytes() - offset;
    const std::size_t wanted =
        std::min<std::uint64_t>(rest, std::max<std::size_t>(bytes, kBufferBytes));
    buffer_.resize(wanted);
    begin_ = end_ = 0;  // nothing is valid if the file cannot be read
    source_.read(offset, wanted, buffer_.data());
    begin_ = offset;
    end_ = offset + wanted;
  }
  return buffer_.data() + (offset - begin_);
}

bool WaveformReader::read(const std::byte* record, std::uint64_t point, Waveform& waveform) {
  return read(WaveformReference::of(record, source_.las().layout()), point, waveform);
}

bool WaveformReader::read(const WaveformReference& reference, std::uint64_t point,
                          Waveform& waveform) {
  if (reference.descriptor == 0) return false;
  const auto found = source_.descriptors().find(reference.descriptor);
  if (found == source_.descriptors().end())
    throw InputError(pointName(source_, point) + "the file has no waveform packet descriptor " +
                     std::to_string(reference.descriptor) + " (record " +
                     std::to_string(reference.descriptor + 99) + ")");
  checkPacket(source_, point, reference, found->second);
  waveform.reference = reference;
  waveform.descriptor = found->second;
  waveform.counts.resize(found->second.samples);
  unpackWaveform(packet(reference.byte_offset, reference.bytes), reference.bytes, found->second,
                 waveform.counts.data());
  return true;
}

std::vector<std::string> describeWaveforms(const LasFile& las) {
  std::vector<std::string> texts;
  if (!refersToWaveforms(las)) return texts;
  for (const auto& [index, d] : readWaveformDescriptors(las))
    texts.push_back("waveform descriptor " + std::to_string(index) + ": " + d.describe() +
                    ", gain " + shortText(d.gain) + " V, offset " + shortText(d.offset) + " V");
  if (ExternalWaveforms::of(las).expected) return texts;
  const std::optional<PacketRange> range = internalRange(las);
  texts.push_back(range ? "waveforms in the file, " + grouped(range->end - range->begin) + " bytes"
                        : "its records refer to waveforms that the file does not have");
  return texts;
}

}  // namespace pcl_als
