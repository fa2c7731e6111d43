// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/las_record.h>
#include <pcl_als/waveform/pulse_waves_reader.h>

#include "pulse_waves_records.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

constexpr char kSignature[] = "PulseWavesWaves";
constexpr std::size_t kHeader = 60, kCompressionAt = 16;
constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr double kPicoseconds = 1000.0;      // per nanosecond
constexpr double kContinues = 0.05;          // sampling units between segments that are one
constexpr double kLargestDifference = 16.0;  // sampling units, of stated first and last samples
constexpr int kMostUnits = 32767;            // that a pulse record can state

fs::path wavesBeside(const PulseWavesFile& pulses) {
  fs::path path = pulses.path();
  for (const char* const extension : {".wvs", ".WVS"})
    if (fs::exists(path.replace_extension(extension))) return path;
  const std::string expected = path.replace_extension(".wvs").filename().string();
  for (const char* const extension : {".wvz", ".WVZ"})
    if (fs::exists(path.replace_extension(extension)))
      throw InputError(path.string() + ": compressed waves cannot be read; decompress them to " +
                       expected);
  throw InputError(pulses.path().string() + ": its waves are in " + expected +
                   ", which is missing beside it");
}

/// Checks that the returning samples lie where the record of the pulse states.
void checkReach(const PulseRecord& pulse, const std::vector<PulseSegment>& segments,
                const std::string& name) {
  double first = kMostUnits, last = -kMostUnits;
  for (const PulseSegment& s : segments) {
    if (s.sampling->type != PulseSampling::Type::returning || s.waveform.counts.empty()) continue;
    first = std::min(first, s.start);
    last = std::max(last, s.end() - s.step);
  }
  if (first > last || std::max(std::abs(first), std::abs(last)) >= kMostUnits) return;
  const bool agree = std::abs(first - pulse.first_sample) <= kLargestDifference &&
                     std::abs(last - pulse.last_sample) <= kLargestDifference;
  if (!agree)
    throw InputError(name + "states returning samples from " + std::to_string(pulse.first_sample) +
                     " to " + std::to_string(pulse.last_sample) +
                     ", and its waves have them from " + numberText(first, 1) + " to " +
                     numberText(last, 1) + " sampling units");
}

}  // namespace

struct WavesFile::State {
  const PulseWavesFile& pulses;
  InputFile file;

  explicit State(const PulseWavesFile& of) : pulses(of), file(wavesBeside(of)) {
    std::array<std::byte, kHeader> header{};
    if (file.size() < header.size())
      throw InputError(file.name() + ": has " + counted(file.size(), "byte") +
                       "; the header of a Waves file has 60");
    file.read(0, header.size(), header.data());
    if (detail::pulseText(header.data(), sizeof kSignature) != kSignature)
      throw InputError(file.name() + ": is no Waves file: it does not begin with " + kSignature);
    if (loadLas<std::uint32_t>(&header[kCompressionAt]) != 0)
      throw InputError(file.name() + ": compressed waves cannot be read; decompress them");
  }
};

WavesFile::WavesFile(const PulseWavesFile& pulses) : state_(std::make_unique<State>(pulses)) {}
WavesFile::~WavesFile() = default;

const PulseWavesFile& WavesFile::pulses() const {
  return state_->pulses;
}
const std::string& WavesFile::name() const {
  return state_->file.name();
}
std::uint64_t WavesFile::size() const {
  return state_->file.size();
}
void WavesFile::read(std::uint64_t position, std::size_t bytes, std::byte* out) const {
  state_->file.read(position, bytes, out);
}

std::string PulseWavesReader::pulseName() const {
  return waves_.pulses().path().string() + ": pulse " + std::to_string(index_) + ": ";
}

/// The next bytes of the waves.
const std::byte* PulseWavesReader::take(std::size_t bytes) {
  if (position_ > waves_.size() || waves_.size() - position_ < bytes)
    throw InputError(pulseName() + "its waves at byte " + std::to_string(position_) +
                     " reach past the end of " + waves_.name() + " (" +
                     std::to_string(waves_.size()) + " bytes)");
  if (position_ < begin_ || position_ + bytes > end_) {
    const std::uint64_t wanted =
        std::min<std::uint64_t>(std::max(bytes, kBufferBytes), waves_.size() - position_);
    buffer_.resize(wanted);
    waves_.read(position_, wanted, buffer_.data());
    begin_ = position_;
    end_ = position_ + wanted;
  }
  const std::byte* const at = buffer_.data() + (position_ - begin_);
  position_ += bytes;
  return at;
}

std::uint32_t PulseWavesReader::number(unsigned bits) {
  return bits == 8 ? std::to_integer<std::uint32_t>(*take(1)) : loadLas<std::uint16_t>(take(2));
}

/// From the anchor to the first sample of a segment, sampling units. Numbers of 32 bits have a
/// sign, because samples of the emitted pulse may precede its origin.
double PulseWavesReader::duration(const PulseSampling& sampling) {
  if (sampling.duration_bits == 0) return 0.0;
  const double steps = sampling.duration_bits == 32
                           ? static_cast<double>(loadLas<std::int32_t>(take(4)))
                           : static_cast<double>(number(sampling.duration_bits));
  return sampling.duration_scale * steps + sampling.duration_offset;
}

/// Appends the next samples to a segment.
void PulseWavesReader::readSegment(PulseSegment& segment, std::uint32_t samples) {
  const WaveformDescriptor own{segment.sampling->bits, samples,
                               segment.waveform.descriptor.spacing_ps};
  const std::byte* const packet = take(own.alignedBytes());
  Waveform& w = segment.waveform;
  if (w.counts.empty()) w.reference.byte_offset = position_ - own.alignedBytes();
  w.reference.bytes += static_cast<std::uint32_t>(own.alignedBytes());
  const std::size_t before = w.counts.size();
  w.counts.resize(before + samples);
  unpackWaveform(packet, own.alignedBytes(), own, w.counts.data() + before);
  w.descriptor.samples = static_cast<std::uint32_t>(w.counts.size());
}

void PulseWavesReader::readSampling(const PulseRecord& pulse, const PulseDescriptor& descriptor,
                                    const PulseSampling& sampling,
                                    std::vector<PulseSegment>& segments) {
  const std::size_t before = segments.size();
  const std::uint32_t count =
      sampling.segment_bits > 0 ? number(sampling.segment_bits) : sampling.segments;
  if (count > 1 && sampling.duration_bits == 0)
    throw InputError(pulseName() + "has " + counted(count, "segment") +
                     " that all begin at the anchor");
  for (std::uint32_t i = 0; i < count; ++i) {
    const double start = duration(sampling);
    const std::uint32_t samples =
        sampling.sample_bits > 0 ? number(sampling.sample_bits) : sampling.samples;
    const bool continues =
        segments.size() > before && std::abs(segments.back().end() - start) < kContinues;
    if (!continues) {
      PulseSegment& next = segments.emplace_back();
      next.sampling = &sampling;
      next.start = start;
      next.step = sampling.spacing_ns / descriptor.unit_ns;
      next.waveform.descriptor.bits = sampling.bits;
      next.waveform.descriptor.spacing_ps =
          static_cast<std::uint32_t>(std::lround(kPicoseconds * sampling.spacing_ns));
      next.waveform.reference.descriptor = sampling.waveform;
      next.waveform.reference.direction =
          (-pulse.direction() / (kPicoseconds * descriptor.unit_ns)).cast<float>();
    }
    readSegment(segments.back(), samples);
  }
}

bool PulseWavesReader::read(const PulseRecord& pulse, std::uint64_t index,
                            std::vector<PulseSegment>& segments) {
  segments.clear();
  if (pulse.descriptor == 0) return false;
  index_ = index;
  const auto& descriptors = waves_.pulses().descriptors();
  const auto found = descriptors.find(pulse.descriptor);
  if (found == descriptors.end())
    throw InputError(pulseName() + "the file has no pulse descriptor " +
                     std::to_string(pulse.descriptor) + " (record " +
                     std::to_string(200000 + pulse.descriptor) + ")");
  if (pulse.waves_offset < static_cast<std::int64_t>(kHeader))
    throw InputError(pulseName() + "its waves begin at byte " + std::to_string(pulse.waves_offset) +
                     ", within the header of " + waves_.name());
  if (pulse.anchor == pulse.target)
    throw InputError(pulseName() + "its anchor and its target coincide");
  position_ = static_cast<std::uint64_t>(pulse.waves_offset);
  take(found->second.extra_bytes);
  for (const PulseSampling& sampling : found->second.samplings)
    readSampling(pulse, found->second, sampling, segments);
  checkReach(pulse, segments, pulseName());
  return true;
}

}  // namespace pcl_als
