// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Files written by hand from the structures of the TerraScan User's Guide: a header of 1376 bytes
// and records of 64.
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

constexpr std::int32_t kHeader = 1376, kRecord = 64;

void store(std::string& bytes, std::size_t at, std::int32_t value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// Two records, with another value at a position of the header.
std::string content(std::size_t at = 0, std::int32_t value = 0) {
  std::string bytes(kHeader + 2 * kRecord, '\0');
  bytes.replace(0, 8, "TSCANTRJ");
  store(bytes, 8, 20010715);
  store(bytes, 12, kHeader);
  store(bytes, 16, 2);
  store(bytes, 20, kRecord);
  if (at > 0) store(bytes, at, value);
  for (int i = 0; i < 2; ++i) {
    const double record[7] = {100.0 + i, 500000.0, 5000000.0 + 60.0 * i, 1500.0, 359.0, 2.0, -1.0};
    std::memcpy(bytes.data() + kHeader + i * kRecord, record, sizeof record);
  }
  return bytes;
}

std::filesystem::path trjFile(const std::string& bytes) {
  const auto path = test::scratch("terrascan_trj") / "flight.trj";
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

std::string refusalOfTrj(const std::string& bytes) {
  return test::messageOf<InputError>([&] { readTrajectory(trjFile(bytes)); });
}

TEST(TerrascanTrj, RecordsByHand) {
  const TrajectoryFile flight = readTrajectoryFile(trjFile(content()), TrajectoryReading());
  ASSERT_EQ(flight.samples.size(), 2U);
  EXPECT_EQ(flight.format, "TerraScan trajectory");
  const TrajectorySample& sample = flight.samples[1];
  EXPECT_EQ(sample.time, 101.0);
  EXPECT_EQ(sample.position, Eigen::Vector3d(500000.0, 5000060.0, 1500.0));
  EXPECT_DOUBLE_EQ(sample.heading, 359.0 * kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(sample.roll, 2.0 * kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(sample.pitch, -1.0 * kRadiansPerDegree);
}

TEST(TerrascanTrj, RefusesHeadersThatTheFileContradicts) {
  EXPECT_NE(refusalOfTrj("TSCANTRJ").find("begins with TSCANTRJ"), std::string::npos);
  EXPECT_NE(refusalOfTrj("x" + content()).find("begins with TSCANTRJ"), std::string::npos);
  const struct {
    std::size_t at;
    std::int32_t value;
  } cases[] = {{12, -1}, {12, 1 << 30}, {16, 0}, {16, 3}, {16, 1 << 30}, {16, -5}, {20, 8}};
  for (const auto& row : cases) {
    EXPECT_NE(refusalOfTrj(content(row.at, row.value)).find("truncated or damaged"),
              std::string::npos)
        << row.at << ' ' << row.value;
  }
  std::string bad = content();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(bad.data() + kHeader + kRecord + 8, &nan, sizeof nan);
  EXPECT_NE(refusalOfTrj(bad).find("record 2: a coordinate is out of range"), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
