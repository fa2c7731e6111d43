// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <mutex>
#include <sstream>

#include <pcl_als/common/count_text.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/filters/integer_bias_correction.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/survey/coverage_limit.h>
#include <pcl_als/trajectory/system_correction.h>

#include "file_attitude.h"
#include "file_times.h"
#include "file_uncertainty.h"
#include "flight_check.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using Flight = std::shared_ptr<const Trajectory>;

/// Inputs and results of the correction of one file.
struct Job {
  fs::path input, output;
  const CalibrationResult& calibration;
  Flight flight;
  const FileCorrectionOptions& options;
  ProgressReport& progress;
  TimeAlignment alignment;
  RecoveredAttitude further_attitude;
  bool attitude_recovered = false;  ///< from this file, with success or without
  bool level = false;               ///< the scanner is not linear, and options.force
  FileCorrectionResult result;

  std::string name() const { return input.string(); }
};

SystemCorrection correctionOf(const Job& job) {
  SystemCorrection::Options options;
  options.strip_corrections = job.options.strip_corrections;
  options.invert = job.options.invert;
  options.force = job.options.force;
  options.further_attitude = job.further_attitude;
  CalibrationResult nominal;
  if (job.level) {
    nominal = job.calibration;
    nominal.attitude = AttitudeSource::nominal;
  }
  SystemCorrection correction(job.level ? nominal : job.calibration, job.flight, options);
  correction.setTimeAlignment(job.alignment);
  correction.setStrip(job.input.stem().string());
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
    job.further_attitude = std::move(outcome.attitude);
    // Where nothing shows, the sensor counts as level.
    if (job.further_attitude.empty()) {
      job.further_attitude.addPass({{job.flight->startTime(), {}}, {job.flight->endTime(), {}}});
    }
    return;
  }
  if (!job.options.force) {
    throw InputError(job.name() + ": " + outcome.remark +
                         ": give a trajectory with roll, pitch and heading, and biases that were "
                         "estimated with it",
                     Remedy::force_level);
  }
  job.result.warnings.push_back("the sensor is taken as level with its heading along the course");
  job.level = true;
}

/// Points that the correction could not serve end the job, unless they are few or may stay as they
/// are.
void checkCoverage(const Job& job, const CoverageCount& coverage) {
  const bool stay = job.options.keep_uncovered || fewUncovered(coverage.missed(), coverage.points);
  if (coverage.unsolved == 0 && stay) return;
  throw InputError(job.name() + ": " + coverage.describe(*job.flight),
                   coverage.unsolved == 0 ? Remedy::keep_uncovered : Remedy::none);
}

/// Ends a first attempt at which times turn up whose attitude the calibration does not hold.
struct AttitudeIsMissing {};

/// Adds up what blocks report, from any thread.
class Tally {
 public:
  Tally(std::uint64_t expected, Job& job) : expected_(expected), job_(job) {}

  void add(const CoverageCount& part) {
    const std::lock_guard<std::mutex> lock(mutex_);
    coverage_.merge(part);
    if (coverage_.without_attitude > 0 && !job_.attitude_recovered) throw AttitudeIsMissing();
    job_.progress.advance(static_cast<double>(coverage_.points) / static_cast<double>(expected_));
    // With the counts of all points, but before the output gets its name.
    if (coverage_.points == expected_) checkCoverage(job_, coverage_);
  }
  const CoverageCount& coverage() const { return coverage_; }

 private:
  std::mutex mutex_;
  CoverageCount coverage_;
  std::uint64_t expected_;
  Job& job_;
};

/// Sets where a record has the channel of the scanner, which divided the strips of the calibration.
void setChannel(const Job& job, const LasFile& file, IntegerBiasCorrection::Layout& layout) {
  constexpr std::size_t kFlags = 15;
  const std::string& field = job.calibration.channel_field;
  if (field.empty() || field == "scanner_channel") {
    layout.channel_position = kFlags;
    layout.channel_shift = 4;
    layout.channel_mask = file.layout().format < 6 ? 0U : 3U;
    return;
  }
  layout.channel_mask = 0xFF;
  layout.channel_position = file.layout().user_data;
  if (field == "user_data") return;
  for (const LasExtraField& extra : file.extraFields()) {
    if (extra.name != field) continue;
    if (lasExtraSize(extra) != 1)
      throw InputError(job.name() + ": field '" + field +
                       "' with the channel has more than a byte");
    layout.channel_position = extra.position;
    return;
  }
  throw InputError(job.name() + ": has no field '" + field +
                   "' with the channel of the scanner, by which the calibration divides strips");
}

IntegerBiasCorrection::Layout layoutOf(const Job& job, const LasFile& file) {
  // Bytes of a record, which all formats up to 5, and all later ones, have in common.
  constexpr std::size_t kIntensity = 12, kReturns = 14, kFlags = 15, kSource = 18,
                        kLaterSource = 20;
  const LasScaling metres = file.toMetres();
  const bool early = file.layout().format < 6;
  IntegerBiasCorrection::Layout layout;
  layout.record_length = file.header().record_length;
  layout.time_position = static_cast<std::size_t>(file.layout().gps_time);
  layout.intensity_position = kIntensity;
  layout.scan_direction_position = early ? kReturns : kFlags;
  layout.scale = metres.scale;
  layout.offset = metres.offset;
  layout.source_position = early ? kSource : kLaterSource;
  if (!job.calibration.systems.empty() || !job.calibration.channel_field.empty())
    setChannel(job, file, layout);
  return layout;
}

void rewrite(Job& job, const LasFile& file) {
  const SystemCorrection correction = correctionOf(job);
  IntegerBiasCorrection::Layout layout = layoutOf(job, file);
  std::unique_ptr<detail::FileUncertainty> uncertainty;
  if (job.options.uncertainty)
    uncertainty = std::make_unique<detail::FileUncertainty>(file, correction, layout,
                                                            job.calibration, job.options);
  const LasExtension extension = uncertainty ? uncertainty->extension() : LasExtension();
  layout.record_length += 4 * extension.fields.size();
  const IntegerBiasCorrection engine(job.name(), correction, layout);
  Tally tally(file.header().point_count, job);
  const LasEdit edit = [&](const LasRecordBlock& block) {
    std::vector<Eigen::Vector3f> normals;
    if (uncertainty) normals = uncertainty->normalsOf(block);
    const CoverageCount coverage = engine.apply(block.records, block.count, block.first);
    if (uncertainty) uncertainty->store(block, normals);
    tally.add(coverage);
  };
  job.result.points =
      (uncertainty ? extendLas(file, job.output, extension, edit, job.options.threads)
                   : rewriteLas(file, job.output, edit, job.options.threads))
          .points;
  job.result.coverage = tally.coverage();
  if (uncertainty) uncertainty->finish(job.result);
}

bool lacksAttitude(const Job& job) {
  return job.calibration.attitude == AttitudeSource::points &&
         job.calibration.recovered_attitude.empty();
}

void correctLas(Job& job) {
  const LasFile file(job.input);
  if (file.layout().gps_time < 0) {
    throw InputError(job.name() + ": point format " + std::to_string(file.layout().format) +
                     " has no GPS time; the correction needs it");
  }
  job.alignment = detail::alignmentOf(file, *job.flight, job.options.gps_week);
  job.result.time_remark = job.alignment.remark;
  if (job.options.check_trajectory) {
    job.result.warnings = detail::checkFlight(file, job.alignment, job.flight, job.options.force);
  }
  if (lacksAttitude(job)) recoverAttitude(job, file);
  try {
    rewrite(job, file);
  } catch (const AttitudeIsMissing&) {
    recoverAttitude(job, file);
    rewrite(job, file);
  }
}

CoverageCount correctCloud(const Job& job, Strip<PointLidar>& strip,
                           pcl::PointCloud<PointLidar>& corrected) {
  SystemBiasCorrection<PointLidar> filter;
  filter.setCorrection(correctionOf(job));
  filter.setLocalFrame(strip.frame);
  filter.setKeepUncovered(true);  // checked by the caller, with the file's name
  filter.setNumberOfThreads(job.options.threads);
  filter.setInputCloud(strip.cloud);
  filter.filter(corrected);
  return filter.getCoverage();
}

void correctPcd(Job& job) {
  std::error_code absent;
  if (fs::equivalent(job.input, job.output, absent)) {
    throw UsageError(job.output.string() + ": input and output are the same file");
  }
  Strip<PointLidar> strip = loadPcd(job.input);
  job.result.points = strip.cloud->size();
  job.alignment = detail::alignmentOf(job.name(), strip, *job.flight, job.options.gps_week);
  job.result.time_remark = job.alignment.remark;
  if (job.options.check_trajectory) {
    job.result.warnings =
        detail::checkFlight(job.name(), strip, job.alignment, job.flight, job.options.force);
  }
  if (lacksAttitude(job)) recoverAttitude(job, strip);
  pcl::PointCloud<PointLidar>::Ptr corrected(new pcl::PointCloud<PointLidar>);
  job.result.coverage = correctCloud(job, strip, *corrected);
  if (job.result.coverage.without_attitude > 0 && !job.attitude_recovered) {
    recoverAttitude(job, strip);
    job.result.coverage = correctCloud(job, strip, *corrected);
  }
  checkCoverage(job, job.result.coverage);
  strip.cloud = corrected;
  savePcd(job.output, strip);
}

void addRemarks(Job& job) {
  FileCorrectionResult& result = job.result;
  std::vector<std::string>& remarks = result.remarks;
  remarks = {result.deviations.describe(), result.time_remark};
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
  remarks.erase(std::remove(remarks.begin(), remarks.end(), std::string()), remarks.end());
}

}  // namespace

namespace {

std::string textOf(const SystemVector& biases) {
  std::ostringstream text;
  for (const SystemParameterInfo& info : systemParameters()) {
    const double value = biases[indexOf(info.parameter)] / info.internal_per_unit;
    if (value == 0.0) continue;
    text << (text.tellp() > 0 ? ", " : "") << info.name << ' ' << value;
    if (info.unit != "1") text << ' ' << info.unit;
  }
  return text.tellp() > 0 ? text.str() : "all biases are zero";
}

}  // namespace

std::string describeBiases(const CalibrationResult& calibration) {
  std::string text;
  for (const SystemEstimate& system : calibration.systems)
    text += (text.empty() ? "" : "; ") + system.group.name + ": " +
            textOf(system.values().head<kSystemParameterCount>());
  if (text.empty()) text = textOf(calibration.biases());
  for (const HeldSurface& surface : calibration.held) {
    for (const std::string& strip : surface.strips)
      text +=
          (&strip == &surface.strips.front() ? "; unchanged, because held fixed: strips " : ", ") +
          strip;
  }
  return text;
}

FileCorrectionResult correctPointFile(const fs::path& input, const fs::path& output,
                                      const CalibrationResult& calibration, Flight flight,
                                      const FileCorrectionOptions& options,
                                      const ProgressCallback& progress) {
  const bool pcd_in = lowerExtension(input) == ".pcd", pcd_out = lowerExtension(output) == ".pcd";
  if (pcd_in != pcd_out) {
    throw UsageError(output.string() + ": input and output must be of one kind, .las/.laz or .pcd");
  }
  if (!flight) throw UsageError("correction of " + input.string() + ": no trajectory is given");
  if (options.uncertainty && pcd_in)
    throw UsageError(input.string() + ": standard deviations are written to .las and .laz only");
  if (options.uncertainty && options.invert)
    throw UsageError(input.string() + ": inverted corrections have no standard deviations");
  ProgressReport report(progress);
  report.begin("Writing " + output.string());
  Job job{input, output, calibration, std::move(flight), options, report, {}, {}, false, false, {}};
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
