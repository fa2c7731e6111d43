// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// RIEGL .pof and .poq, Leica .sol: files written by hand from the published descriptions.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/io/trajectory_accuracy.h>

#include "test_files.h"
#include "trajectory_bytes.h"

namespace pcl_als {
namespace {

using test::PofBytes;

constexpr double kWednesday = 3.0 * 86400.0;

std::filesystem::path writeExport(const std::string& name, const std::string& bytes) {
  static const std::filesystem::path folder = test::scratch("other_trajectories");
  const auto path = folder / name;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

TrajectoryFacts inspect(const std::filesystem::path& path, const TrajectoryReading& reading = {}) {
  return inspectTrajectory(path, reading);
}

std::string refusalOfExport(const std::string& name, const std::string& bytes) {
  return test::messageOf<InputError>([&] { inspect(writeExport(name, bytes)); });
}

void expectRefusal(const std::string& name, const std::string& bytes, const std::string& text) {
  const std::string message = refusalOfExport(name, bytes);
  EXPECT_NE(message.find(text), std::string::npos) << message;
}

TEST(RieglTrajectory, RecordsByHand) {
  const TrajectoryFacts facts = inspect(writeExport("flight.pof", PofBytes().str()));
  EXPECT_EQ(facts.format, "RIEGL trajectory");
  ASSERT_EQ(facts.samples, 3U);
  // 29 April 2015 was a Wednesday.
  EXPECT_EQ(facts.times.first, kWednesday + 53809.0);
  EXPECT_EQ(facts.times.last, kWednesday + 53811.0);
  const TrajectorySample& sample = facts.local[1];
  EXPECT_NEAR(sample.position.y(), 60.0, 0.2);  // north, on a sphere
  EXPECT_NEAR(sample.position.x(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(sample.roll, -0.35 * kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(sample.pitch, 2.32 * kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(sample.heading, 359.63 * kRadiansPerDegree);
  EXPECT_TRUE(facts.accuracy.empty());
}

TEST(RieglTrajectory, TimesOfEverySystem) {
  PofBytes week;
  week.minor = 0, week.unit = 2, week.first_time = 313009.0;
  EXPECT_EQ(inspect(writeExport("week.pof", week.str())).times.first, 313009.0);
  week.system = 1;  // UTC lagged GPS time by 16 s in April 2015
  EXPECT_EQ(inspect(writeExport("week.pof", week.str())).times.first, 313025.0);
  TrajectoryReading reading;
  reading.leap_seconds = 17.0;
  EXPECT_EQ(inspect(writeExport("week.pof", week.str()), reading).times.first, 313026.0);
  PofBytes night;
  night.first_time = 86399.0, night.step = 1.0;
  std::string bytes = night.str();
  const double after_midnight = 0.5;
  std::memcpy(&bytes[315 + 64], &after_midnight, sizeof after_midnight);
  const double later = 1.5;
  std::memcpy(&bytes[315 + 128], &later, sizeof later);
  EXPECT_EQ(inspect(writeExport("night.pof", bytes)).times.last, kWednesday + 86401.5);
}

TEST(RieglTrajectory, StandardDeviationsOfTheFileBesideIt) {
  writeExport("both.pof", PofBytes().str());
  const auto quality = writeExport("both.poq", test::poqBytes(3, 1));
  const auto folder = quality.parent_path();
  const TrajectoryFacts facts = inspect(folder / "both.pof");
  ASSERT_EQ(facts.accuracy.size(), 3U);
  EXPECT_EQ(facts.accuracy[2].position, Eigen::Vector3d(0.02, 0.01, 0.03));  // east, north, up
  EXPECT_DOUBLE_EQ(facts.accuracy[2].angles.z(), 0.006 * kRadiansPerDegree);
  const std::vector<TrajectoryAccuracy> read = readAccuracies(quality);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].time, kWednesday + 53809.0);
  // Without the trajectory the times stand as they are.
  EXPECT_EQ(readAccuracies(writeExport("alone.poq", test::poqBytes(2, 0)))[1].time, 53810.0);
}

TEST(RieglTrajectory, Refusals) {
  PofBytes file;
  expectRefusal("text.pof", "time,x,y,z\n", "is not a RIEGL trajectory");
  expectRefusal("short.pof", file.str().substr(0, 400), "truncated or damaged");
  file.stated = 1000000000;
  expectRefusal("claims.pof", file.str(), "truncated or damaged");
  file.stated = 0, file.offset = 0xFFFFFFFF;
  expectRefusal("offset.pof", file.str(), "truncated or damaged");
  file = PofBytes(), file.unit = 0;
  expectRefusal("start.pof", file.str(), "count from a start that the file does not state");
  file.unit = 9;
  expectRefusal("unit.pof", file.str(), "not one of the format");
  file = PofBytes(), file.month = 0;
  expectRefusal("date.pof", file.str(), "is not a date");
  file = PofBytes(), file.latitude = 91.0;
  expectRefusal("latitude.pof", file.str(), "record 1: the latitude is beyond 90 degrees");
  file = PofBytes(), file.step = -1.0;
  expectRefusal("backwards.pof", file.str(), "record 2: the time runs backwards");
  const auto quality = [](const std::string& bytes) {
    return test::messageOf<InputError>([&] { readAccuracies(writeExport("bad.poq", bytes)); });
  };
  EXPECT_NE(quality("x").find("is not a RIEGL accuracy file"), std::string::npos);
  EXPECT_NE(quality(test::poqBytes(2, 1) + "x").find("truncated or damaged"), std::string::npos);
  std::string negative = test::poqBytes(2, 1);
  negative[67 + 15] = '\xBF';  // sign of the first standard deviation
  EXPECT_NE(quality(negative).find("record 1: a value is not a standard"), std::string::npos);
}

TEST(LeicaTrajectory, RecordsByHand) {
  const TrajectoryFacts facts = inspect(writeExport("flight.sol", test::solBytes(3)));
  EXPECT_EQ(facts.format, "Leica trajectory");
  ASSERT_EQ(facts.samples, 3U);
  EXPECT_EQ(facts.times.first, 400825.0);
  EXPECT_EQ(facts.times.last, 400827.0);
  const TrajectorySample& sample = facts.local[2];
  EXPECT_NEAR(sample.position.y(), 120.0, 0.2);
  EXPECT_EQ(sample.roll, 0.01);
  EXPECT_EQ(sample.pitch, -0.02);
  EXPECT_EQ(sample.heading, 6.27);
  ASSERT_EQ(facts.accuracy.size(), 3U);
  EXPECT_TRUE(std::isnan(facts.accuracy[0].position.x()));
  EXPECT_NEAR(facts.accuracy[0].position.z(), 0.03, 1e-6);
  EXPECT_NEAR(facts.accuracy[0].angles.z(), 1e-4, 1e-9);
}

TEST(LeicaTrajectory, Refusals) {
  const std::string good = test::solBytes(2);
  expectRefusal("empty.sol", "", "is empty");
  expectRefusal("cut.sol", good.substr(0, 200), "not a multiple of the 184");
  std::string bad = good;
  bad[184 + 20] ^= 1;
  expectRefusal("sum.sol", bad, "record 2: its header does not have the checksum");
  bad = good;
  const double nan = std::nan("");
  std::memcpy(&bad[50], &nan, sizeof nan);
  expectRefusal("nan.sol", bad, "record 1: the longitude is beyond 2 pi");
  expectRefusal("backwards.sol", test::solBytes(1) + test::solBytes(1, 400000.0),
                "record 2: the time runs backwards");
}

}  // namespace
}  // namespace pcl_als
