// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "waveform_truth.h"

#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/waveform/waveform_descriptor.h>

namespace pcl_als::benchmark {
namespace {

constexpr std::size_t kRecordsTogether = 65536;

/// Reads the echoes of a decomposed file, one waveform after the other.
class EchoReader {
 public:
  explicit EchoReader(const LasFile& las) : las_(las), length_(las.header().record_length) {
    amplitude_ = positionOf("amplitude");
    width_ = positionOf("echo_width");
    range_std_ = positionOf("range_std");
    new_ = positionOf("new_echo");
  }

  /// The echoes of the next waveform, with the time of its first sample.
  void next(double first_sample_ns, std::vector<FoundEcho>& echoes) {
    echoes.clear();
    const std::byte* record = peek();
    if (record == nullptr) throw InputError("the decomposed file has too few waveforms");
    const std::uint64_t packet = WaveformReference::of(record, las_.layout()).byte_offset;
    while (record != nullptr) {
      const WaveformReference own = WaveformReference::of(record, las_.layout());
      if (own.byte_offset != packet) return;
      const double ns = first_sample_ns + 1e-3 * static_cast<double>(own.location_ps);
      echoes.push_back({0.5 * simulation::kLightSpeed * ns,
                        static_cast<double>(loadLas<float>(record + amplitude_)),
                        static_cast<double>(loadLas<float>(record + width_)),
                        static_cast<double>(loadLas<float>(record + range_std_)),
                        loadLas<std::uint8_t>(record + new_) != 0});
      ++at_;
      record = peek();
    }
  }

 private:
  std::size_t positionOf(const std::string& name) const {
    for (const LasExtraField& field : las_.extraFields())
      if (field.name == name) return field.position;
    throw InputError("the decomposed file lacks the field " + name);
  }
  const std::byte* peek() {
    if (at_ == las_.header().point_count) return nullptr;
    if (at_ >= end_) {
      const std::size_t count =
          std::min<std::uint64_t>(kRecordsTogether, las_.header().point_count - at_);
      records_.resize(count * length_);
      las_.readRecords(at_, count, records_.data());
      begin_ = at_;
      end_ = at_ + count;
    }
    return &records_[(at_ - begin_) * length_];
  }

  const LasFile& las_;
  std::size_t length_, amplitude_ = 0, width_ = 0, range_std_ = 0, new_ = 0;
  std::vector<std::byte> records_;
  std::uint64_t at_ = 0, begin_ = 0, end_ = 0;
};

}  // namespace

DecomposedStrip decomposeSimulated(const simulation::SimulationOptions& options,
                                   const std::filesystem::path& folder,
                                   const WaveformSettings& given,
                                   const std::function<void(const DecomposedPulse&)>& take) {
  std::filesystem::create_directories(folder);
  const simulation::Simulator simulator(options);
  StripFileOptions files;
  files.folder = folder;
  const StripSummary summary = writeStrip(simulator, 0, files, 0, [](double) {});
  WaveformSettings settings = given;
  settings.move_returns = true;  // so that the records have the times of their echoes
  const auto output = folder / "echoes.las";
  DecomposedStrip strip;
  strip.result = decomposeWaveforms(folder / summary.file, output, settings);
  const LasFile las(output);
  strip.points_before = summary.points;
  strip.points_after = las.header().point_count;
  EchoReader reader(las);
  simulator.simulateWaveforms(
      0, 0,
      [&](const simulation::SimulatedWaveforms& truth) {
        for (const simulation::SimulatedPulse& pulse : truth.pulses) {
          DecomposedPulse found{truth, pulse, {}, {}};
          for (std::size_t i = pulse.point; i < pulse.point + pulse.points; ++i)
            found.returns.push_back(
                0.5 * simulation::kLightSpeed *
                (pulse.first_sample + 1e-3 * static_cast<double>(truth.locations[i])));
          reader.next(pulse.first_sample, found.echoes);
          take(found);
        }
      },
      true);
  return strip;
}

}  // namespace pcl_als::benchmark
