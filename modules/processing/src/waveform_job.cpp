// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/las/las_selection.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/pulse_waves_file.h>
#include <pcl_als/waveform/waveform_examples.h>

#include "block_decomposition.h"
#include "echo_cross_sections.h"
#include "pulse_waves_job.h"
#include "used_pulses.h"
#include "waveform_echoes.h"
#include "waveform_pulses.h"

namespace pcl_als {
namespace {

ResponseChoice responsesOf(const WaveformSource& source, const WaveformSettings& settings) {
  const LasFile& las = source.las();
  const std::size_t length = las.header().record_length;
  std::vector<std::byte> records;
  WaveformReader reader(source);
  Waveform waveform;
  const WaveformRunReader read = [&](std::uint64_t first, std::size_t count, const auto& take) {
    records.resize(count * length);
    las.readRecords(first, count, records.data());
    for (std::size_t i = 0; i < count; ++i)
      if (reader.read(&records[i * length], first + i, waveform)) take(waveform);
  };
  return pulseResponses(source.descriptors(), settings, las.header().point_count, read,
                        las.path().string());
}

}  // namespace

void WaveformSettings::checkShown(std::uint64_t count, const std::string& file,
                                  const char* what) const {
  for (const std::uint64_t number : shown)
    if (number >= count)
      throw UsageError(file + ": has no " + what + " " + std::to_string(number) +
                       (count > 0 ? ", the numbers are 0 to " + std::to_string(count - 1) : ""));
}

void WaveformCounts::merge(const WaveformCounts& other) {
  pulses += other.pulses;
  points += other.points;
  without_waveform += other.without_waveform;
  waveforms += other.waveforms;
  echoes += other.echoes;
  matched += other.matched;
  unmatched += other.unmatched;
  added += other.added;
  saturated += other.saturated;
  single += other.single;
  sum_offset_ps += other.sum_offset_ps;
  uncovered += other.uncovered;
  attenuated += other.attenuated;
  opaque += other.opaque;
}

namespace {

/// The waveforms of the points that are asked for, or a choice from the whole file.
std::vector<WaveformExample> examplesOf(const detail::EchoJob& job) {
  const std::uint64_t all = job.las.header().point_count;
  detail::EchoWriter echoes(job);
  const auto one = [&](std::uint64_t number, const TakeExample& take) {
    const std::uint64_t first = number - std::min<std::uint64_t>(number, kMostPointsOfPulse - 1);
    const std::uint64_t end = std::min(all, number + kMostPointsOfPulse);
    detail::readPulseRun(job.las, first, end - first, [&](const detail::WaveformPulse& pulse) {
      if (number < pulse.first || number >= pulse.first + pulse.count) return;
      if (const auto example = echoes.example(pulse, number)) take(*example);
    });
  };
  const auto run = [&](std::uint64_t first, std::size_t count, const TakeExample& take) {
    detail::readPulseRun(job.las, first, count, [&](const detail::WaveformPulse& pulse) {
      if (const auto example = echoes.example(pulse, pulse.first)) take(*example);
    });
  };
  return waveformExamples(all, job.settings.shown, one, run);
}

/// decomposeWaveforms() of a file of points.
WaveformResult decomposePoints(const std::filesystem::path& input,
                               const std::filesystem::path& output,
                               const WaveformSettings& settings, ProgressReport& progress) {
  const LasFile las(input);
  const WaveformSource source(las);
  settings.checkShown(las.header().point_count, input.string(), "point");
  std::optional<detail::EchoCrossSections> sections;
  if (settings.cross_sections.trajectory) sections.emplace(las, settings.cross_sections);
  progress.begin("Estimating the pulse");
  WaveformResult result;
  ResponseChoice responses = responsesOf(source, settings);
  detail::describePulses(responses, source.descriptors(), "as given", result);
  const detail::EchoCrossSections* const of_echoes = sections ? &*sections : nullptr;
  const detail::EchoJob job{las,
                            source,
                            settings,
                            std::move(responses.by_descriptor),
                            detail::EchoFields(las, of_echoes),
                            las.toMetres(),
                            of_echoes};
  progress.end(numberText(result.pulses.front().width_ns, 2) + " ns wide");
  if (sections) {
    progress.begin("Calibrating cross sections");
    sections->calibrate(source, job.responses, settings);
    result.cross_sections = sections->result();
    progress.end("constant " + significantText(result.cross_sections->constant, 4) +
                 (result.cross_sections->calibrated ? "" : " (relative)"));
  }
  progress.begin("Decomposing waveforms");
  LasSelectionWriter writer(output, las, job.fields.fields, settings.threads);
  detail::BlockDecomposition<detail::EchoWriter> blocks(
      [&] { return detail::EchoWriter(job); },
      [&](const std::vector<std::byte>& records) {
        writer.append(records.data(), records.size() / job.fields.record_length);
      },
      settings.threads);
  detail::readPulses(las, [&](const std::vector<detail::WaveformPulse>& pulses) {
    blocks.take(pulses.size(),
                [&](detail::EchoWriter& echoes, std::size_t i, auto& records,
                    WaveformCounts& counts) { echoes.append(pulses[i], records, counts); });
    progress.advance(static_cast<double>(blocks.counts().points) /
                     static_cast<double>(las.header().point_count));
  });
  writer.finish();
  result.counts = blocks.counts();
  const WaveformCounts& c = result.counts;
  result.counts.unmatched = c.points - c.without_waveform - c.matched;
  if (settings.examples) result.examples = examplesOf(job);
  result.remarks = writer.remarks();
  if (result.cross_sections && result.cross_sections->reference)
    for (const std::string& warning : result.cross_sections->reference->warnings)
      result.remarks.push_back("warning: " + warning);
  progress.end(grouped(c.echoes) + " echoes in " + grouped(c.waveforms) + " waveforms");
  return result;
}

}  // namespace

WaveformResult decomposeWaveforms(const std::filesystem::path& input,
                                  const std::filesystem::path& output,
                                  const WaveformSettings& settings,
                                  const ProgressCallback& callback) {
  settings.check();
  const UnchangedInputs unchanged;
  ProgressReport progress(callback);
  if (isPulseFile(input)) return detail::decomposePulses(input, output, settings, progress);
  if (settings.range_from != RangeOrigin::automatic)
    throw UsageError(input.string() +
                     ": only PulseWaves files have emitted pulses that ranges can be counted from");
  return decomposePoints(input, output, settings, progress);
}

namespace {

std::string describeSections(const CrossSectionResult& sections, const WaveformCounts& counts) {
  std::string text = "cross sections: calibration constant " + shortText(sections.constant);
  if (sections.calibrated)
    text += " m2 / (count ns km4)";
  else
    text += ", they are relative";
  if (sections.reference)
    text += ", relative std " + significantText(sections.reference->relative_std, 2);
  text += '\n';
  if (sections.full_coefficient > 0.0)
    text += "attenuation: a whole pulse has the backscatter coefficient " +
            significantText(sections.full_coefficient, 4) + "; " + grouped(counts.attenuated) +
            " echoes behind others corrected, " + grouped(counts.opaque) +
            " of them for the least transmission of " +
            shortText(CrossSectionResult::kLeastTransmission) + '\n';
  if (counts.uncovered > 0)
    text += grouped(counts.uncovered) +
            " waveforms without a range from the trajectory have no cross sections\n";
  return text;
}

}  // namespace

std::string describe(const WaveformResult& result) {
  const WaveformCounts& c = result.counts;
  std::string text;
  for (const UsedPulse& pulse : result.pulses)
    text += "descriptor " + std::to_string(pulse.descriptor) + ": pulse of " +
            numberText(pulse.width_ns, 2) + " ns (full width at half maximum), " + pulse.origin +
            '\n';
  text += grouped(c.waveforms) + " waveforms, " + grouped(c.single) + " with a single echo, " +
          grouped(c.saturated) + " with saturated samples\n";
  if (c.pulses > 0)
    text += grouped(c.echoes) + " echoes of " + grouped(c.pulses) + " pulses; " +
            counted(c.without_waveform, "pulse") + " without a returning waveform\n";
  else
    text += grouped(c.echoes) + " echoes: " + grouped(c.matched) + " of returns, " +
            grouped(c.added) + " new points; " + grouped(c.unmatched) +
            " returns without an echo, " + grouped(c.without_waveform) + " without a waveform\n";
  if (c.matched > 0)
    text +=
        "echoes are " + numberText(c.meanOffset(), 0) + " ps behind their returns in the mean\n";
  if (result.cross_sections) text += describeSections(*result.cross_sections, c);
  return text;
}

}  // namespace pcl_als
