// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/io/trajectory_writer.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using AccuracyRecord = std::array<double, 10>;
constexpr double kArcmin = kRadiansPerDegree / 60.0;

fs::path smrmsg(const std::vector<AccuracyRecord>& records, std::size_t extra_bytes = 0) {
  const auto path = test::scratch("trajectory_writer") / "smrmsg_flight.out";
  std::ofstream stream(path, std::ios::binary);
  for (const AccuracyRecord& r : records)
    stream.write(reinterpret_cast<const char*>(r.data()), sizeof(AccuracyRecord));
  stream << std::string(extra_bytes, '\0');
  return path;
}

std::string refusalOfAccuracies(const std::vector<AccuracyRecord>& records,
                                std::size_t extra_bytes = 0) {
  return test::messageOf<InputError>([&] { readAccuracies(smrmsg(records, extra_bytes)); });
}

std::vector<TrajectorySample> samples() {
  std::vector<TrajectorySample> samples(3);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double t = static_cast<double>(i);
    samples[i].time = 100.0 + t;
    samples[i].position = {600000.0 + 60.0 * t, 5000000.0, 1500.0 + t};
    samples[i].roll = 0.01, samples[i].pitch = -0.02, samples[i].heading = 1.5;
  }
  return samples;
}

TEST(Smrmsg, RecordsByHand) {
  // time, north east down (m), velocities (m/s), roll pitch heading (arc-minutes).
  const auto read = readAccuracies(smrmsg({{400000.0, 0.02, 0.03, 0.05, 1, 2, 3, 0.5, 0.6, 1.5},
                                           {400001.0, 0.04, 0.03, 0.05, 1, 2, 3, 0.5, 0.6, 1.5}}));
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].time, 400000.0);
  EXPECT_EQ(read[0].position, Eigen::Vector3d(0.03, 0.02, 0.05));
  EXPECT_DOUBLE_EQ(read[0].angles.x(), 0.5 * kArcmin);
  EXPECT_DOUBLE_EQ(read[0].angles.z(), 1.5 * kArcmin);
  EXPECT_DOUBLE_EQ(accuracyAt(read, 400000.25).position.y(), 0.025);
  EXPECT_DOUBLE_EQ(accuracyAt(read, 400001.5).position.y(), 0.04);  // within a second of the end
  EXPECT_TRUE(std::isnan(accuracyAt(read, 400003.0).position.y()));
}

TEST(Smrmsg, RefusesWhatIsNoStandardDeviation) {
  const AccuracyRecord good{1.0, 0.02, 0.03, 0.05, 0, 0, 0, 0.5, 0.6, 1.5};
  const auto with = [&](std::size_t field, double value) {
    AccuracyRecord bad = good;
    bad[field] = value;
    return refusalOfAccuracies({good, bad});
  };
  EXPECT_NE(with(1, -0.1).find("record 2: a standard deviation is negative"), std::string::npos);
  EXPECT_NE(with(3, 5000.0).find("record 2: a value is not"), std::string::npos);
  EXPECT_NE(with(9, std::nan("")).find("record 2: a value is not"), std::string::npos);
  EXPECT_NE(with(0, 0.5).find("record 2: the time runs backwards"), std::string::npos);
  EXPECT_NE(refusalOfAccuracies({good}, 8).find("multiple of the 80"), std::string::npos);
  EXPECT_NE(refusalOfAccuracies({}).find("is empty"), std::string::npos);
  // Across the end of the week.
  AccuracyRecord first = good, second = good, third = good;
  first[0] = 604799.5, second[0] = 0.5, third[0] = 1.5;
  EXPECT_EQ(readAccuracies(smrmsg({first, second, third}))[2].time, 604801.5);
}

TEST(Smrmsg, RootMeanSquareOverSomeTimes) {
  const auto read = readAccuracies(smrmsg({{100.0, 0.01, 0.02, 0.02, 0, 0, 0, 0.3, 0.4, 1.0},
                                           {101.0, 0.01, 0.02, 0.02, 0, 0, 0, 0.3, 0.4, 1.0},
                                           {500.0, 9.0, 9.0, 9.0, 0, 0, 0, 9.0, 9.0, 9.0}}));
  TimeRange span;
  span.add(90.0), span.add(110.0);
  const AccuracySummary summary = summarize(read, {span});
  EXPECT_EQ(summary.records, 2U);
  EXPECT_NEAR(summary.position, std::sqrt((1.0 + 4.0 + 4.0) / 3.0) * 0.01, 1e-12);
  EXPECT_NEAR(summary.roll_pitch, std::sqrt((0.09 + 0.16) / 2.0) * kArcmin, 1e-12);
  EXPECT_NEAR(summary.heading, kArcmin, 1e-12);
  EXPECT_EQ(describe(summary), "position 0.017 m, roll and pitch 21.2 arcsec, heading 60.0 arcsec");
  EXPECT_EQ(summarize(read).records, 3U);
  EXPECT_EQ(summarize({}).records, 0U);
}

TEST(Smrmsg, IsReadAsWritten) {
  const auto read = readAccuracies(smrmsg({{1.0, 0.02, 0.03, 0.05, 0, 0, 0, 0.5, 0.6, 1.5}}));
  const auto path = test::scratch("trajectory_writer") / "again.out";
  writeAccuracies(path, read);
  const auto again = readAccuracies(path);
  EXPECT_EQ(again[0].position, read[0].position);
  EXPECT_NEAR(again[0].angles.z(), read[0].angles.z(), 1e-15);
}

TEST(TrajectoryWriter, CsvIsReadAsWritten) {
  const auto path = test::scratch("trajectory_writer") / "flight.csv";
  std::vector<TrajectoryAccuracy> accuracy(3);
  for (TrajectoryAccuracy& a : accuracy) a.position.setConstant(0.02);
  writeTrajectoryCsv(path, samples(), accuracy);
  const TrajectoryFile file = readTrajectoryFile(path, TrajectoryReading());
  ASSERT_EQ(file.samples.size(), 3U);
  EXPECT_EQ(file.samples[2].position, samples()[2].position);
  EXPECT_NEAR(file.samples[2].heading, 1.5, 1e-10);
  EXPECT_EQ(file.accuracy[1].position.z(), 0.02);
  EXPECT_TRUE(std::isnan(file.accuracy[1].angles.z()));  // unknown ones are empty
  auto without = samples();
  without[1].roll = std::nan("");
  writeTrajectoryCsv(path, without);
  EXPECT_FALSE(readTrajectory(path)[0].hasAttitude());
}

#ifdef PCL_ALS_HAVE_PROJ

TEST(TrajectoryWriter, SbetIsReadAsWritten) {
  const auto path = test::scratch("trajectory_writer") / "flight.sbet";
  writeSbet(path, samples(), "EPSG:32632");
  const auto read = readTrajectory(path, "EPSG:32632");
  ASSERT_EQ(read.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_LT((read[i].position - samples()[i].position).norm(), 1e-6);
    EXPECT_NEAR(read[i].heading, 1.5, 1e-9);
    EXPECT_EQ(read[i].pitch, -0.02);
  }
  // Velocities north, west, up: 60 m/s to the east of the grid, whose north lies east of true north
  // by the convergence of 1.27 degrees of longitude at 45 degrees.
  std::array<double, 17> record{};
  std::ifstream(path, std::ios::binary)
      .seekg(sizeof record)
      .read(reinterpret_cast<char*>(record.data()), sizeof record);
  EXPECT_NEAR(record[5], -60.0, 0.05);
  EXPECT_NEAR(record[4], -60.0 * std::sin(1.27 * kRadiansPerDegree * std::sin(0.25 * kPi)), 0.02);
  EXPECT_NEAR(record[6], 1.0, 0.01);
  EXPECT_EQ(record[10], 0.0);  // wander angle
  auto without = samples();
  without[1].roll = std::nan("");
  EXPECT_THROW(writeSbet(path, without, "EPSG:32632"), InputError);
}

#endif

}  // namespace
}  // namespace pcl_als
