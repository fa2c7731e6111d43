// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "point_file_correction.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <mutex>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/integer_bias_correction.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/las_file.h>
#include <pcl_als/io/las_rewriter.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_sample.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/trajectory/attitude_recovery.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

#include "uncovered_points.h"

namespace pcl_als::app {
namespace {

/// Times of points; a time of zero, which stands for "none", only where there is no other.
class TimeSpread {
 public:
  void add(double time) { (time == 0.0 ? zeros_ : range_).add(time); }
  TimeRange range() const { return range_.empty() ? zeros_ : range_; }

 private:
  TimeRange range_, zeros_;
};

TimeRange rangeOf(const Trajectory& trajectory) {
  return {trajectory.startTime(), trajectory.endTime()};
}

/// Times of \a probes runs of \a run points, spread over the file.
TimeRange probedTimes(const LasFile& file, std::uint64_t probes, std::uint64_t run) {
  const std::uint64_t count = file.header().point_count;
  const std::size_t length = file.header().record_length;
  std::vector<std::byte> records(std::min(run, count) * length);
  TimeSpread times;
  for (std::uint64_t probe = 0; probe < probes; ++probe) {
    const std::uint64_t first =
        probe + 1 == probes ? count - std::min(run, count) : count / probes * probe;
    const std::uint64_t size = std::min(run, count - first);
    file.readRecords(first, size, records.data());
    for (std::uint64_t i = 0; i < size; ++i) {
      times.add(loadLas<double>(&records[i * length + file.layout().gps_time]));
    }
  }
  return times.range();
}

/// The whole week of a file shows in few of its points; all are looked at only where few miss.
TimeAlignment alignmentOf(const LasFile& file, const PointFileCorrection& correction) {
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 16;
  const std::string name = file.path().string();
  const TimeRange trajectory = rangeOf(*correction.trajectory);
  const TimeKind kind = file.info().time_kind;
  // Each probe of a compressed file unpacks a chunk of it.
  const std::uint64_t probes = file.header().compressed ? 8 : 1000;
  try {
    const TimeRange few = probedTimes(file, std::min(probes, file.header().point_count), 1);
    return reconcileTimes(name, few, kind, trajectory, correction.gps_week);
  } catch (const InputError&) {
    const std::uint64_t blocks = (file.header().point_count + kBlock - 1) / kBlock;
    const TimeRange all = probedTimes(file, blocks + 1, kBlock);
    return reconcileTimes(name, all, kind, trajectory, correction.gps_week);
  }
}

/// Hands out runs of 32 points in every 512 of an uncompressed file: enough of every scan line to
/// see the attitude by, without decoding all of them.
template <typename Visit>
void visitSome(const LasFile& file, const Visit& visit) {
  constexpr std::uint64_t kEvery = 512, kRun = 32;
  const LasHeader& header = file.header();
  const LasScaling metres = file.toMetres();
  const std::size_t length = header.record_length;
  std::vector<std::byte> records(kRun * length);
  for (std::uint64_t first = 0; first < header.point_count; first += kEvery) {
    const std::uint64_t size = std::min(kRun, header.point_count - first);
    file.readRecords(first, size, records.data());
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::byte* record = &records[i * length];
      Eigen::Vector3d point;
      for (int axis = 0; axis < 3; ++axis) {
        point[axis] =
            loadLas<std::int32_t>(record + 4 * axis) * metres.scale[axis] + metres.offset[axis];
      }
      visit(loadLas<double>(record + file.layout().gps_time), point);
    }
  }
}

/// The same of a compressed one, which has to be unpacked from its start.
template <typename Visit>
void visitSome(PointReader& reader, const Visit& visit) {
  constexpr std::size_t kEvery = 16;
  PointChunk chunk;
  while (reader.read(chunk)) {
    for (std::size_t i = 0; i < chunk.size(); i += kEvery) {
      visit(chunk.gps_time[i], Eigen::Vector3d(chunk.x[i], chunk.y[i], chunk.z[i]));
    }
  }
}

AttitudeRecovery::Outcome recoveredAttitude(const LasFile& file, const TimeAlignment& alignment,
                                            std::shared_ptr<const Trajectory> flight) {
  AttitudeRecovery recovery(std::move(flight));
  const auto add = [&](double time, const Eigen::Vector3d& point) {
    recovery.add(alignment(time), point);
  };
  if (file.header().compressed) {
    visitSome(*PointReader::open(file.path()), add);
  } else {
    visitSome(file, add);
  }
  return recovery.recover();
}

AttitudeRecovery::Outcome recoveredAttitude(const Strip<PointLidar>& strip,
                                            const TimeAlignment& alignment,
                                            std::shared_ptr<const Trajectory> flight) {
  AttitudeRecovery recovery(std::move(flight));
  for (const PointLidar& point : *strip.cloud) {
    recovery.add(alignment(point.gps_time),
                 strip.frame.origin + point.getVector3fMap().cast<double>());
  }
  return recovery.recover();
}

/// The flight with what the points show of its attitude; a scanner that is not linear is refused,
/// with force taken as level.
std::shared_ptr<const Trajectory> usedAttitude(const std::string& name,
                                               const AttitudeRecovery::Outcome& outcome,
                                               const PointFileCorrection& correction,
                                               PointFileCorrectionResult& result) {
  result.attitude_remark = outcome.remark;
  result.passes = outcome.passes;
  if (outcome.linear) return outcome.flight;
  if (!correction.force) {
    throw InputError(name + ": " + outcome.remark +
                     ": give a trajectory with roll, pitch and heading, and biases that were "
                     "estimated with it; -force takes the sensor as level");
  }
  result.warnings.push_back("the sensor is taken as level with its heading along the course");
  return std::make_shared<const Trajectory>(outcome.flight->withNominalAttitude());
}

/// Whether the points can have been measured from the trajectory, by source id.
class FlightCheck {
 public:
  explicit FlightCheck(std::shared_ptr<const Trajectory> flight) : check_(std::move(flight)) {}

  void add(std::uint16_t source, double time, const Eigen::Vector3d& point) {
    const auto [at, fresh] = strips_.try_emplace(source, 0);
    if (fresh) at->second = check_.addStrip(std::to_string(source));
    check_.add(at->second, time, point);
  }
  /// Warnings; a refusal is an InputError that names the file.
  std::vector<std::string> result(const std::string& name, bool force) const {
    try {
      return check_.check(force);
    } catch (const InputError& error) {
      throw InputError(name + ": " + error.what());
    }
  }

 private:
  TrajectoryPlausibility check_;
  std::map<std::uint16_t, int> strips_;
};

std::vector<std::string> checkFlight(const LasFile& file, const TimeAlignment& alignment,
                                     const PointFileCorrection& correction) {
  if (!correction.check_trajectory) return {};
  FlightCheck check(correction.trajectory);
  // The attitude shows in more points than the positions.
  SampleSize size;
  if (correction.trajectory->hasAttitude()) size.runs = 4096;
  samplePoints(file, size, [&](const PointChunk& chunk) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      check.add(chunk.point_source_id[i], alignment(chunk.gps_time[i]),
                {chunk.x[i], chunk.y[i], chunk.z[i]});
    }
  });
  return check.result(file.path().string(), correction.force);
}

std::vector<std::string> checkFlight(const std::string& name, const Strip<PointLidar>& strip,
                                     const TimeAlignment& alignment,
                                     const PointFileCorrection& correction) {
  if (!correction.check_trajectory) return {};
  constexpr std::size_t kSample = 4096;
  FlightCheck check(correction.trajectory);
  const std::size_t every = std::max<std::size_t>(1, strip.cloud->size() / kSample);
  for (std::size_t i = 0; i < strip.cloud->size(); i += every) {
    const PointLidar& point = (*strip.cloud)[i];
    check.add(point.point_source_id, alignment(point.gps_time),
              strip.frame.origin + point.getVector3fMap().cast<double>());
  }
  return check.result(name, correction.force);
}

/// Points that the correction could not serve end the run, unless they are few or may stay as they
/// are.
void checkCoverage(const std::string& name, const CoverageCount& coverage,
                   const PointFileCorrection& correction) {
  const bool stay = correction.keep_uncovered || fewUncovered(coverage.missed(), coverage.points);
  if (coverage.unsolved == 0 && stay) return;
  const char* way_out = coverage.unsolved == 0 ? "; -keep_uncovered leaves them as they are" : "";
  throw InputError(name + ": " + coverage.describe(*correction.trajectory) + way_out);
}

/// Adds up what blocks report, from any thread.
class Tally {
 public:
  Tally(std::uint64_t expected, const std::function<void(double)>& progress)
      : expected_(expected), progress_(progress) {}

  /// Returns true for the part that completes the file.
  bool add(const CoverageCount& part) {
    const std::lock_guard<std::mutex> lock(mutex_);
    coverage_.merge(part);
    progress_(static_cast<double>(coverage_.points) / static_cast<double>(expected_));
    return coverage_.points == expected_;
  }
  const CoverageCount& coverage() const { return coverage_; }

 private:
  std::mutex mutex_;
  CoverageCount coverage_;
  std::uint64_t expected_;
  const std::function<void(double)>& progress_;
};

IntegerBiasCorrection integerCorrection(const LasFile& file, const PointFileCorrection& correction,
                                        std::shared_ptr<const Trajectory> trajectory,
                                        TimeAlignment alignment) {
  const LasScaling metres = file.toMetres();
  return {file.path().string(),
          std::make_shared<BiasEvaluator>(std::move(trajectory), correction.biases,
                                          correction.trajectory_errors),
          {file.header().record_length, static_cast<std::size_t>(file.layout().gps_time),
           metres.scale, metres.offset},
          std::move(alignment),
          correction.invert};
}

PointFileCorrectionResult correctLas(const std::filesystem::path& input,
                                     const std::filesystem::path& output,
                                     const PointFileCorrection& correction,
                                     const std::function<void(double)>& progress) {
  const LasFile file(input);
  const std::string name = input.string();
  if (file.layout().gps_time < 0) {
    throw InputError(name + ": point format " + std::to_string(file.layout().format) +
                     " has no GPS time; the correction needs it");
  }
  PointFileCorrectionResult result;
  TimeAlignment alignment;
  if (file.header().point_count > 0) alignment = alignmentOf(file, correction);
  result.time_remark = alignment.remark;
  result.warnings = checkFlight(file, alignment, correction);
  std::shared_ptr<const Trajectory> trajectory = correction.trajectory;
  if (correction.recover_attitude) {
    const AttitudeRecovery::Outcome outcome = recoveredAttitude(file, alignment, trajectory);
    trajectory = usedAttitude(name, outcome, correction, result);
  }
  const IntegerBiasCorrection engine =
      integerCorrection(file, correction, std::move(trajectory), std::move(alignment));
  Tally tally(file.header().point_count, progress);
  const LasEdit edit = [&](const LasRecordBlock& block) {
    const bool complete = tally.add(engine.apply(block.records, block.count, block.first));
    // With the counts of all points, but before the output gets its name.
    if (complete) checkCoverage(name, tally.coverage(), correction);
  };
  result.points = rewriteLas(file, output, edit, correction.threads).points;
  result.coverage = tally.coverage();
  return result;
}

PointFileCorrectionResult correctPcd(const std::filesystem::path& input,
                                     const std::filesystem::path& output,
                                     const PointFileCorrection& correction) {
  std::error_code absent;
  if (std::filesystem::equivalent(input, output, absent)) {
    throw UsageError(output.string() + ": input and output are the same file");
  }
  Strip<PointLidar> strip = loadPcd(input);
  PointFileCorrectionResult result;
  result.points = strip.cloud->size();
  SystemBiasCorrection<PointLidar> filter;
  if (!strip.cloud->empty()) {
    TimeSpread times;
    for (const PointLidar& point : *strip.cloud) times.add(point.gps_time);
    filter.setTimeAlignment(reconcileTimes(input.string(), times.range(), TimeKind::none,
                                           rangeOf(*correction.trajectory), correction.gps_week));
  }
  result.time_remark = filter.getTimeAlignment().remark;
  result.warnings = checkFlight(input.string(), strip, filter.getTimeAlignment(), correction);
  filter.setTrajectory(correction.trajectory);
  if (correction.recover_attitude) {
    const AttitudeRecovery::Outcome outcome =
        recoveredAttitude(strip, filter.getTimeAlignment(), correction.trajectory);
    filter.setTrajectory(usedAttitude(input.string(), outcome, correction, result));
  }
  filter.setLocalFrame(strip.frame);
  filter.setBiases(correction.biases);
  filter.setTrajectoryErrors(correction.trajectory_errors);
  filter.setInvert(correction.invert);
  filter.setKeepUncovered(true);  // checked below, with the file's name
  filter.setNumberOfThreads(correction.threads);
  filter.setInputCloud(strip.cloud);
  pcl::PointCloud<PointLidar>::Ptr corrected(new pcl::PointCloud<PointLidar>);
  filter.filter(*corrected);
  result.coverage = filter.getCoverage();
  checkCoverage(input.string(), result.coverage, correction);
  strip.cloud = corrected;
  savePcd(output, strip);
  return result;
}

std::string extensionOf(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

PointFileCorrectionResult correctPointFile(const std::filesystem::path& input,
                                           const std::filesystem::path& output,
                                           const PointFileCorrection& correction,
                                           const std::function<void(double)>& progress) {
  const bool pcd_in = extensionOf(input) == ".pcd", pcd_out = extensionOf(output) == ".pcd";
  if (pcd_in != pcd_out) {
    throw UsageError(output.string() + ": input and output must be of one kind, .las/.laz or .pcd");
  }
  return pcd_in ? correctPcd(input, output, correction)
                : correctLas(input, output, correction, progress);
}

}  // namespace pcl_als::app
