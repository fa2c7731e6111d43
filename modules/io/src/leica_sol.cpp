// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "leica_sol.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/system_parameters.h>

#include "week_rollover.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kRecordBytes = 184, kHeaderBytes = 35;
// Positions in a record.
constexpr std::size_t kTime = 18, kLatitude = 42, kLongitude = 50, kHeight = 58, kHeightError = 74;
constexpr std::size_t kRoll = 78, kPitch = 86, kHeading = 94, kAngleErrors = 102;
constexpr std::size_t kUndulation = 174;

template <typename T>
T valueAt(const char* record, std::size_t at) {
  T value;
  std::memcpy(&value, record + at, sizeof value);
  return value;
}

/// What is wrong with a record, or nullptr. Comparisons are written so that NaN fails.
const char* fault(const char* record) {
  unsigned sum = 0;
  for (std::size_t i = 0; i + 1 < kHeaderBytes; ++i) sum ^= static_cast<unsigned char>(record[i]);
  if (sum != static_cast<unsigned char>(record[kHeaderBytes - 1]))
    return "its header does not have the checksum that it states (damaged, or not a .sol file)";
  if (!(std::abs(valueAt<double>(record, kTime)) < 1e12)) return "the time is out of range";
  if (!(std::abs(valueAt<double>(record, kLatitude)) <= 0.5 * kPi))
    return "the latitude is beyond pi/2";
  if (!(std::abs(valueAt<double>(record, kLongitude)) <= 2.0 * kPi))
    return "the longitude is beyond 2 pi";
  if (!(std::abs(valueAt<double>(record, kHeight)) <= 100e3)) return "the height is beyond 100 km";
  for (const std::size_t angle : {kRoll, kPitch, kHeading}) {
    if (!(std::abs(valueAt<double>(record, angle)) <= 4.0 * kPi))
      return "an attitude angle is beyond 4 pi";
  }
  return nullptr;
}

TrajectorySample sampleOf(const char* record) {
  TrajectorySample sample;
  sample.time = valueAt<double>(record, kTime);
  sample.position = {valueAt<double>(record, kLatitude), valueAt<double>(record, kLongitude),
                     valueAt<double>(record, kHeight)};
  sample.roll = valueAt<double>(record, kRoll);
  sample.pitch = valueAt<double>(record, kPitch);
  sample.heading = valueAt<double>(record, kHeading);
  return sample;
}

/// A standard deviation; NaN where the file has none.
double errorAt(const char* record, std::size_t at) {
  const auto value = static_cast<double>(valueAt<float>(record, at));
  return value > 0.0 && value < 1000.0 ? value : TrajectoryAccuracy::kUnknown;
}

TrajectoryAccuracy accuracyOf(const char* record) {
  TrajectoryAccuracy accuracy;
  accuracy.time = valueAt<double>(record, kTime);
  accuracy.position.z() = errorAt(record, kHeightError);
  for (int i = 0; i < 3; ++i)
    accuracy.angles[i] =
        errorAt(record, kAngleErrors + sizeof(float) * static_cast<std::size_t>(i));
  return accuracy;
}

/// Undulations of the records: what may explain an offset of heights.
class Undulations {
 public:
  void add(float value) {
    if (!(std::abs(value) > 0.0F && std::abs(value) < 200.0F)) return;
    least_ = std::min(least_, value), most_ = std::max(most_, value);
  }
  std::string describe() const {
    if (most_ < least_) return {};
    char text[120];
    std::snprintf(text, sizeof text,
                  "its records state geoid undulations of %.1f to %.1f m, which are not applied",
                  static_cast<double>(least_), static_cast<double>(most_));
    return text;
  }

 private:
  float least_ = 1e9F, most_ = -1e9F;
};

}  // namespace

TrajectoryRecords readLeicaTrajectory(const std::filesystem::path& path,
                                      const TrajectoryReading& reading) {
  const std::string name = path.string(), content = readWholeFile(path, kBinaryLimits);
  if (content.empty()) throw InputError(name + ": is empty");
  if (content.size() % kRecordBytes != 0) {
    throw InputError(name + ": its size, " + std::to_string(content.size()) +
                     " bytes, is not a multiple of the 184 of a .sol record; truncated, or of a "
                     "version that is not known");
  }
  TrajectoryRecords records;
  records.format = "Leica trajectory";
  records.coordinates = TrajectoryCoordinates::geographic;
  Undulations undulations;
  for (std::size_t at = 0; at < content.size(); at += kRecordBytes) {
    const char* record = content.data() + at;
    const auto refuse = [&](const char* why) {
      throw InputError(name + ": record " + std::to_string(at / kRecordBytes + 1) + ": " + why);
    };
    if (const char* why = fault(record)) refuse(why);
    TrajectorySample sample = sampleOf(record);
    if (!records.samples.empty() && sample.time < records.samples.back().time &&
        !isWeekRollover(records.samples.back().time, sample.time))
      refuse("the time runs backwards");
    records.samples.push_back(sample);
    records.accuracy.push_back(accuracyOf(record));
    undulations.add(valueAt<float>(record, kUndulation));
  }
  if (reading.leap_seconds) {
    for (TrajectorySample& sample : records.samples) sample.time += *reading.leap_seconds;
  }
  if (const std::string text = undulations.describe(); !text.empty())
    records.remarks.push_back(text);
  return records;
}

}  // namespace pcl_als::detail
