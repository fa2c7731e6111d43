// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_waves_job.h"

#include <algorithm>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/waveform/emitted_pulse.h>
#include <pcl_als/waveform/waveform_examples.h>

#include "block_decomposition.h"
#include "pulse_points.h"
#include "used_pulses.h"

namespace pcl_als::detail {
namespace {

constexpr std::uint64_t kPulsesTogether = std::uint64_t{1} << 15;
/// Pulses whose emitted waveforms are averaged.
constexpr std::uint64_t kEmittedPulses = 4000;

void refuseWhatNeedsReturns(const std::filesystem::path& input, const WaveformSettings& settings) {
  const std::string name = input.string() + ": a Pulse file has pulses and no returns, ";
  if (!settings.new_echoes) throw UsageError(name + "so that all of its echoes are new ones");
  if (settings.move_returns) throw UsageError(name + "so that none can be moved to its echo");
  if (settings.cross_sections.trajectory)
    throw UsageError(name + "and cross sections are computed for returns only");
}

/// The mean of the emitted pulses, by the spacing of their samples, which is the same for all.
class EmittedPulses {
 public:
  EmittedPulses(const WavesFile& waves, const WaveformSettings& settings) {
    PulseWavesReader reader(waves);
    std::vector<PulseRecord> pulses;
    std::vector<PulseSegment> segments;
    const std::uint64_t all = waves.pulses().header().pulse_count;
    visitRuns(all, kEmittedPulses, [&](std::uint64_t first, std::size_t count) {
      waves.pulses().read(first, count, pulses);
      for (std::size_t i = 0; i < pulses.size(); ++i) {
        reader.read(pulses[i], first + i, segments);
        for (const PulseSegment& segment : segments) add(segment, settings);
      }
    });
  }

  bool begins_are_stated() const { return begins_are_stated_; }
  double spacing_ns() const { return spacing_ns_; }
  std::optional<EmittedPulse> mean() const { return mean_.result(); }
  /// From the origin of the pulse to the maximum, nanoseconds, in the mean.
  double delay_ns(const EmittedPulse& mean) const {
    return sum_start_ns_ / static_cast<double>(mean_.pulses()) + mean.peak * spacing_ns_;
  }

 private:
  void add(const PulseSegment& segment, const WaveformSettings& settings) {
    const PulseSampling& sampling = *segment.sampling;
    if (sampling.type != PulseSampling::Type::outgoing) return;
    if (mean_.pulses() > 0 && sampling.spacing_ns != spacing_ns_) return;
    spacing_ns_ = sampling.spacing_ns;
    begins_are_stated_ = sampling.duration_bits > 0;
    const std::size_t before = mean_.pulses();
    mean_.add(segment.waveform.counts, settings.saturationOf(segment.waveform.descriptor));
    if (mean_.pulses() > before)
      sum_start_ns_ += segment.start / segment.step * sampling.spacing_ns;
  }

  EmittedPulseMean mean_;
  double spacing_ns_ = 0.0, sum_start_ns_ = 0.0;
  bool begins_are_stated_ = false;
};

/// The returning waveforms of runs of pulses.
WaveformRunReader runsOf(const WavesFile& waves) {
  return [&waves](std::uint64_t first, std::size_t count, const auto& take) {
    PulseWavesReader reader(waves);
    std::vector<PulseRecord> pulses;
    std::vector<PulseSegment> segments;
    waves.pulses().read(first, count, pulses);
    for (std::size_t i = 0; i < count; ++i) {
      reader.read(pulses[i], first + i, segments);
      for (const PulseSegment& segment : segments)
        if (segment.sampling->type == PulseSampling::Type::returning) take(segment.waveform);
    }
  };
}

/// Whether times count from emitted pulses, as the settings and the file say.
EmittedTimes emittedTimes(const WavesFile& waves, const EmittedPulses& emitted,
                          const std::optional<EmittedPulse>& mean, RangeOrigin from,
                          std::vector<std::string>& remarks) {
  EmittedTimes times;
  if (!mean) {
    if (from == RangeOrigin::emitted)
      throw InputError(waves.pulses().path().string() +
                       ": has no emitted pulses, or they are cut off; ranges cannot be counted "
                       "from them");
    return times;
  }
  times.response = PulseResponse::sampled(mean->samples, 1.0);
  times.of_stated = from != RangeOrigin::anchor;
  times.of_others = from == RangeOrigin::emitted;
  times.mean_ns = emitted.delay_ns(*mean);
  const bool used = times.of_others || (times.of_stated && emitted.begins_are_stated());
  remarks.push_back(
      "emitted pulses have their maximum " + numberText(times.mean_ns, 2) +
      " ns behind the origin of their pulse in the mean; times of echoes count from " +
      (used ? "the emitted pulse" : "the anchor"));
  return times;
}

/// As given, from emitted pulses, or from single echoes; described in the result.
std::map<unsigned, PulseResponse> responsesOf(const WavesFile& waves,
                                              const WaveformSettings& settings,
                                              const EmittedPulses& emitted,
                                              const std::optional<EmittedPulse>& mean,
                                              WaveformResult& result) {
  const PulseWavesFile& file = waves.pulses();
  EchoSettings by = settings;
  std::string origin = "as given";
  if (!settings.givesResponse() && mean) {
    by.pulse = mean->samples;
    by.pulse_spacing_ns = emitted.spacing_ns();
    origin = "the mean of " + counted(mean->pulses, "emitted pulse");
  }
  ResponseChoice choice = pulseResponses(file.waveformDescriptors(), by, file.header().pulse_count,
                                         runsOf(waves), file.path().string());
  describePulses(choice, file.waveformDescriptors(), origin, result);
  return std::move(choice.by_descriptor);
}

void addRemarks(const PulseWavesFile& file, std::vector<std::string>& remarks) {
  if (!file.tables().empty())
    remarks.push_back(
        "lookup tables of samples are not applied: the format does not state their unit");
  const auto& descriptors = file.descriptors();
  const bool returns =
      std::any_of(descriptors.begin(), descriptors.end(), [](const auto& descriptor) {
        return std::any_of(
            descriptor.second.samplings.begin(), descriptor.second.samplings.end(),
            [](const PulseSampling& s) { return s.type == PulseSampling::Type::returning; });
      });
  if (!returns)
    throw InputError(file.path().string() +
                     ": none of its pulse descriptors has a returning waveform");
}

/// The waveforms of the pulses that are asked for, or a choice from the whole file.
std::vector<WaveformExample> examplesOf(const PulseJob& job) {
  PulsePoints points(job);
  std::vector<PulseRecord> pulses;
  const auto run = [&](std::uint64_t first, std::size_t count, const TakeExample& take) {
    job.waves.pulses().read(first, count, pulses);
    for (std::size_t i = 0; i < count; ++i) points.takeExamples(pulses[i], first + i, take);
  };
  const auto one = [&](std::uint64_t number, const TakeExample& take) { run(number, 1, take); };
  return waveformExamples(job.waves.pulses().header().pulse_count, job.settings.shown, one, run);
}

}  // namespace

WaveformResult decomposePulses(const std::filesystem::path& input,
                               const std::filesystem::path& output,
                               const WaveformSettings& settings, ProgressReport& progress) {
  refuseWhatNeedsReturns(input, settings);
  const PulseWavesFile file(input);
  const WavesFile waves(file);
  settings.checkShown(file.header().pulse_count, input.string(), "pulse");
  WaveformResult result;
  addRemarks(file, result.remarks);
  progress.begin("Estimating the pulse");
  const EmittedPulses emitted(waves, settings);
  const std::optional<EmittedPulse> mean = emitted.mean();
  const EmittedTimes times =
      emittedTimes(waves, emitted, mean, settings.range_from, result.remarks);
  const std::map<unsigned, PulseResponse> responses =
      responsesOf(waves, settings, emitted, mean, result);
  progress.end(numberText(result.pulses.front().width_ns, 2) + " ns wide");
  progress.begin("Decomposing waveforms");
  LasWriter writer(output, pointsOfPulses(file));
  const PulseJob job{waves, settings, responses, times, writer};
  BlockDecomposition<PulsePoints> blocks(
      [&] { return PulsePoints(job); },
      [&](const std::vector<std::byte>& records) {
        writer.appendRecords(records.data(), records.size() / writer.header().record_length);
      },
      settings.threads);
  const std::uint64_t all = file.header().pulse_count;
  std::vector<PulseRecord> pulses;
  for (std::uint64_t first = 0; first < all; first += pulses.size()) {
    file.read(first, std::min(kPulsesTogether, all - first), pulses);
    blocks.take(pulses.size(),
                [&](PulsePoints& points, std::size_t i, auto& records, WaveformCounts& counts) {
                  points.append(pulses[i], first + i, records, counts);
                });
    progress.advance(static_cast<double>(first) / static_cast<double>(all));
  }
  writer.finish();
  result.counts = blocks.counts();
  if (settings.examples) result.examples = examplesOf(job);
  progress.end(grouped(result.counts.echoes) + " echoes in " + grouped(result.counts.waveforms) +
               " waveforms");
  return result;
}

}  // namespace pcl_als::detail
