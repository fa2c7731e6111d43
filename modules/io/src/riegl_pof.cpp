// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "riegl_pof.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/trajectory_accuracy.h>

#include "leap_seconds.h"
#include "week_rollover.h"

namespace pcl_als::detail {
namespace {

namespace fs = std::filesystem;

const std::string kPofSignature("RIEGL POSITION&ORIENTATION", 27);  // with a zero behind it
const std::string kPoqSignature("RIEGL POSITION&ORIENTATION QUALITY", 35);
constexpr std::size_t kPofHeader = 315, kPoqHeader = 67;
constexpr double kDay = 86400.0;
// Positions in the header of a .pof.
constexpr std::size_t kMinor = 29, kOffset = 31, kDate = 35, kCount = 41, kTimeUnit = 121;
enum TimeUnit { kNormalised, kDaySeconds, kWeekSeconds };
enum TimeSystem { kGps, kUtc, kUnknown };
enum Field { kTime, kLongitude, kLatitude, kHeight, kRoll, kPitch, kYaw, kFields };
using Record = std::array<double, kFields>;

template <typename T>
T valueAt(const std::string& content, std::size_t at) {
  T value;
  std::memcpy(&value, content.data() + at, sizeof value);
  return value;
}

/// What a .pof states of its times.
struct Times {
  int unit = kWeekSeconds, system = kUnknown;
  long day = -1;  ///< of the date, from 6 January 1980, a Sunday; negative: no date

  double weekDay() const { return unit == kDaySeconds && day >= 0 ? kDay * (day % 7) : 0.0; }
  double leapSeconds(const std::optional<double>& given) const {
    if (given) return *given;
    return system == kUtc ? leapSecondsAt(kDay * static_cast<double>(day)) : 0.0;
  }
};

/// Days from 6 January 1980; negative where this is no date since then.
long daysOf(int year, int month, int day) {
  if (year < 1980 || year > 2200 || month < 1 || month > 12 || day < 1 || day > 31) return -1;
  // Years that begin in March, as leap days then come last.
  const long y = month > 2 ? year : year - 1, m = month > 2 ? month - 3 : month + 9;
  const auto since_zero = [](long of_year, long of_month, long of_day) {
    return 365 * of_year + of_year / 4 - of_year / 100 + of_year / 400 + (153 * of_month + 2) / 5 +
           of_day - 1;
  };
  return since_zero(y, m, day) - since_zero(1979, 10, 6);
}

Times timesOf(const std::string& content) {
  const auto part = [&](std::size_t i) {
    return static_cast<int>(valueAt<std::uint16_t>(content, kDate + 2 * i));
  };
  Times times;
  times.unit = valueAt<std::uint8_t>(content, kTimeUnit);
  times.system = valueAt<std::uint8_t>(content, kTimeUnit + 1);
  times.day = daysOf(part(0), part(1), part(2));
  return times;
}

void checkTimes(const std::string& name, const Times& times) {
  if (times.unit == kNormalised) {
    throw InputError(name +
                     ": its times count from a start that the file does not state; export it with "
                     "seconds of the GPS week");
  }
  if (times.unit > kWeekSeconds || times.system > kUnknown)
    throw InputError(name + ": the unit or the system of its times is not one of the format");
  if (times.unit == kDaySeconds && times.day < 0)
    throw InputError(name + ": its times are seconds of the day, but its date is not a date");
}

/// What is wrong with a record, or nullptr. Comparisons are written so that NaN fails.
const char* fault(const Record& record) {
  if (!(std::abs(record[kTime]) < 1e12)) return "the time is out of range";
  if (!(std::abs(record[kLatitude]) <= 90.0)) return "the latitude is beyond 90 degrees";
  if (!(std::abs(record[kLongitude]) <= 360.0)) return "the longitude is beyond 360 degrees";
  if (!(std::abs(record[kHeight]) <= 100e3)) return "the height is beyond 100 km";
  for (const Field angle : {kRoll, kPitch, kYaw}) {
    if (!(std::abs(record[angle]) <= 720.0)) return "an attitude angle is beyond 720 degrees";
  }
  return nullptr;
}

TrajectorySample toSample(const Record& record) {
  TrajectorySample sample;
  sample.time = record[kTime];
  sample.position = {record[kLatitude] * kRadiansPerDegree, record[kLongitude] * kRadiansPerDegree,
                     record[kHeight]};
  sample.roll = record[kRoll] * kRadiansPerDegree;
  sample.pitch = record[kPitch] * kRadiansPerDegree;
  sample.heading = record[kYaw] * kRadiansPerDegree;
  return sample;
}

std::string pofContent(const fs::path& path) {
  std::string content = readWholeFile(path, kBinaryLimits);
  if (content.compare(0, kPofSignature.size(), kPofSignature) != 0 || content.size() < kPofHeader)
    throw InputError(path.string() +
                     ": is not a RIEGL trajectory, which begins with RIEGL POSITION&ORIENTATION "
                     "and a header of 315 bytes");
  return content;
}

/// Where the records of a .pof are; InputError where its file cannot hold them.
struct Extent {
  std::size_t first = 0, count = 0, bytes = 0;
};
Extent extentOf(const std::string& content, const std::string& name) {
  const auto offset = valueAt<std::uint32_t>(content, kOffset);
  const auto count = valueAt<std::int64_t>(content, kCount);
  const std::size_t bytes =
      sizeof(double) * (valueAt<std::uint16_t>(content, kMinor) >= 1 ? kFields + 1 : kFields);
  if (offset < kPofHeader || offset > content.size() || count < 1 ||
      static_cast<std::uint64_t>(count) > (content.size() - offset) / bytes) {
    throw InputError(name + ": its header states " + std::to_string(count) + " records of " +
                     std::to_string(bytes) + " bytes after " + std::to_string(offset) +
                     ", which a file of " + std::to_string(content.size()) +
                     " bytes does not hold; truncated or damaged");
  }
  return {offset, static_cast<std::size_t>(count), bytes};
}

void readRecords(const std::string& content, const std::string& name, const Times& times,
                 std::vector<TrajectorySample>& samples) {
  const Extent extent = extentOf(content, name);
  double midnight = 0.0;
  samples.reserve(extent.count);
  for (std::size_t i = 0; i < extent.count; ++i) {
    const auto refuse = [&](const char* why) {
      throw InputError(name + ": record " + std::to_string(i + 1) + ": " + why);
    };
    auto record = valueAt<Record>(content, extent.first + i * extent.bytes);
    if (const char* why = fault(record)) refuse(why);
    record[kTime] += midnight;
    if (!samples.empty() && record[kTime] < samples.back().time) {
      // Seconds of the day begin again at midnight; unwrapWeek() looks after those of the week.
      const bool next_day = times.unit == kDaySeconds && midnight == 0.0 &&
                            samples.back().time - record[kTime] > 0.5 * kDay;
      const bool next_week =
          times.unit == kWeekSeconds && isWeekRollover(samples.back().time, record[kTime]);
      if (!next_day && !next_week) refuse("the time runs backwards");
      if (next_day) midnight = kDay, record[kTime] += kDay;
    }
    samples.push_back(toSample(record));
  }
}

fs::path besideIt(fs::path path, const char* extension) {
  return path.replace_extension(extension);
}

/// Values of a record of a .poq: time, six standard deviations, PDOP.
using PoqValues = std::array<double, 8>;

const char* fault(const PoqValues& values) {
  constexpr double kLargest = 1000.0, kWidest = 180.0;  // metres, degrees
  if (!(std::abs(values[0]) < 1e12)) return "the time is out of range";
  for (std::size_t i = 1; i < 7; ++i) {
    if (!(values[i] >= 0.0 && values[i] <= (i < 4 ? kLargest : kWidest)))
      return "a value is not a standard deviation";
  }
  return nullptr;
}

/// Where the records of a .poq are.
struct PoqExtent {
  std::size_t first = 0, bytes = 0;
};
PoqExtent poqExtent(const std::string& content, const std::string& name) {
  const std::size_t version = kPoqSignature.size();
  if (!isRieglAccuracy(content) || content.size() < kPoqHeader)
    throw InputError(name +
                     ": is not a RIEGL accuracy file, which begins with RIEGL "
                     "POSITION&ORIENTATION QUALITY and a header of 67 bytes");
  const bool two_systems = valueAt<std::uint16_t>(content, version + 2) >= 1;
  const std::size_t bytes = sizeof(PoqValues) + sizeof(std::uint16_t) * (two_systems ? 2 : 1);
  const auto first = valueAt<std::uint32_t>(content, version + 4);
  if (first < kPoqHeader || first >= content.size() || (content.size() - first) % bytes != 0)
    throw InputError(name + ": its size, " + std::to_string(content.size()) +
                     " bytes, is not that of a header and records of " + std::to_string(bytes) +
                     " bytes; truncated or damaged");
  return {first, bytes};
}

}  // namespace

TrajectoryRecords readRieglTrajectory(const fs::path& path, const TrajectoryReading& reading) {
  const std::string name = path.string();
  const std::string content = pofContent(path);
  const Times times = timesOf(content);
  checkTimes(name, times);
  TrajectoryRecords records;
  records.format = "RIEGL trajectory";
  records.coordinates = TrajectoryCoordinates::geographic;
  readRecords(content, name, times, records.samples);
  const double leap = times.leapSeconds(reading.leap_seconds);
  for (TrajectorySample& sample : records.samples) sample.time += times.weekDay() + leap;
  if (times.unit == kDaySeconds)
    records.remarks.push_back("its times are seconds of the day, brought to seconds of the week");
  if (times.system == kUtc)
    records.remarks.push_back("its times are UTC, brought to GPS time");
  else if (times.system == kUnknown)
    records.remarks.push_back("it does not state whether its times are UTC: taken as GPS time");
  const fs::path quality = besideIt(path, ".poq");
  std::error_code error;
  if (!fs::exists(quality, error)) return records;
  std::vector<TrajectoryAccuracy> known = readRieglAccuracies(quality);
  for (const TrajectorySample& sample : records.samples)
    records.accuracy.push_back(accuracyAt(known, sample.time));
  records.remarks.push_back("standard deviations from " + quality.filename().string());
  return records;
}

bool isRieglAccuracy(const std::string& content) {
  return content.compare(0, kPoqSignature.size(), kPoqSignature) == 0;
}

std::vector<TrajectoryAccuracy> readRieglAccuracies(const fs::path& path) {
  const std::string name = path.string(), content = readWholeFile(path, kBinaryLimits);
  const PoqExtent extent = poqExtent(content, name);
  const fs::path trajectory = besideIt(path, ".pof");
  std::error_code error;
  const Times times = fs::exists(trajectory, error) ? timesOf(pofContent(trajectory)) : Times();
  const double shift = times.weekDay() + times.leapSeconds(std::nullopt);
  std::vector<TrajectoryAccuracy> accuracies;
  double midnight = 0.0;
  for (std::size_t at = extent.first; at < content.size(); at += extent.bytes) {
    const auto refuse = [&](const char* why) {
      throw InputError(name + ": record " + std::to_string((at - extent.first) / extent.bytes + 1) +
                       ": " + why);
    };
    const auto values = valueAt<PoqValues>(content, at);
    if (const char* why = fault(values)) refuse(why);
    TrajectoryAccuracy accuracy;
    accuracy.time = values[0] + shift + midnight;
    accuracy.position = {values[2], values[1], values[3]};
    accuracy.angles = kRadiansPerDegree * Eigen::Vector3d(values[4], values[5], values[6]);
    if (!accuracies.empty() && accuracy.time < accuracies.back().time) {
      if (midnight > 0.0 || accuracies.back().time - accuracy.time < 0.5 * kDay)
        refuse("the time runs backwards");
      midnight = kDay;
      accuracy.time += kDay;
    }
    accuracies.push_back(accuracy);
  }
  return accuracies;
}

}  // namespace pcl_als::detail
