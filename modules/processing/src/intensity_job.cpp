// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/processing/file_batch.h>
#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/processing/intensity_output.h>
#include <pcl_als/processing/intensity_run.h>

namespace pcl_als {
namespace {

/// The job: what its phases share.
class IntensityJob {
 public:
  IntensityJob(const std::vector<std::string>& paths, const IntensityOptions& options,
               IntensityRun& run, IntensityResult& result, ProgressReport& progress)
      : paths_(paths), options_(options), run_(run), result_(result), progress_(progress) {}

  void useStored(const StoredRadiometry& stored);
  void compareStrips();
  void useTargets();
  void write(const std::vector<std::string>& outputs);
  void judge();

 private:
  bool estimates() const {
    const OverlapSettings& overlaps = run_.settings().overlaps;
    return overlaps.estimate_gains ||
           std::any_of(overlaps.estimate.begin(), overlaps.estimate.end(),
                       [](bool e) { return e; });
  }
  void warn(const std::string& text) {
    result_.warnings.push_back(text);
    progress_.remark("warning: " + text);
  }
  std::string whyUnreliable(const LostIntensities& lost) const;
  std::string writeFile(std::size_t file, const std::string& output,
                        const std::function<void(double)>& fraction);
  void showOthers();

  const std::vector<std::string>& paths_;
  const IntensityOptions& options_;
  IntensityRun& run_;
  IntensityResult& result_;
  ProgressReport& progress_;
  std::vector<char> seen_;  ///< by file: written by this process
};

void IntensityJob::useStored(const StoredRadiometry& stored) {
  if (stored.echo_energy != run_.settings().echo_energy)
    throw InputError(std::string("the radiometry of an earlier run is that of ") +
                     (stored.echo_energy ? "energies of echoes" : "intensities"));
  std::vector<double> gains;
  for (const std::string& strip : run_.strips()) {
    const auto at = stored.gains.find(strip);
    if (at == stored.gains.end())
      throw InputError("the radiometry of an earlier run has no strip " + strip);
    gains.push_back(at->second);
  }
  run_.useModel(stored.model);
  run_.useConstant(stored.constant);
  run_.useGains(gains);
}

void IntensityJob::compareStrips() {
  if (!estimates() && !(run_.settings().statistics && run_.strips().size() > 1)) return;
  progress_.begin("Comparing strips");
  result_.overlaps = run_.adjust([this](double fraction) { progress_.advance(fraction); });
  progress_.end(grouped(result_.overlaps->cells) + " smooth cells measured in several strips");
  for (const std::string& warning : result_.overlaps->warnings) warn(warning);
}

void IntensityJob::useTargets() {
  if (options_.targets.empty()) return;
  progress_.begin("Measuring reference targets");
  result_.reference = run_.refer(options_.targets, options_.target_radius);
  progress_.end(grouped(result_.reference->targets.size()) + " targets");
  for (const std::string& warning : result_.reference->warnings) warn(warning);
  if (!(result_.reference->constant > 0.0))
    warn("no reflectance is written: no target has enough points");
}

std::string IntensityJob::writeFile(std::size_t file, const std::string& output,
                                    const std::function<void(double)>& fraction) {
  IntensityOutcome outcome(run_.strips().size());
  if (isRoot(options_.batch.processes)) outcome.seen = result_.outcome.seen;
  writeCorrected(run_, file, output, options_.output, fraction, outcome);
  seen_[file] = 1;
  ByteWriter out;
  outcome.counts[file].put(out);
  outcome.statistics.put(out);
  for (const IntensityHistogram& histogram : outcome.histograms) histogram.put(out);
  out.put(outcome.remarks);
  return out.take();
}

/// Positions of points that this process did not write, for pictures.
void IntensityJob::showOthers() {
  if (!result_.outcome.seen || !isRoot(options_.batch.processes)) return;
  for (std::size_t file = 0; file < run_.files(); ++file)
    if (seen_[file] == 0) run_.visit(file, result_.outcome.seen);
}

void IntensityJob::write(const std::vector<std::string>& outputs) {
  BatchOptions options = options_.batch;
  options.joint = true;
  FileBatch batch(paths_, outputs, options);
  seen_.assign(run_.files(), 0);
  const bool one = outputs.size() == 1;
  progress_.begin("Writing " + (one ? outputs.front() : counted(outputs.size(), "file")));
  const std::vector<std::string> results = batch.run(
      [&](std::size_t file, const std::function<void(double)>& fraction) {
        return writeFile(file, outputs[file], fraction);
      },
      [this](double fraction) { progress_.advance(fraction); }, &run_.shares());
  IntensityOutcome& all = result_.outcome;
  all.counts.resize(run_.files());
  for (std::size_t file = 0; file < run_.files(); ++file) {
    ByteReader in(results[file]);
    all.counts[file].get(in);
    IntensityStatistics statistics(run_.strips().size());
    statistics.get(in);
    all.statistics.merge(statistics);
    for (IntensityHistogram& histogram : all.histograms) histogram.add(in);
    std::vector<std::string> remarks;
    in.get(remarks);
    all.remarks.insert(all.remarks.end(), remarks.begin(), remarks.end());
  }
  doTogether(options.processes, [this] { showOthers(); });
  progress_.end(grouped(result_.counts().points) + " points");
  for (const std::string& text : all.remarks) progress_.remark(text);
  if (batch.keptCount() > 0)
    progress_.remark(counted(batch.keptCount(), "file") + " complete from an earlier run");
}

std::string IntensityJob::whyUnreliable(const LostIntensities& lost) const {
  if (lost.share > LostIntensities::kAll) return lost.text;
  if (result_.reference && !(result_.reference->constant > 0.0))
    return "no reference target was seen: intensities are relative";
  if (!estimates() || result_.overlaps->reliable()) return "";
  return "not all terms that were to be estimated are determined by the overlaps (" +
         notEstimable(*result_.overlaps, run_.strips()) + "): the given values were kept";
}

void IntensityJob::judge() {
  const IntensityCounts all = result_.counts();
  result_.excluded = run_.excludedPoints(all);
  for (const std::string& text : describe(result_.excluded)) warn(text);
  const LostIntensities lost = lostIntensities(all);
  if (lost.share > LostIntensities::kMany) {
    warn(lost.text);
  }
  result_.unreliable = whyUnreliable(lost);
}

void requireOutputs(const std::vector<std::string>& paths,
                    const std::vector<std::string>& outputs) {
  requirePointFiles(paths.size());
  if (paths.size() != outputs.size())
    throw UsageError("intensity: there must be one output for each input");
}

}  // namespace

LostIntensities lostIntensities(const IntensityCounts& counts) {
  const struct {
    std::uint64_t count;
    const char* what;
  } kinds[] = {
      {counts.clipped,
       "beyond 65535 after correction and written as 65535; use a smaller scale, "
       "or check that trajectory and points belong together"},
      {counts.saturated, "saturated as received: corrected values are lower bounds"},
      {counts.rounded_to_zero, "under 0.5 after correction and written as 0; use a larger scale"}};
  LostIntensities lost;
  const std::uint64_t with_intensity = counts.points - counts.zeros;
  if (with_intensity == 0) return lost;
  for (const auto& kind : kinds) {
    const double share = static_cast<double>(kind.count) / static_cast<double>(with_intensity);
    if (share <= lost.share) continue;
    lost.share = share;
    lost.text =
        grouped(kind.count) + " of " + grouped(with_intensity) + " intensities are " + kind.what;
  }
  return lost;
}

IntensityCounts IntensityResult::counts() const {
  IntensityCounts all;
  for (const IntensityCounts& file : outcome.counts) all.merge(file);
  return all;
}

IntensityResult correctIntensity(const std::vector<std::string>& paths,
                                 const std::vector<std::string>& outputs,
                                 std::shared_ptr<const Trajectory> flight,
                                 const IntensityOptions& options,
                                 const ProgressCallback& callback) {
  requireOutputs(paths, outputs);
  const UnchangedInputs unchanged;
  ProgressReport progress(sharedProgress(options.batch.processes, callback));
  progress.begin("Reading " + counted(paths.size(), "file"));
  IntensitySettings settings = options.settings;
  settings.processes = options.batch.processes;
  auto run = std::make_unique<IntensityRun>(paths, std::move(flight), settings);
  progress.end(counted(run->strips().size(), "strip"));
  for (const std::string& remark : run->remarks()) progress.remark(remark);
  IntensityResult result;
  result.outcome = IntensityOutcome(run->strips().size());
  if (options.observe) result.outcome.seen = options.observe(*run);
  result.warnings = run->warnings();
  for (const Warning& warning : result.warnings) progress.remark("warning: " + warning.text);
  IntensityJob job(paths, options, *run, result, progress);
  if (options.stored) job.useStored(*options.stored);
  job.compareStrips();
  job.useTargets();
  job.write(outputs);
  job.judge();
  result.outcome.seen = nullptr;
  result.strips = run->strips();
  for (std::size_t i = 0; i < result.strips.size(); ++i)
    result.gains.push_back(run->gain(static_cast<int>(i)));
  result.run = std::move(run);
  return result;
}

}  // namespace pcl_als
