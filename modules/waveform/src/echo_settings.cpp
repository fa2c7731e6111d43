// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <optional>

#include <pcl_als/common/errors.h>
#include <pcl_als/waveform/echo_settings.h>
#include <pcl_als/waveform/pulse_estimate.h>
#include <pcl_als/waveform/waveform_reader.h>

namespace pcl_als {
namespace {

/// Waveforms from which the response is estimated, for each descriptor.
constexpr std::size_t kWaveformsForPulse = 10000;

/// Takes waveforms from all over the survey, by descriptor.
std::map<unsigned, PulseEstimate> sampleWaveforms(const EchoSettings& settings,
                                                  std::uint64_t points,
                                                  const WaveformRunReader& read) {
  std::map<unsigned, PulseEstimate> estimates;
  visitRuns(points, kWaveformsForPulse, [&](std::uint64_t first, std::size_t count) {
    std::uint64_t last_offset = ~std::uint64_t{0};
    read(first, count, [&](const Waveform& waveform) {
      if (waveform.reference.byte_offset == last_offset) return;
      last_offset = waveform.reference.byte_offset;
      estimates[waveform.reference.descriptor].add(waveform.counts,
                                                   settings.saturationOf(waveform.descriptor));
    });
  });
  return estimates;
}

PulseResponse givenResponse(const EchoSettings& s, const WaveformDescriptor& d) {
  const double samples_per_ns = kPicosecondsPerNanosecond / d.spacing_ps;
  if (!s.pulse.empty()) return PulseResponse::sampled(s.pulse, s.pulse_spacing_ns * samples_per_ns);
  return PulseResponse::gaussian(s.pulse_width_ns * samples_per_ns / kFwhmOfGaussian);
}

}  // namespace

void visitRuns(std::uint64_t all, std::uint64_t wanted,
               const std::function<void(std::uint64_t first, std::size_t count)>& visit) {
  constexpr std::uint64_t kRuns = 40;
  const std::uint64_t run = std::min(all, 1 + wanted / kRuns);
  std::uint64_t behind = 0;  // the last run
  for (std::uint64_t k = 0; k < kRuns && behind < all; ++k) {
    const std::uint64_t first = std::max(behind, k * (all - run) / kRuns);
    behind = std::min(all, first + run);
    visit(first, static_cast<std::size_t>(behind - first));
  }
}

void EchoSettings::check() const {
  if (!(pulse_width_ns >= 0.0)) throw UsageError("the width of the pulse must not be negative");
  if (!pulse.empty() && !(pulse_spacing_ns > 0.0))
    throw UsageError("the spacing of the pulse's samples must be positive");
  if (!pulse.empty() && pulse_width_ns > 0.0)
    throw UsageError("either the width of the pulse or its samples can be given");
  if (!(saturation >= 0.0)) throw UsageError("the saturation must not be negative");
}

DecompositionSettings EchoSettings::decompositionOf(const WaveformDescriptor& descriptor) const {
  DecompositionSettings settings;
  settings.false_echoes = false_echoes;
  settings.ringing = ringing;
  settings.ringing_reach = ringing_reach_ns * kPicosecondsPerNanosecond / descriptor.spacing_ps;
  settings.saturation = saturationOf(descriptor);
  settings.clipping = 0.0;
  return settings;
}

ResponseChoice pulseResponses(const std::map<unsigned, WaveformDescriptor>& descriptors,
                              const EchoSettings& settings, std::uint64_t points,
                              const WaveformRunReader& read, const std::string& name) {
  ResponseChoice choice;
  if (settings.givesResponse()) {
    for (const auto& [index, d] : descriptors)
      choice.by_descriptor.emplace(index, givenResponse(settings, d));
    return choice;
  }
  std::size_t most = 0;
  for (const auto& [index, waveforms] : sampleWaveforms(settings, points, read)) {
    std::optional<EstimatedPulse> pulse = waveforms.estimate();
    if (!pulse) continue;
    choice.estimates.emplace(index, std::move(*pulse));
    if (waveforms.waveforms() > most) choice.usual = index;
    most = std::max(most, waveforms.waveforms());
  }
  if (choice.estimates.empty())
    throw InputError(name +
                     ": too few waveforms have a single strong echo to estimate the width of "
                     "the pulse; state it");
  const PulseResponse& usual = choice.estimates.at(choice.usual).response;
  for (const auto& [index, d] : descriptors) {
    const auto own = choice.estimates.find(index);
    const double ratio = static_cast<double>(descriptors.at(choice.usual).spacing_ps) /
                         static_cast<double>(d.spacing_ps);
    choice.by_descriptor.emplace(
        index, own == choice.estimates.end() ? usual.stretched(ratio) : own->second.response);
  }
  return choice;
}

}  // namespace pcl_als
