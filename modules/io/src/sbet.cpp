// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "sbet.h"

#include <array>
#include <cmath>
#include <cstring>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/system_parameters.h>

#include "week_rollover.h"

namespace pcl_als::detail {
namespace {

enum Field { kTime, kLatitude, kLongitude, kHeight, kRoll = 7, kPitch, kHeading, kWander };
constexpr std::size_t kFields = 17;
constexpr std::size_t kRecordBytes = kFields * sizeof(double);
using Record = std::array<double, kFields>;

// Values are taken as they lie in memory.
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "SBET is read on little-endian machines");

/// What is wrong with a record, or nullptr. Comparisons are written so that NaN fails.
const char* fault(const Record& record) {
  constexpr double kHighest = 100e3;  // metres
  for (const double value : record) {
    if (!std::isfinite(value)) return "a value is not a finite number";
  }
  if (!(std::abs(record[kTime]) < 1e12)) return "the time is out of range";
  if (!(std::abs(record[kLatitude]) <= 0.5 * kPi)) return "the latitude is beyond pi/2";
  if (!(std::abs(record[kLongitude]) <= 2.0 * kPi)) return "the longitude is beyond 2 pi";
  if (!(std::abs(record[kHeight]) <= kHighest)) return "the height is beyond 100 km";
  for (const Field angle : {kRoll, kPitch, kHeading, kWander}) {
    if (!(std::abs(record[angle]) <= 4.0 * kPi)) return "an attitude angle is beyond 4 pi";
  }
  return nullptr;
}

TrajectorySample toSample(const Record& record) {
  TrajectorySample sample;
  sample.time = record[kTime];
  sample.position = {record[kLatitude], record[kLongitude], record[kHeight]};
  sample.roll = record[kRoll];
  sample.pitch = record[kPitch];
  sample.heading = record[kHeading] - record[kWander];
  return sample;
}

}  // namespace

TrajectoryRecords readSbet(const std::filesystem::path& path, const TrajectoryReading& reading) {
  const std::string name = path.string();
  const std::string content = readWholeFile(path, kBinaryLimits);
  if (content.empty()) throw InputError(name + ": is empty");
  if (content.size() % kRecordBytes != 0) {
    throw InputError(name + ": its size, " + std::to_string(content.size()) +
                     " bytes, is not a multiple of the 136 of an SBET record; truncated or not an "
                     "SBET");
  }
  TrajectoryRecords records;
  records.format = "SBET";
  records.coordinates = TrajectoryCoordinates::geographic;
  std::vector<TrajectorySample>& samples = records.samples;
  samples.reserve(content.size() / kRecordBytes);
  for (std::size_t at = 0; at < content.size(); at += kRecordBytes) {
    const auto refuse = [&](const char* why) {
      throw InputError(name + ": record " + std::to_string(at / kRecordBytes + 1) + ": " + why);
    };
    Record record;
    std::memcpy(record.data(), content.data() + at, kRecordBytes);
    if (const char* why = fault(record)) refuse(why);
    if (!samples.empty() && record[kTime] < samples.back().time &&
        !isWeekRollover(samples.back().time, record[kTime])) {
      refuse("the time runs backwards");
    }
    samples.push_back(toSample(record));
  }
  if (reading.leap_seconds) {
    for (TrajectorySample& sample : samples) sample.time += *reading.leap_seconds;
  }
  return records;
}

}  // namespace pcl_als::detail
