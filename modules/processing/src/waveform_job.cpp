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
#include <pcl_als/waveform/pulse_width.h>

#include "waveform_echoes.h"
#include "waveform_pulses.h"

namespace pcl_als {
namespace {

constexpr double kPicosecondsPerNanosecond = 1000.0;
/// Waveforms from which the width of the response is estimated, for each descriptor.
constexpr std::size_t kWaveformsForWidth = 4000;
/// Runs of records that these are taken from, over the whole file.
constexpr std::uint64_t kRuns = 40;
/// Pulses that a thread decomposes at once.
constexpr std::size_t kPulsesTogether = 512;

void check(const WaveformSettings& s) {
  if (!(s.pulse_width_ns >= 0.0)) throw UsageError("the width of the pulse must not be negative");
  if (!s.pulse.empty() && !(s.pulse_spacing_ns > 0.0))
    throw UsageError("the spacing of the pulse's samples must be positive");
  if (!s.pulse.empty() && s.pulse_width_ns > 0.0)
    throw UsageError("either the width of the pulse or its samples can be given");
  if (!(s.saturation >= 0.0)) throw UsageError("the saturation must not be negative");
}

/// Takes waveforms from all over the file, by descriptor.
std::map<unsigned, PulseWidthEstimate> sampleWaveforms(const WaveformSource& source,
                                                       double saturation) {
  const LasFile& las = source.las();
  const std::uint64_t all = las.header().point_count;
  const std::size_t length = las.header().record_length;
  const std::size_t run = std::min<std::uint64_t>(all, 1 + kWaveformsForWidth / kRuns);
  std::map<unsigned, PulseWidthEstimate> estimates;
  std::vector<std::byte> records(run * length);
  WaveformReader reader(source);
  Waveform waveform;
  std::uint64_t behind = 0;  // the last run
  for (std::uint64_t k = 0; k < kRuns && all > 0; ++k) {
    const std::uint64_t first = std::max(behind, k * (all - run) / kRuns);
    const std::size_t count = std::min<std::uint64_t>(run, all - first);
    if (count == 0) break;
    las.readRecords(first, count, records.data());
    behind = first + count;
    std::uint64_t last_offset = ~std::uint64_t{0};
    for (std::size_t i = 0; i < count; ++i) {
      if (!reader.read(&records[i * length], first + i, waveform)) continue;
      if (waveform.reference.byte_offset == last_offset) continue;
      last_offset = waveform.reference.byte_offset;
      const double largest = waveform.descriptor.largestCount();
      estimates[waveform.reference.descriptor].add(waveform.counts,
                                                   saturation > 0.0 ? saturation : largest);
    }
  }
  return estimates;
}

/// Responses of a width that was given, for all descriptors, or samples.
PulseResponse givenResponse(const WaveformSettings& s, const WaveformDescriptor& d) {
  const double samples_per_ns = kPicosecondsPerNanosecond / d.spacing_ps;
  if (!s.pulse.empty()) return PulseResponse::sampled(s.pulse, s.pulse_spacing_ns * samples_per_ns);
  return PulseResponse::gaussian(s.pulse_width_ns * samples_per_ns / kFwhmOfGaussian);
}

/// The width in nanoseconds is the same for all descriptors: that with most waveforms has it for
/// the others that have too few.
std::map<unsigned, PulseResponse> responsesOf(const WaveformSource& source,
                                              const WaveformSettings& settings) {
  std::map<unsigned, PulseResponse> responses;
  const bool given = settings.pulse_width_ns > 0.0 || !settings.pulse.empty();
  std::map<unsigned, double> width_ns;
  double usual_ns = 0.0;
  if (!given) {
    std::size_t most = 0;
    for (const auto& [index, estimate] : sampleWaveforms(source, settings.saturation)) {
      const std::optional<double> width = estimate.width();
      if (!width) continue;
      width_ns[index] =
          *width * source.descriptors().at(index).spacing_ps / kPicosecondsPerNanosecond;
      if (estimate.waveforms() > most) usual_ns = width_ns[index];
      most = std::max(most, estimate.waveforms());
    }
    if (width_ns.empty())
      throw InputError(source.las().path().string() +
                       ": too few waveforms have a single strong echo to estimate the width of "
                       "the pulse; state it");
  }
  for (const auto& [index, d] : source.descriptors()) {
    if (given) {
      responses.emplace(index, givenResponse(settings, d));
      continue;
    }
    const auto own = width_ns.find(index);
    const double ns = own == width_ns.end() ? usual_ns : own->second;
    responses.emplace(index,
                      PulseResponse::gaussian(ns * kPicosecondsPerNanosecond / d.spacing_ps));
  }
  return responses;
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
}

WaveformResult decomposeWaveforms(const std::filesystem::path& input,
                                  const std::filesystem::path& output,
                                  const WaveformSettings& settings,
                                  const ProgressCallback& callback) {
  check(settings);
  const UnchangedInputs unchanged;
  ProgressReport progress(callback);
  const LasFile las(input);
  const WaveformSource source(las);
  progress.begin("Estimating the pulse");
  WaveformResult result;
  const detail::EchoJob job{
      las,           source, settings, responsesOf(source, settings), detail::EchoFields(las),
      las.toMetres()};
  for (const auto& [index, response] : job.responses)
    result.pulse_width_ns.emplace_back(index, response.width() * kFwhmOfGaussian *
                                                  source.descriptors().at(index).spacing_ps /
                                                  kPicosecondsPerNanosecond);
  progress.end(numberText(result.pulse_width_ns.front().second, 2) + " ns wide");
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
  progress.end(grouped(c.echoes) + " echoes in " + grouped(c.waveforms) + " waveforms");
  return result;
}

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
  return text;
}

}  // namespace pcl_als
