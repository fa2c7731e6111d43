// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/las/las_selection.h>
#include <pcl_als/processing/waveform_job.h>

#include "echo_cross_sections.h"
#include "waveform_echoes.h"
#include "waveform_pulses.h"

namespace pcl_als {
namespace {

/// Pulses that a thread decomposes at once.
constexpr std::size_t kPulsesTogether = 512;

std::map<unsigned, PulseResponse> responsesOf(const WaveformSource& source,
                                              const WaveformSettings& settings) {
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

/// Decomposes the pulses of a block on several threads, in the order of the file.
class BlockDecomposition {
 public:
  BlockDecomposition(const detail::EchoJob& job, LasSelectionWriter& output)
      : output_(output), threads_(job.settings.threads) {
    const unsigned workers = threadCount(threads_);
    for (unsigned i = 0; i < workers; ++i) workers_.push_back({detail::EchoWriter(job), {}, {}});
  }

  void take(const std::vector<detail::WaveformPulse>& pulses) {
    const std::size_t together = workers_.size() * kPulsesTogether;
    for (std::size_t from = 0; from < pulses.size(); from += together) {
      const std::size_t to = std::min(pulses.size(), from + together);
      const std::size_t chunks = (to - from + kPulsesTogether - 1) / kPulsesTogether;
      parallelFor(chunks, threads_, [&](std::size_t chunk) {
        Worker& worker = workers_[chunk];
        worker.records.clear();
        const std::size_t begin = from + chunk * kPulsesTogether;
        for (std::size_t i = begin; i < std::min(to, begin + kPulsesTogether); ++i)
          worker.writer.append(pulses[i], worker.records, worker.counts);
      });
      for (std::size_t chunk = 0; chunk < chunks; ++chunk) write(workers_[chunk]);
    }
  }
  const WaveformCounts& counts() const { return counts_; }

 private:
  struct Worker {
    detail::EchoWriter writer;
    std::vector<std::byte> records;
    WaveformCounts counts;
  };

  void write(Worker& worker) {
    if (!worker.records.empty())
      output_.append(worker.records.data(), worker.records.size() / recordLength(worker));
    counts_.merge(worker.counts);
    worker.counts = {};
  }
  static std::size_t recordLength(const Worker& worker) { return worker.writer.recordLength(); }

  LasSelectionWriter& output_;
  const int threads_;
  std::vector<Worker> workers_;
  WaveformCounts counts_;
};

}  // namespace

void WaveformCounts::merge(const WaveformCounts& other) {
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

WaveformResult decomposeWaveforms(const std::filesystem::path& input,
                                  const std::filesystem::path& output,
                                  const WaveformSettings& settings,
                                  const ProgressCallback& callback) {
  settings.check();
  const UnchangedInputs unchanged;
  ProgressReport progress(callback);
  const LasFile las(input);
  const WaveformSource source(las);
  std::optional<detail::EchoCrossSections> sections;
  if (settings.cross_sections.trajectory) sections.emplace(las, settings.cross_sections);
  progress.begin("Estimating the pulse");
  WaveformResult result;
  const detail::EchoCrossSections* const of_echoes = sections ? &*sections : nullptr;
  const detail::EchoJob job{las,
                            source,
                            settings,
                            responsesOf(source, settings),
                            detail::EchoFields(las, of_echoes),
                            las.toMetres(),
                            of_echoes};
  for (const auto& [index, response] : job.responses)
    result.pulse_width_ns.emplace_back(index, response.width() * kFwhmOfGaussian *
                                                  source.descriptors().at(index).spacing_ps /
                                                  kPicosecondsPerNanosecond);
  progress.end(numberText(result.pulse_width_ns.front().second, 2) + " ns wide");
  if (sections) {
    progress.begin("Calibrating cross sections");
    sections->calibrate(source, job.responses, settings);
    result.cross_sections = sections->result();
    progress.end("constant " + significantText(result.cross_sections->constant, 4) +
                 (result.cross_sections->calibrated ? "" : " (relative)"));
  }
  progress.begin("Decomposing waveforms");
  LasSelectionWriter writer(output, las, job.fields.fields, settings.threads);
  BlockDecomposition blocks(job, writer);
  detail::readPulses(las, [&](const std::vector<detail::WaveformPulse>& pulses) {
    blocks.take(pulses);
    progress.advance(static_cast<double>(blocks.counts().points) /
                     static_cast<double>(las.header().point_count));
  });
  writer.finish();
  result.counts = blocks.counts();
  const WaveformCounts& c = result.counts;
  result.counts.unmatched = c.points - c.without_waveform - c.matched;
  result.remarks = writer.remarks();
  if (result.cross_sections && result.cross_sections->reference)
    for (const std::string& warning : result.cross_sections->reference->warnings)
      result.remarks.push_back("warning: " + warning);
  progress.end(grouped(c.echoes) + " echoes in " + grouped(c.waveforms) + " waveforms");
  return result;
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
  for (const auto& [index, width] : result.pulse_width_ns)
    text += "descriptor " + std::to_string(index) + ": pulse of " + numberText(width, 2) +
            " ns (full width at half maximum)\n";
  text += grouped(c.waveforms) + " waveforms, " + grouped(c.single) + " with a single echo, " +
          grouped(c.saturated) + " with saturated samples\n";
  text += grouped(c.echoes) + " echoes: " + grouped(c.matched) + " of returns, " +
          grouped(c.added) + " new points; " + grouped(c.unmatched) + " returns without an echo, " +
          grouped(c.without_waveform) + " without a waveform\n";
  if (c.matched > 0)
    text +=
        "echoes are " + numberText(c.meanOffset(), 0) + " ps behind their returns in the mean\n";
  if (result.cross_sections) text += describeSections(*result.cross_sections, c);
  return text;
}

}  // namespace pcl_als
