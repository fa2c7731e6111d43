// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/trajectory_accuracy.h>

#include "riegl_pof.h"
#include "trajectory_records.h"
#include "week_rollover.h"

namespace pcl_als {
namespace {

using AccuracyRecord = std::array<double, 10>;
constexpr double kRadiansPerArcmin = kRadiansPerDegree / 60.0;
constexpr double kMaximumTimeDifference = 1.0;  // seconds: smrmsg files have one record a second

/// Root mean square of the values that are known.
class MeanSquare {
 public:
  void add(double value) {
    if (!std::isfinite(value)) return;
    sum_sq_ += value * value;
    ++count_;
  }
  double root() const {
    return count_ == 0 ? TrajectoryAccuracy::kUnknown
                       : std::sqrt(sum_sq_ / static_cast<double>(count_));
  }

 private:
  double sum_sq_ = 0.0;
  std::size_t count_ = 0;
};

const char* accuracyFault(const AccuracyRecord& record) {
  constexpr double kLargest = 1000.0, kWidest = 180.0 * 60.0;  // metres, arc-minutes
  for (std::size_t i = 0; i < record.size(); ++i) {
    const double largest = i == 0 ? 1e12 : i < 7 ? kLargest : kWidest;
    if (!(std::abs(record[i]) <= largest)) return "a value is not a standard deviation";
    if (i > 0 && record[i] < 0.0) return "a standard deviation is negative";
  }
  return nullptr;
}

}  // namespace

void writeAccuracies(const std::filesystem::path& path,
                     const std::vector<TrajectoryAccuracy>& accuracy) {
  const auto known = [](double value) { return std::isfinite(value) ? value : 0.0; };
  std::string bytes;
  for (const TrajectoryAccuracy& a : accuracy) {
    const Eigen::Vector3d angles = a.angles / kRadiansPerArcmin;
    const AccuracyRecord record{
        a.time, known(a.position.y()), known(a.position.x()), known(a.position.z()), 0.0, 0.0,
        0.0,    known(angles.x()),     known(angles.y()),     known(angles.z())};
    bytes.append(reinterpret_cast<const char*>(record.data()), sizeof record);
  }
  writeFile(path, bytes);
}

TrajectoryAccuracy accuracyAt(const std::vector<TrajectoryAccuracy>& accuracies, double time) {
  TrajectoryAccuracy result;
  result.time = time;
  if (accuracies.empty()) return result;
  const auto after =
      std::lower_bound(accuracies.begin(), accuracies.end(), time,
                       [](const TrajectoryAccuracy& a, double value) { return a.time < value; });
  const TrajectoryAccuracy& b = after == accuracies.end() ? accuracies.back() : *after;
  const TrajectoryAccuracy& a = after == accuracies.begin() ? b : *(after - 1);
  const double from_a = std::abs(time - a.time), to_b = std::abs(b.time - time);
  if (std::min(from_a, to_b) > kMaximumTimeDifference) return result;
  const double step = b.time - a.time;
  double share = step > 0.0 ? from_a / step : 0.0;
  if (step > 2.0 * kMaximumTimeDifference)
    share = from_a < to_b ? 0.0 : 1.0;  // a gap of the records
  result.position = a.position + share * (b.position - a.position);
  result.angles = a.angles + share * (b.angles - a.angles);
  return result;
}

AccuracySummary summarize(const std::vector<TrajectoryAccuracy>& accuracies,
                          const std::vector<TimeRange>& spans) {
  MeanSquare position, roll_pitch, heading;
  AccuracySummary summary;
  for (const TrajectoryAccuracy& a : accuracies) {
    const bool within =
        spans.empty() || std::any_of(spans.begin(), spans.end(), [&a](const TimeRange& span) {
          return a.time >= span.first - kMaximumTimeDifference &&
                 a.time <= span.last + kMaximumTimeDifference;
        });
    if (!within) continue;
    ++summary.records;
    for (const double value : a.position) position.add(value);
    roll_pitch.add(a.angles.x());
    roll_pitch.add(a.angles.y());
    heading.add(a.angles.z());
  }
  summary.position = position.root();
  summary.roll_pitch = roll_pitch.root();
  summary.heading = heading.root();
  return summary;
}

std::string describe(const AccuracySummary& summary) {
  std::string text;
  const auto add = [&text](const char* format, double value) {
    if (!std::isfinite(value)) return;
    char part[80];
    std::snprintf(part, sizeof part, format, value);
    text += (text.empty() ? "" : ", ") + std::string(part);
  };
  add("position %.3f m", summary.position);
  add("roll and pitch %.1f arcsec", summary.roll_pitch / kRadiansPerArcsec);
  add("heading %.1f arcsec", summary.heading / kRadiansPerArcsec);
  return text.empty() ? "no standard deviations" : text;
}

namespace {

/// The records of an smrmsg file; InputError where it is none.
std::vector<TrajectoryAccuracy> recordsOf(const std::string& content, const std::string& name) {
  constexpr std::size_t kBytes = sizeof(AccuracyRecord);
  if (content.empty()) throw InputError(name + ": is empty");
  if (content.size() % kBytes != 0) {
    throw InputError(name + ": its size, " + std::to_string(content.size()) +
                     " bytes, is not a multiple of the 80 of an accuracy record (smrmsg)");
  }
  std::vector<TrajectoryAccuracy> accuracies;
  double weeks = 0.0;  // seconds that run on past the end of the week
  for (std::size_t at = 0; at < content.size(); at += kBytes) {
    const auto refuse = [&](const char* why) {
      throw InputError(name + ": record " + std::to_string(at / kBytes + 1) + ": " + why);
    };
    AccuracyRecord record;
    std::memcpy(record.data(), content.data() + at, kBytes);
    if (const char* why = accuracyFault(record)) refuse(why);
    TrajectoryAccuracy accuracy;
    accuracy.time = record[0] + weeks;
    accuracy.position = {record[2], record[1], record[3]};
    accuracy.angles = kRadiansPerArcmin * Eigen::Vector3d(record[7], record[8], record[9]);
    if (!accuracies.empty() && accuracy.time < accuracies.back().time) {
      if (weeks > 0.0 || !detail::isWeekRollover(accuracies.back().time, accuracy.time))
        refuse("the time runs backwards");
      weeks = kSecondsPerWeek;
      accuracy.time += weeks;
    }
    accuracies.push_back(accuracy);
  }
  return accuracies;
}

}  // namespace

std::vector<TrajectoryAccuracy> readAccuracies(const std::filesystem::path& path) {
  if (lowerExtension(path) == ".poq") return detail::readRieglAccuracies(path);
  return recordsOf(readWholeFile(path, kBinaryLimits), path.string());
}

namespace detail {

bool isNamedAsAccuracy(const std::filesystem::path& path) {
  std::string name = path.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return name.find("smrmsg") != std::string::npos;
}

bool holdsAccuracies(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  if (isNamedAsAccuracy(path) || lowerExtension(path) == ".poq") return true;
  const std::string content = readWholeFile(path, kBinaryLimits);
  // The characters of a text would make numbers near zero.
  if (content.find('\0') == std::string::npos) return false;
  if (isRieglAccuracy(content)) return true;
  try {
    return !recordsOf(content, path.string()).empty();
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace detail
}  // namespace pcl_als
