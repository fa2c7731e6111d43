// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "terrascan_trj.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kLeastHeader = 24;  // bytes up to the size of the records
enum Field { kTime, kEasting, kNorthing, kElevation, kHeading, kRoll, kPitch, kFields };
using Record = std::array<double, kFields>;

std::int64_t integerAt(const std::string& content, std::size_t at) {
  std::int32_t value = 0;
  std::memcpy(&value, content.data() + at, sizeof value);
  return value;
}

/// What is wrong with a record, or nullptr. Comparisons are written so that NaN fails.
const char* fault(const Record& record) {
  if (!(std::abs(record[kTime]) < 1e12)) return "the time is out of range";
  for (const Field axis : {kEasting, kNorthing, kElevation}) {
    if (!(std::abs(record[axis]) < 1e9)) return "a coordinate is out of range";
  }
  for (const Field angle : {kHeading, kRoll, kPitch}) {
    if (!(std::abs(record[angle]) <= 720.0)) return "an attitude angle is beyond 720 degrees";
  }
  return nullptr;
}

}  // namespace

TrajectoryRecords readTerrascanTrajectory(const std::filesystem::path& path,
                                          const TrajectoryReading& reading) {
  const std::string name = path.string();
  const std::string content = readWholeFile(path, kBinaryLimits);
  if (content.size() < kLeastHeader || content.compare(0, 8, "TSCANTRJ") != 0)
    throw InputError(name + ": is not a TerraScan trajectory, which begins with TSCANTRJ");
  const std::int64_t header = integerAt(content, 12), count = integerAt(content, 16);
  const std::int64_t size = integerAt(content, 20);
  const auto bytes = static_cast<std::int64_t>(content.size());
  if (header < static_cast<std::int64_t>(kLeastHeader) || header > bytes || count < 1 ||
      size < static_cast<std::int64_t>(sizeof(Record)) || count > (bytes - header) / size) {
    throw InputError(name + ": its header states " + std::to_string(count) + " records of " +
                     std::to_string(size) + " bytes after " + std::to_string(header) +
                     ", which a file of " + std::to_string(bytes) +
                     " bytes does not hold; truncated or damaged");
  }
  TrajectoryRecords records;
  records.format = "TerraScan trajectory";
  for (std::int64_t i = 0; i < count; ++i) {
    Record record;
    std::memcpy(record.data(), content.data() + header + i * size, sizeof record);
    if (const char* why = fault(record))
      throw InputError(name + ": record " + std::to_string(i + 1) + ": " + why);
    TrajectorySample sample;
    sample.time = record[kTime] + reading.leap_seconds.value_or(0.0);
    sample.position = {record[kEasting], record[kNorthing], record[kElevation]};
    sample.roll = record[kRoll] * kRadiansPerDegree;
    sample.pitch = record[kPitch] * kRadiansPerDegree;
    sample.heading = record[kHeading] * kRadiansPerDegree;
    records.samples.push_back(sample);
  }
  return records;
}

}  // namespace pcl_als::detail
