// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/file_version.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/filters/integer_bias_correction.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/survey/coverage_limit.h>
#include <pcl_als/trajectory/system_correction.h>
#include <pcl_als/trajectory/trajectory_errors.h>

#include "correction_record.h"
#include "file_attitude.h"
#include "file_times.h"
#include "file_uncertainty.h"
#include "flight_check.h"
#include "waveform_direction.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using Flight = std::shared_ptr<const Trajectory>;

/// Inputs and results of the correction of one file.
struct Job {
  fs::path input, output;
  const CalibrationResult& calibration;
  Flight flight;
  FileCorrectionOptions options;
  ProgressReport& progress;
  TimeAlignment alignment{};
  RecoveredAttitude fallback_attitude{};
  bool of_another_flight = false;   ///< isOfAnotherFlight()
  bool attitude_recovered = false;  ///< from this file, with success or without
  bool level = false;               ///< the scanner is not linear, and options.force
  std::string corrections{};        ///< record of the output
  FileCorrectionResult result{};

  std::string name() const { return input.string(); }
};

SystemCorrection correctionOf(Job& job) {
  SystemCorrection::Options options;
  options.strip_corrections = job.options.strip_corrections;
  options.invert = job.options.invert;
  options.force = job.options.force;
  options.fallback_attitude = job.fallback_attitude;
  CalibrationResult nominal;
  if (job.level) {
    nominal = job.calibration;
    nominal.attitude = AttitudeSource::nominal;
  }
  SystemCorrection correction(job.level ? nominal : job.calibration, job.flight, options);
  correction.setTimeAlignment(job.alignment);
  correction.setStrip(job.input.stem().string());
  job.result.flight_remark = correction.flightRemark();
  return correction;
}

/// What the points of the file show of the attitude; a scanner that is not linear is refused, with
/// force taken as level.
template <typename Points>
void recoverAttitude(Job& job, const Points& points) {
  AttitudeRecovery::Outcome outcome = detail::recoveredAttitude(points, job.alignment, job.flight);
  job.attitude_recovered = true;
  job.result.attitude_remark = outcome.remark;
  if (outcome.linear) {
    job.fallback_attitude = std::move(outcome.attitude);
    // Where nothing shows, the sensor counts as level.
    if (job.fallback_attitude.empty())
      job.fallback_attitude.addPass({{job.flight->startTime(), {}}, {job.flight->endTime(), {}}});
    return;
  }
  if (!job.options.force) {
    throw InputError(job.name() + ": " + outcome.remark +
                         ": give a trajectory with roll, pitch and heading, and biases that were "
                         "estimated with it",
                     Hint::force_level);
  }
  job.result.warnings.push_back("the sensor is taken as level with its heading along the course");
  job.level = true;
}

/// The strips of the file that have points at times without strip corrections.
std::set<std::string> stripsWithoutErrors(const Job& job) {
  const TrajectoryErrors errors(job.calibration.strip_errors);
  std::set<std::string> strips;
  const auto reader = PointReader::open(job.input);
  PointChunk chunk;
  TrajectoryErrorKnot ignored;
  while (reader->read(chunk)) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const double time = job.alignment(chunk.gps_time[i]);
      if (!std::isfinite(time) || errors.at(time, ignored)) continue;
      const std::uint16_t id = chunk.point_source_id[i];
      strips.insert(id == 0 ? job.input.stem().string() : std::to_string(id));
    }
  }
  return strips;
}

std::string listed(const std::set<std::string>& names) {
  constexpr std::size_t kMaximumListed = 20;
  std::string text;
  std::size_t count = 0;
  for (const std::string& name : names) {
    if (count++ == kMaximumListed) return text + " and further ones";
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

/// A strip without strip corrections ends the job unless it is forced: its points would be
/// corrected in another way than those of the other strips.
void checkStripErrors(Job& job, const CoverageCount& coverage) {
  if (!coverage.lacksStripErrors()) return;
  std::set<std::string> known;
  for (const StripErrors& strip : job.calibration.strip_errors) known.insert(strip.id);
  const std::string text = "the calibration has no strip corrections for " +
                           std::to_string(coverage.without_strip_errors) + " of " +
                           std::to_string(coverage.points) + " points, of strip " +
                           listed(stripsWithoutErrors(job)) + "; it has some for " + listed(known);
  if (!job.options.force) throw InputError(job.name() + ": " + text, Hint::force);
  job.result.warnings.push_back(text);
}

/// A correction that no biases can cause ends the job.
void checkSizes(Job& job, const CoverageCount& coverage) {
  const std::string objection = coverage.sizes.objection();
  if (objection.empty()) return;
  if (!job.options.force) throw InputError(job.name() + ": " + objection, Hint::force);
  job.result.warnings.emplace_back(objection);
}

/// Points that the correction could not serve end the job, unless they are few or may stay as they
/// are.
void checkCoverage(Job& job, const CoverageCount& coverage) {
  checkStripErrors(job, coverage);
  checkSizes(job, coverage);
  const bool stay = job.options.keep_uncovered || fewUncovered(coverage.missed(), coverage.points);
  if (coverage.unsolved == 0 && stay) return;
  throw InputError(job.name() + ": " + coverage.describe(*job.flight),
                   coverage.unsolved == 0 ? Hint::keep_uncovered : Hint::none);
}

/// Adds up what blocks report, from any thread.
class CoverageCounters {
 public:
  CoverageCounters(std::uint64_t expected, Job& job) : expected_(expected), job_(job) {}

  void add(const CoverageCount& part) {
    const std::lock_guard<std::mutex> lock(mutex_);
    coverage_.merge(part);
    lacks_attitude_ = coverage_.without_attitude > 0 && !job_.attitude_recovered;
    if (lacks_attitude_) return;
    job_.progress.advance(static_cast<double>(coverage_.points) / static_cast<double>(expected_));
    // With the counts of all points, but before the output gets its name.
    if (coverage_.points == expected_) checkCoverage(job_, coverage_);
  }
  /// Whether there are times whose attitude the calibration does not hold, and which has not been
  /// recovered from the file as yet.
  bool lacksAttitude() const { return lacks_attitude_; }
  const CoverageCount& coverage() const { return coverage_; }

 private:
  std::mutex mutex_;
  CoverageCount coverage_;
  std::atomic<bool> lacks_attitude_{false};
  std::uint64_t expected_;
  Job& job_;
};

/// Writes the output; false, and no output, where the attitude of the file has to be recovered
/// first.
bool rewrite(Job& job, const LasFile& file) {
  const SystemCorrection correction = correctionOf(job);
  auto layout = IntegerBiasCorrection::Layout::of(file, correction.systems());
  std::unique_ptr<detail::FileUncertainty> uncertainty;
  if (job.options.uncertainty)
    uncertainty = std::make_unique<detail::FileUncertainty>(file, correction, layout,
                                                            job.calibration, job.options);
  CoverageCounters counters(file.header().point_count, job);
  LasExtension extension = uncertainty ? uncertainty->extension() : LasExtension();
  extension.corrections = job.corrections;
  extension.abandon = [&counters] { return counters.lacksAttitude(); };
  layout.record_length += 4 * extension.fields.size();
  const IntegerBiasCorrection engine(job.name(), correction, layout);
  const LasEdit edit = [&](const LasRecordBlock& block) {
    std::vector<Eigen::Vector3f> normals;
    if (uncertainty) normals = uncertainty->normalsOf(block);
    const CoverageCount coverage = detail::applyWithWaveforms(engine, file, block);
    if (uncertainty) uncertainty->store(block, normals);
    counters.add(coverage);
  };
  LasRewriteResult written = extendLas(file, job.output, extension, edit, job.options.threads);
  if (!written.complete) return false;
  job.result.points = written.points;
  job.result.copy_remarks = std::move(written.remarks);
  job.result.coverage = counters.coverage();
  if (uncertainty) uncertainty->finish(job.result);
  return true;
}

/// The correction of the job as files record it.
AppliedCorrection correctionMade(const Job& job) {
  AppliedCorrection correction;
  correction.kind =
      job.options.invert ? CorrectionKind::biases_applied : CorrectionKind::biases_removed;
  correction.id = job.options.calibration_id.empty() ? calibrationId(job.calibration)
                                                     : job.options.calibration_id;
  correction.strip_corrections = job.options.strip_corrections;
  correction.values = describeBiases(job.calibration);
  return correction;
}

/// Whether the job can change any point.
bool changesPoints(const Job& job) {
  const CalibrationResult& calibration = job.calibration;
  if (detail::isFixedSurface(job.input, calibration)) return false;
  const auto differs = [](const SystemEstimate& system) { return !system.values().isZero(0.0); };
  return job.options.strip_corrections || !calibration.biases().isZero(0.0) ||
         !calibration.sources.isZero(0.0) ||
         std::any_of(calibration.systems.begin(), calibration.systems.end(), differs);
}

/// Determines the record of corrections of the output; refuses a correction that was made before.
void recordCorrection(Job& job, const std::string& before) {
  job.corrections = before;
  if (!changesPoints(job)) return;
  const std::string record = detail::recordWith(before, correctionMade(job), job.name(),
                                                job.options.force, job.result.warnings);
  if (job.options.record) job.corrections = record;
}

bool lacksAttitude(const Job& job) {
  return job.calibration.attitude == AttitudeSource::points &&
         (job.of_another_flight || job.calibration.recovered_attitude.empty());
}

void addWarnings(Job& job, const Warnings& warnings) {
  job.result.warnings.insert(job.result.warnings.end(), warnings.begin(), warnings.end());
}

/// Of another flight the calibration has no strip corrections, which ends the job unless it is
/// forced.
void findFlight(Job& job) {
  job.of_another_flight =
      isOfAnotherFlight(job.calibration, job.flight->startTime(), job.flight->endTime());
  if (!job.of_another_flight || !job.options.strip_corrections) return;
  const char* const text = "the calibration has no strip corrections for this flight";
  if (!job.options.force) throw InputError(job.name() + ": " + text, Hint::force);
  job.result.warnings.emplace_back(text);
  job.options.strip_corrections = false;
}

void correctLas(Job& job) {
  const LasFile file(job.input);
  if (file.layout().gps_time < 0) {
    throw InputError(job.name() + ": point format " + std::to_string(file.layout().format) +
                     " has no GPS time; the correction needs it");
  }
  recordCorrection(job, file.info().corrections);
  job.alignment = detail::alignmentOf(file, *job.flight, job.options.gps_week);
  job.result.time_remark = job.alignment.remark;
  if (job.options.check_trajectory) {
    addWarnings(job, detail::checkFlight(file, job.alignment, job.flight, job.options.force));
  }
  if (lacksAttitude(job)) recoverAttitude(job, file);
  if (rewrite(job, file)) return;
  recoverAttitude(job, file);
  rewrite(job, file);
}

CoverageCount correctCloud(Job& job, const Strip<PointLidar>& strip,
                           const std::vector<std::uint8_t>& channels,
                           pcl::PointCloud<PointLidar>& corrected) {
  const SystemCorrection correction = correctionOf(job);
  const std::string objection =
      correction.systems().objection(true, !channels.empty() || strip.cloud->empty());
  if (!objection.empty()) throw InputError(job.name() + ": " + objection);
  SystemBiasCorrection<PointLidar> filter;
  filter.setCorrection(correction);
  filter.setChannels(channels);
  filter.setLocalFrame(strip.frame);
  filter.setKeepUncovered(true);     // checked by the caller, with the file's name
  filter.setCheckTrajectory(false);  // the same
  filter.setNumberOfThreads(job.options.threads);
  filter.setInputCloud(strip.cloud);
  filter.filter(corrected);
  return filter.getCoverage();
}

/// A file without what a correction depends on is refused, because the defaults of a cloud would be
/// taken for it.
void requireFields(const Job& job, const PcdFindings& findings) {
  const auto require = [&job](ErrorSource source, bool present, const char* field) {
    if (present || job.calibration.sources[indexOf(source)] == 0.0) return;
    throw InputError(job.name() + ": the calibration corrects " +
                     std::string(infoOf(source).title) + ", for which the points need the field " +
                     field);
  };
  require(ErrorSource::intensity_ranging, findings.has_intensity, "intensity");
  require(ErrorSource::mirror_torsion, findings.has_flags, "flags, with the scan direction");
}

void correctPcd(Job& job) {
  std::error_code absent;
  if (fs::equivalent(job.input, job.output, absent)) {
    throw UsageError(job.output.string() + ": input and output are the same file");
  }
  PcdFindings findings;
  Strip<PointLidar> strip =
      loadPcd(job.input, SystemLookup(job.calibration).channelField(), findings);
  if (!findings.time_fault.empty()) throw InputError(job.name() + ": " + findings.time_fault);
  requireFields(job, findings);
  job.result.copy_remarks = findings.remarks;
  recordCorrection(job, strip.corrections);
  strip.corrections = job.corrections;
  job.result.points = strip.cloud->size();
  job.alignment = detail::alignmentOf(job.name(), strip, *job.flight, job.options.gps_week);
  job.result.time_remark = job.alignment.remark;
  if (job.options.check_trajectory) {
    addWarnings(
        job, detail::checkFlight(job.name(), strip, job.alignment, job.flight, job.options.force));
  }
  if (lacksAttitude(job)) recoverAttitude(job, strip);
  pcl::PointCloud<PointLidar>::Ptr corrected(new pcl::PointCloud<PointLidar>);
  job.result.coverage = correctCloud(job, strip, findings.channels, *corrected);
  if (job.result.coverage.without_attitude > 0 && !job.attitude_recovered) {
    recoverAttitude(job, strip);
    job.result.coverage = correctCloud(job, strip, findings.channels, *corrected);
  }
  checkCoverage(job, job.result.coverage);
  strip.cloud = corrected;
  savePcd(job.output, strip, findings.channel_column);
}

void addRemarks(Job& job) {
  FileCorrectionResult& result = job.result;
  std::vector<std::string>& remarks = result.remarks;
  remarks = {result.deviations.describe(), result.time_remark, result.flight_remark};
  for (const Warning& warning : result.warnings) remarks.push_back("warning: " + warning.text);
  if (job.calibration.attitude == AttitudeSource::points && result.attitude_remark.empty())
    remarks.emplace_back("pitch and crab: recovered from the points by the calibration");
  if (!result.attitude_remark.empty()) {
    remarks.push_back(result.attitude_remark);
    remarks.emplace_back(
        "the calibration holds no attitude for these times, it is recovered from this file: other "
        "tiles of its strips may get a slightly different one");
  }
  if (result.coverage.missed() > 0)
    remarks.push_back("left as they are: " + result.coverage.describe(*job.flight));
  remarks.insert(remarks.end(), result.copy_remarks.begin(), result.copy_remarks.end());
  remarks.erase(std::remove(remarks.begin(), remarks.end(), std::string()), remarks.end());
}

}  // namespace

FileCorrectionResult correctPointFile(const fs::path& input, const fs::path& output,
                                      const CalibrationResult& calibration, Flight flight,
                                      const FileCorrectionOptions& options,
                                      const ProgressCallback& progress) {
  requireCopyable(input);
  const bool pcd_in = lowerExtension(input) == ".pcd", pcd_out = lowerExtension(output) == ".pcd";
  if (pcd_in != pcd_out)
    throw UsageError(output.string() + ": input and output must be of one kind, .las/.laz or .pcd");
  if (!flight) throw UsageError("correction of " + input.string() + ": no trajectory is given");
  if (options.uncertainty && pcd_in)
    throw UsageError(input.string() + ": standard deviations are written to .las and .laz only");
  if (options.uncertainty && options.invert)
    throw UsageError(input.string() + ": inverted corrections have no standard deviations");
  const UnchangedInputs unchanged;
  ProgressReport report(progress);
  report.begin("Writing " + output.string());
  Job job{input, output, calibration, std::move(flight), options, report};
  findFlight(job);
  if (pcd_in) {
    correctPcd(job);
  } else {
    correctLas(job);
  }
  report.end(grouped(job.result.points) + " points");
  addRemarks(job);
  return std::move(job.result);
}

}  // namespace pcl_als
