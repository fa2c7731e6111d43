// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_points.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>

#include "waveform_echoes.h"

namespace pcl_als::detail {
namespace {

constexpr double kLargestStep = 0.001;  // units of the file, of coordinates
constexpr std::size_t kReturnsAt = 14, kFlagsAt = 15;
constexpr unsigned kMostReturns = 15, kChannels = 4;  // of point format 6
constexpr std::uint8_t kUnclassified = 1;
constexpr double kLargestIntensity = 65535.0;
constexpr double kRangePerNanosecond = 0.149896229;  // metres: half the speed of light
constexpr std::uint32_t kMostSource = 65535;

/// 0 for numbers that LAS cannot store.
std::uint16_t sourceOf(std::uint32_t id) {
  return id <= kMostSource ? static_cast<std::uint16_t>(id) : std::uint16_t{0};
}

std::int32_t steps(double value, double scale, double offset, const std::string& name) {
  const double count = (value - offset) / scale;
  if (!(std::abs(count) < std::numeric_limits<std::int32_t>::max()))
    throw InputError(name + "an echo of its waveform is too far away to be stored");
  return static_cast<std::int32_t>(std::lround(count));
}

}  // namespace

LasWriterOptions pointsOfPulses(const PulseWavesFile& pulses) {
  const PulseWavesHeader& h = pulses.header();
  LasWriterOptions las;
  las.scale = h.scale.cwiseMin(kLargestStep);
  std::vector<PulseRecord> first;
  if (h.pulse_count > 0) pulses.read(0, 1, first);
  las.offset = first.empty() ? h.offset : Eigen::Vector3d(first[0].anchor.array().round());
  las.time_kind = pulses.hasStandardTime() ? TimeKind::adjusted_standard : TimeKind::week_seconds;
  las.file_source_id = sourceOf(h.file_source_id);
  if (!h.system_id.empty()) las.system_id = h.system_id.substr(0, 32);
  las.vlrs = pulses.projection();
  las.extra_fields = echoAttributeFields();
  LasExtraField channel;
  channel.name = "channel";
  channel.description = "of the receiver";
  channel.type = LasExtraType::u8;
  las.extra_fields.push_back(channel);
  return las;
}

PulsePoints::PulsePoints(const PulseJob& job)
    : job_(job),
      reader_(job.waves),
      echoes_(job.responses, job.settings),
      emitted_(job.emitted.response) {}

/// The time of the emitted pulse, that of its strongest echo; 0 if times do not count from it.
void PulsePoints::findEmitted(const PulseDescriptor& descriptor) {
  emitted_units_ = emitted_std_ = 0.0;
  for (const PulseSegment& segment : segments_) {
    if (segment.sampling->type != PulseSampling::Type::outgoing) continue;
    const bool stated = segment.sampling->duration_bits > 0;
    if (!(stated ? job_.emitted.of_stated : job_.emitted.of_others)) return;
    emitted_.decompose(segment.waveform.counts.data(), segment.waveform.counts.size(),
                       emitted_found_);
    const auto begin = emitted_found_.echo.begin(), end = begin + emitted_found_.count;
    const auto strongest = std::max_element(
        begin, end,
        [](const WaveformEcho& a, const WaveformEcho& b) { return a.amplitude < b.amplitude; });
    if (strongest == end) return;
    emitted_units_ = segment.unitsAt(strongest->time);
    emitted_std_ = segment.step * strongest->time_std;
    if (!stated) emitted_units_ -= job_.emitted.mean_ns / descriptor.unit_ns;
    return;
  }
}

bool PulsePoints::isSaturated(const PulseSegment& segment) const {
  const std::vector<double>& counts = segment.waveform.counts;
  const double saturation = job_.settings.saturationOf(segment.waveform.descriptor);
  return std::any_of(counts.begin(), counts.end(),
                     [saturation](double count) { return count >= saturation; });
}

/// Ranks from 1: the segments without saturated samples first, then by the order of the samplings.
void PulsePoints::rankSegments() {
  const std::size_t count = segments_.size();
  rank_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i)
    if (segments_[i].sampling->type == PulseSampling::Type::returning)
      rank_[i] = 1 + i + (isSaturated(segments_[i]) ? count : 0);
}

/// Whether a segment of another sampling stands above a segment at this time.
bool PulsePoints::isTaken(std::size_t segment, double units) const {
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const PulseSegment& other = segments_[i];
    const bool above =
        rank_[i] > 0 && rank_[i] < rank_[segment] && other.sampling != segments_[segment].sampling;
    if (above && units >= other.start && units < other.end()) return true;
  }
  return false;
}

void PulsePoints::findEchoes(const PulseRecord& pulse, WaveformCounts& counts) {
  found_.clear();
  rankSegments();
  const auto& descriptor = job_.waves.pulses().descriptors().at(pulse.descriptor);
  const double metres_per_ps = kRangePerNanosecond / kPicosecondsPerNanosecond;
  findEmitted(descriptor);
  const double emitted_std = emitted_std_ * descriptor.unit_ns * kRangePerNanosecond;
  for (std::size_t i = 0; i < segments_.size(); ++i) {
    const PulseSegment& segment = segments_[i];
    if (rank_[i] == 0) continue;
    echoes_.decompose(segment.waveform, {});
    ++counts.waveforms;
    counts.single += echoes_.count() == 1 ? 1 : 0;
    counts.saturated += echoes_.found().saturated > 0 ? 1 : 0;
    for (int e = 0; e < echoes_.count(); ++e) {
      const double units =
          segment.start + echoes_.timeOf(e) / (kPicosecondsPerNanosecond * descriptor.unit_ns);
      if (isTaken(i, units)) continue;
      EchoAttributes attributes = echoes_.attributesOf(e, metres_per_ps);
      attributes.range_std =
          static_cast<float>(std::hypot(static_cast<double>(attributes.range_std), emitted_std));
      found_.push_back({units - emitted_units_, attributes, segment.sampling->channel,
                        segment.waveform.descriptor.largestCount()});
    }
  }
  std::stable_sort(found_.begin(), found_.end(),
                   [](const Echo& a, const Echo& b) { return a.units < b.units; });
  counts.echoes += found_.size();
  counts.added += found_.size();
}

void PulsePoints::store(const PulseRecord& pulse, std::uint64_t index, std::size_t number,
                        std::byte* record) const {
  const Echo& echo = found_[number];
  const LasHeader& header = job_.output.header();
  const LasRecordLayout& layout = job_.output.layout();
  const std::string name =
      job_.waves.pulses().path().string() + ": pulse " + std::to_string(index) + ": ";
  const Eigen::Vector3d at = pulse.anchor + echo.units * pulse.direction();
  for (int axis = 0; axis < 3; ++axis)
    LasRecordLayout::storeCoordinate(steps(at[axis], header.scale[axis], header.offset[axis], name),
                                     axis, record);
  const double share = static_cast<double>(echo.attributes.amplitude) / echo.largest_count;
  LasRecordLayout::storeIntensity(
      static_cast<std::uint16_t>(std::lround(std::clamp(share, 0.0, 1.0) * kLargestIntensity)),
      record);
  const auto of = std::min(static_cast<unsigned>(found_.size()), kMostReturns);
  const auto own = std::min(static_cast<unsigned>(number + 1), kMostReturns);
  const std::uint32_t scanner = job_.waves.pulses().descriptors().at(pulse.descriptor).scanner;
  const unsigned channel = scanner >= 1 && scanner <= kChannels ? scanner - 1 : 0;
  record[kReturnsAt] = static_cast<std::byte>(own | of << 4U);
  record[kFlagsAt] = static_cast<std::byte>(
      1U | channel << 4U | (pulse.scan_direction ? 0x40U : 0U) | (pulse.edge ? 0x80U : 0U));
  layout.storeClass(kUnclassified, record);
  layout.storeSource(sourceOf(pulse.source_id), record);
  layout.storeTime(job_.waves.pulses().timeOf(pulse), record);
  const auto& fields = job_.output.extraFields();
  storeEchoAttributes(echo.attributes, fields, record);
  storeLas(record + fields.back().position, static_cast<std::uint8_t>(echo.channel));
}

void PulsePoints::append(const PulseRecord& pulse, std::uint64_t index,
                         std::vector<std::byte>& records, WaveformCounts& counts) {
  ++counts.pulses;
  const bool has_waves = reader_.read(pulse, index, segments_);
  const bool returns = std::any_of(segments_.begin(), segments_.end(), [](const PulseSegment& s) {
    return s.sampling->type == PulseSampling::Type::returning;
  });
  if (!has_waves || !returns) {
    ++counts.without_waveform;
    return;
  }
  findEchoes(pulse, counts);
  const std::size_t length = job_.output.header().record_length;
  for (std::size_t i = 0; i < found_.size(); ++i) {
    records.resize(records.size() + length);
    store(pulse, index, i, &records[records.size() - length]);
  }
}

void PulsePoints::takeExamples(const PulseRecord& pulse, std::uint64_t index,
                               const TakeExample& take) {
  reader_.read(pulse, index, segments_);
  for (const PulseSegment& segment : segments_) {
    if (segment.sampling->type != PulseSampling::Type::returning) continue;
    echoes_.decompose(segment.waveform, {});
    take(echoes_.example(index));
  }
}

}  // namespace pcl_als::detail
