// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "simulated_waveform_file.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "simulated_strip.h"

namespace pcl_als::detail {
namespace {

using simulation::SimulatedPulse;
using simulation::SimulatedWaveforms;

constexpr std::uint16_t kFirstDescriptor = 100, kPacketsRecord = 65535;
constexpr std::uint32_t kFewestSamples = 64;
constexpr unsigned kDescriptors = 7;
constexpr std::size_t kLengthAt = 20;    ///< of an EVLR
constexpr double kPicoseconds = 1000.0;  ///< per nanosecond
constexpr double kVoltsOfLargestCount = 1.0;
/// Metres per picosecond of two-way time.
constexpr double kRangePerPicosecond = 0.5 * simulation::kLightSpeed / kPicoseconds;

LasVlr descriptorRecord(unsigned index, const simulation::WaveformOptions& options) {
  LasVlr vlr{kLasSpecUser, static_cast<std::uint16_t>(kFirstDescriptor + index - 1),
             "Waveform Packet Descriptor", std::vector<std::byte>(26)};
  std::byte* at = vlr.data.data();
  storeLas(at, static_cast<std::uint8_t>(options.bits));
  storeLas(at + 1, std::uint8_t{0});  // not compressed
  storeLas(at + 2, kFewestSamples << (index - 1));
  storeLas(at + 6, static_cast<std::uint32_t>(std::lround(kPicoseconds * options.sample_spacing)));
  storeLas(at + 10, kVoltsOfLargestCount / options.largestCount());
  storeLas(at + 18, 0.0);
  return vlr;
}

/// Appends records and packets to both files.
class WaveformStrip {
 public:
  WaveformStrip(const simulation::Simulator& simulator, std::uint16_t strip,
                const StripFileOptions& files)
      : options_(simulator.options()),
        files_(files),
        writer_(files.folder / files.nameOf(strip), format(options_, strip, files)),
        packets_(files.folder / files.packetsOf(strip)),
        bits_(8 * ((static_cast<unsigned>(options_.waveform->bits) + 7) / 8)) {
    const std::vector<std::byte> header =
        serialiseLasVlr({kLasSpecUser, kPacketsRecord, "Waveform Data Packets", {}}, true);
    packets_.write(header.data(), header.size());
    packet_end_ = header.size();
  }

  void append(const SimulatedWaveforms& waveforms);
  std::uint64_t points() const { return writer_.pointCount(); }
  void finish() {
    const std::uint64_t length = packet_end_ - kLasEvlrHeader;
    packets_.writeAt(kLengthAt, &length, sizeof length);
    packets_.commit();
    writer_.finish();
  }

 private:
  static LasWriterOptions format(const simulation::SimulationOptions& options, std::uint16_t strip,
                                 const StripFileOptions& files) {
    LasWriterOptions las = stripFormat(options, strip, files);
    las.point_format = files.waveform_format;
    las.version_minor = files.waveform_format < 6 ? 3 : 4;
    for (unsigned i = 1; i <= kDescriptors; ++i)
      las.vlrs.push_back(descriptorRecord(i, *options.waveform));
    return las;
  }
  void encode(const SimulatedWaveforms& waveforms);
  void appendPacket(const SimulatedWaveforms& waveforms, const SimulatedPulse& pulse);

  const simulation::SimulationOptions& options_;
  const StripFileOptions& files_;
  LasWriter writer_;
  AtomicFile packets_;
  unsigned bits_;                 ///< that a sample is stored with
  std::uint64_t packet_end_ = 0;  ///< from the header of the record of packets
  PointChunk chunk_;
  std::vector<std::byte> records_, packet_bytes_;
  std::vector<double> samples_;
};

/// The records without the part that refers to waveforms.
void WaveformStrip::encode(const SimulatedWaveforms& waveforms) {
  const LasHeader& header = writer_.header();
  const std::size_t length = header.record_length;
  const bool channels_fit = options_.scanner.channels <= 4 && writer_.layout().extended;
  fillChunk(waveforms.points, timeShiftOf(files_), channels_fit, chunk_);
  records_.resize(waveforms.points.size() * length);
  const Eigen::Vector3d metres = writer_.units().metres();
  const std::string name = files_.nameOf(header.file_source_id);
  encodeLasRecords(chunk_, length, writer_.layout(), header.scale.cwiseProduct(metres),
                   header.offset.cwiseProduct(metres), writer_.pointCount(), name, records_.data());
  const auto columns = stripColumns(waveforms.points, files_);
  for (std::size_t k = 0; k < columns.size(); ++k)
    encodeLasExtraField(columns[k], length, writer_.extraFields()[k], name, records_.data());
}

/// The packet of a pulse, and the references of its returns to it.
void WaveformStrip::appendPacket(const SimulatedWaveforms& waveforms, const SimulatedPulse& pulse) {
  const std::uint16_t* counts = &waveforms.counts[pulse.count];
  samples_.assign(counts, counts + pulse.counts);
  const std::vector<std::byte> packet = packWaveform(samples_, bits_);
  WaveformReference reference;
  reference.descriptor = 1;
  while (kFewestSamples << (reference.descriptor - 1) < pulse.counts) ++reference.descriptor;
  reference.byte_offset = packet_end_ + packet_bytes_.size();
  reference.bytes = static_cast<std::uint32_t>(packet.size());
  const Eigen::Vector3d metres = writer_.units().metres();
  reference.direction = (kRangePerPicosecond * pulse.to_sensor.cwiseQuotient(metres)).cast<float>();
  for (std::size_t i = pulse.point; i < pulse.point + pulse.points; ++i) {
    reference.location_ps = waveforms.locations[i];
    reference.store(&records_[i * writer_.header().record_length], writer_.layout());
  }
  packet_bytes_.insert(packet_bytes_.end(), packet.begin(), packet.end());
}

void WaveformStrip::append(const SimulatedWaveforms& waveforms) {
  encode(waveforms);
  packet_bytes_.clear();
  for (const SimulatedPulse& pulse : waveforms.pulses) appendPacket(waveforms, pulse);
  packets_.write(packet_bytes_.data(), packet_bytes_.size());
  packet_end_ += packet_bytes_.size();
  writer_.appendRecords(records_.data(), waveforms.points.size());
}

}  // namespace

StripSummary writeWaveformStrip(const simulation::Simulator& simulator, std::size_t strip,
                                const StripFileOptions& options, int threads,
                                const std::function<void(double share)>& progress) {
  const std::uint16_t id = simulator.options().lines[strip].id;
  StripSummary summary{options.nameOf(id), simulator.pulseCount(strip), 0};
  WaveformStrip files(simulator, id, options);
  std::uint64_t pulses = 0;
  simulator.simulateWaveforms(strip, threads, [&](const SimulatedWaveforms& waveforms) {
    if (waveforms.pulses.empty()) return;
    files.append(waveforms);
    pulses = waveforms.pulses.back().number;
    progress(static_cast<double>(pulses) / static_cast<double>(summary.pulses));
  });
  files.finish();
  summary.points = files.points();
  return summary;
}

}  // namespace pcl_als::detail
