// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Trajectories of several files as one.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <set>

#include <pcl_als/common/attitude_form.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/time_scale.h>

#include "trajectory_records.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

/// Two files of one flight: what rounding and another rate of samples leave between them.
constexpr double kSamePlace = 0.02;         // metres
constexpr double kSameAngle = 1e-4;         // radians
constexpr double kManoeuvre = 0.6;          // m/s^2 eighths: 5 m/s^2 bend a chord by a t^2 / 8
constexpr double kAngularManoeuvre = 0.12;  // rad/s^2 over 8: 1 rad/s^2

/// A file with its samples in order of time.
struct Part {
  fs::path path;
  TrajectoryFile file;
  double first = 0.0, last = 0.0, step = 0.0;  ///< seconds
};

double medianStep(const std::vector<TrajectorySample>& samples) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i)
    steps.push_back(samples[i].time - samples[i - 1].time);
  return steps.empty() ? 0.0 : medianInPlace(steps);
}

std::vector<std::size_t> orderInTime(const std::vector<TrajectorySample>& samples) {
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return samples[a].time < samples[b].time; });
  return order;
}

/// Values of samples in another order; without values nothing.
template <typename Value>
void arrange(std::vector<Value>& values, const std::vector<std::size_t>& order) {
  if (values.empty()) return;
  std::vector<Value> arranged;
  arranged.reserve(order.size());
  for (const std::size_t i : order) arranged.push_back(values[i]);
  values = std::move(arranged);
}

Part sortedPart(const fs::path& path, TrajectoryFile file) {
  Part part{path, std::move(file)};
  std::vector<TrajectorySample>& samples = part.file.samples;
  const std::vector<std::size_t> order = orderInTime(samples);
  arrange(samples, order);
  arrange(part.file.accuracy, order);
  arrange(part.file.turns, order);
  part.first = samples.front().time, part.last = samples.back().time;
  part.step = medianStep(samples);
  return part;
}

bool inWeek(const Part& part) {
  return part.first >= 0.0 && part.last <= 2.0 * kSecondsPerWeek;
}

/// Brings files with absolute times to the week of the others.
void commonTimes(std::vector<Part>& parts) {
  const auto week = std::find_if(parts.begin(), parts.end(), inWeek);
  const auto absolute = std::find_if_not(parts.begin(), parts.end(), inWeek);
  if (week == parts.end() || absolute == parts.end()) return;
  const auto toGps = [](const Part& part) {
    return gpsSecondsOffset(probableTimeScales({part.first, part.last}).front(), part.first);
  };
  const double number = std::floor((absolute->first + toGps(*absolute)) / kSecondsPerWeek);
  for (Part& part : parts) {
    if (inWeek(part)) continue;
    const double shift = toGps(part) - number * kSecondsPerWeek;
    part.first += shift, part.last += shift;
    if (!inWeek(part)) {
      throw InputError(part.path.string() + ": its times are of another GPS week than those of " +
                       absolute->path.string() + ", and " + week->path.string() +
                       " does not state its week; give the files of one week");
    }
    for (TrajectorySample& sample : part.file.samples) sample.time += shift;
    for (TrajectoryAccuracy& accuracy : part.file.accuracy) accuracy.time += shift;
    part.file.remarks.push_back(part.path.filename().string() + ": times are those of GPS week " +
                                std::to_string(std::lround(number)) +
                                ", brought to seconds of the week");
  }
}

double turnBetween(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * kPi));
}

/// What refuses a sample beside the path between two others; empty where it lies on it.
std::string contradiction(const TrajectorySample& a, const TrajectorySample& b,
                          const TrajectorySample& sample) {
  const double step = b.time - a.time, share = step > 0.0 ? (sample.time - a.time) / step : 0.0;
  const Eigen::Vector3d place = a.position + share * (b.position - a.position);
  const double apart = (place - sample.position).norm();
  char text[100];
  if (!(apart <= kSamePlace + kManoeuvre * step * step)) {
    std::snprintf(text, sizeof text, "lie %.3f m apart at %.3f s", apart, sample.time);
    return text;
  }
  if (!a.hasAttitude() || !b.hasAttitude() || !sample.hasAttitude()) return {};
  const auto between = [share](double from, double to) {
    return from + share * std::remainder(to - from, 2.0 * kPi);
  };
  const double turned = std::max({turnBetween(between(a.roll, b.roll), sample.roll),
                                  turnBetween(between(a.pitch, b.pitch), sample.pitch),
                                  turnBetween(between(a.heading, b.heading), sample.heading)});
  if (turned <= kSameAngle + kAngularManoeuvre * step * step) return {};
  std::snprintf(text, sizeof text, "differ by %.4f degrees in attitude at %.3f s",
                turned / kRadiansPerDegree, sample.time);
  return text;
}

/// Adds the samples of a file at times that the files before it do not cover.
class Joined {
 public:
  void add(const Part& part) {
    const bool stated = !part.file.accuracy.empty();
    const double gap = std::max(1.0, 5.0 * std::max(part.step, step_));
    std::size_t kept = 0;
    const std::size_t before = entries_.size();
    std::size_t after = 0;
    std::vector<Entry> added;
    for (std::size_t i = 0; i < part.file.samples.size(); ++i) {
      const TrajectorySample& sample = part.file.samples[i];
      while (after < before && timeOf(after) < sample.time) ++after;
      if (covered(after, before, sample, gap)) {
        check(after, sample, part);
        ++kept;
        continue;
      }
      added.push_back({sample, stated ? part.file.accuracy[i] : unknownAt(sample.time),
                       part.file.turns.empty() ? 0.0 : part.file.turns[i], sources_.size()});
    }
    if (kept > 0) {
      remarks_.push_back(part.path.filename().string() + ": " + std::to_string(kept) +
                         " samples repeat those of other files and are excluded");
    }
    any_accuracy_ = any_accuracy_ || stated;
    insert(added);
    sources_.push_back(part.path);
    step_ = std::max(step_, part.step);
  }

  TrajectoryFile result(const std::vector<Part>& parts) {
    TrajectoryFile file = parts.front().file;
    // What is open in some of the files only, the course of all cannot show.
    for (const Part& part : parts)
      if (part.file.attitude != file.attitude) file.attitude = AttitudeForm::heading;
    file.samples.clear(), file.accuracy.clear(), file.turns.clear();
    for (const Entry& entry : entries_) {
      file.samples.push_back(entry.sample);
      if (any_accuracy_) file.accuracy.push_back(entry.accuracy);
      if (file.attitude != AttitudeForm::heading) file.turns.push_back(entry.turn);
    }
    file.places = {};
    file.remarks.clear();
    for (const Part& part : parts) {
      if (part.file.format != parts.front().file.format) file.format = "several formats";
      if (file.axes.empty()) file.axes = part.file.axes;
      for (const std::string& text : part.file.remarks) {
        if (std::find(file.remarks.begin(), file.remarks.end(), text) == file.remarks.end())
          file.remarks.push_back(text);
      }
    }
    file.remarks.insert(file.remarks.end(), remarks_.begin(), remarks_.end());
    return file;
  }

 private:
  /// A sample with what belongs to it.
  struct Entry {
    TrajectorySample sample;
    TrajectoryAccuracy accuracy;
    double turn = 0.0;
    std::size_t source = 0;
  };

  static TrajectoryAccuracy unknownAt(double time) {
    TrajectoryAccuracy accuracy;
    accuracy.time = time;
    return accuracy;
  }
  /// Whether a sample is at or between samples that are no gap apart.
  bool covered(std::size_t after, std::size_t count, const TrajectorySample& sample,
               double gap) const {
    if (after == count) return false;
    if (timeOf(after) == sample.time) return true;
    return after > 0 && timeOf(after) - timeOf(after - 1) <= gap;
  }
  void check(std::size_t after, const TrajectorySample& sample, const Part& part) const {
    const TrajectorySample& b = entries_[after].sample;
    const TrajectorySample& a = b.time == sample.time ? b : entries_[after - 1].sample;
    const std::string why = contradiction(a, b, sample);
    if (why.empty()) return;
    throw InputError(part.path.string() + " and " + sources_[entries_[after].source].string() +
                     " " + why +
                     ": they are not one trajectory; leave one of them out, or cut them where they "
                     "overlap");
  }
  double timeOf(std::size_t entry) const { return entries_[entry].sample.time; }
  /// Of equal times the added ones come first.
  void insert(std::vector<Entry>& added) {
    std::vector<Entry> merged;
    merged.reserve(entries_.size() + added.size());
    std::merge(added.begin(), added.end(), entries_.begin(), entries_.end(),
               std::back_inserter(merged),
               [](const Entry& a, const Entry& b) { return a.sample.time < b.sample.time; });
    entries_ = std::move(merged);
  }

  std::vector<Entry> entries_;  ///< in order of time
  std::vector<fs::path> sources_;
  std::vector<std::string> remarks_;
  double step_ = 0.0;
  bool any_accuracy_ = false;
};

std::string timeKindOf(const TimeRange& times) {
  const TimeScale scale = probableTimeScales(times).front();
  const std::string name = timeScaleName(scale);
  if (scale == TimeScale::week) return name;
  return name + " (" + dateText(times.first + gpsSecondsOffset(scale, times.first)) + ")";
}

}  // namespace

bool isTrajectoryFile(const fs::path& path) {
  static const std::set<std::string> kExtensions = {".csv", ".txt", ".sbet", ".out", ".pos",
                                                    ".asc", ".trj", ".pof",  ".sol"};
  return kExtensions.count(lowerExtension(path)) != 0 && !detail::isNamedAsAccuracy(path);
}

std::vector<fs::path> trajectoryPaths(const std::vector<fs::path>& paths) {
  if (paths.empty()) throw UsageError("no trajectory files are given");
  std::vector<fs::path> files;
  for (const fs::path& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    std::vector<fs::path> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
      if (isTrajectoryFile(entry.path())) inside.push_back(entry.path());
    }
    if (inside.empty()) {
      throw InputError(path.string() +
                       ": holds no trajectory (.csv, .txt, .pos, .asc, .sbet, "
                       ".out, .trj, .pof, .sol)");
    }
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      std::error_code error;
      if (files[i] == files[j] || fs::equivalent(files[i], files[j], error))
        throw UsageError("trajectory " + files[i].string() + " is given twice");
    }
  }
  return files;
}

TrajectoryFile readTrajectoryFiles(const std::vector<fs::path>& paths,
                                   const TrajectoryReading& reading) {
  const std::vector<fs::path> files = trajectoryPaths(paths);
  std::vector<TrajectoryFile> read;
  for (const fs::path& path : files) read.push_back(readTrajectoryFile(path, reading));
  return joinTrajectoryFiles(std::move(read), files);
}

TrajectoryFile joinTrajectoryFiles(std::vector<TrajectoryFile> files,
                                   const std::vector<fs::path>& paths) {
  if (files.size() == 1) return std::move(files.front());
  std::vector<Part> parts;
  for (std::size_t i = 0; i < files.size(); ++i)
    parts.push_back(sortedPart(paths[i], std::move(files[i])));
  commonTimes(parts);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& a, const Part& b) { return a.first < b.first; });
  Joined joined;
  for (const Part& part : parts) joined.add(part);
  return joined.result(parts);
}

TrajectoryFacts inspectTrajectory(const fs::path& path, const TrajectoryReading& reading) {
  const detail::TrajectoryRecords records = detail::readTrajectoryRecords(path, reading);
  TrajectoryFacts facts;
  facts.format = records.format;
  facts.frame = detail::frameText(records, reading);
  facts.columns = records.columns;
  facts.samples = records.samples.size();
  facts.attitude = std::all_of(records.samples.begin(), records.samples.end(),
                               [](const TrajectorySample& s) { return s.hasAttitude(); });
  if (reading.axes == AttitudeAxes::by_course) facts.attitude_form = records.attitude;
  facts.accuracy = records.accuracy;
  std::vector<TrajectorySample>& samples = facts.local;
  facts.places.lines = records.places.lines;
  for (const std::size_t i : orderInTime(records.samples)) {
    samples.push_back(records.samples[i]);
    if (reading.axes == AttitudeAxes::enu)
      takeAsEastNorthUp(samples.back(), AttitudeForm::heading, 0.0);
    facts.places.numbers.push_back(records.places.numbers[i]);
  }
  for (const TrajectorySample& sample : samples) facts.times.add(sample.time);
  facts.median_step = medianStep(samples);
  facts.time_kind = timeKindOf(facts.times);
  const Eigen::Vector3d first = samples.front().position;
  for (TrajectorySample& sample : samples) {
    const Eigen::Vector3d d = sample.position - first;
    if (records.coordinates == TrajectoryCoordinates::geographic) {
      constexpr double kRadius = 6371000.0;  // metres
      sample.position = {kRadius * d.y() * std::cos(first.x()), kRadius * d.x(), d.z()};
    } else {
      sample.position = records.coordinates == TrajectoryCoordinates::map
                            ? d
                            : Eigen::Vector3d(Eigen::Vector3d::Zero());
    }
  }
  return facts;
}

}  // namespace pcl_als
