// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/trajectory_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

/// A straight flight at 60 m/s, one sample a second, at the times from, from + 1, …, to.
void writeFlight(const fs::path& path, double from, double to, double aside = 0.0,
                 double shift = 0.0) {
  std::ofstream stream(path);
  stream << "time,x,y,z,roll,pitch,heading\n";
  for (double t = from; t <= to; t += 1.0) {
    char line[120];
    std::snprintf(line, sizeof line, "%.3f,%.4f,%.4f,1000,1,2,90\n", t + shift, 60.0 * t, aside);
    stream << line;
  }
}

class TrajectoryFiles : public ::testing::Test {
 protected:
  fs::path folder = test::scratch("trajectory_files");
  std::string refusal(const std::vector<fs::path>& files) const {
    return test::messageOf<Error>([&] { readTrajectoryFiles(files, {}); });
  }
};

TEST_F(TrajectoryFiles, AreJoinedInOrderOfTime) {
  writeFlight(folder / "late.csv", 300.0, 310.0);
  writeFlight(folder / "early.csv", 100.0, 110.0);
  const auto flight = readTrajectoryFiles({folder / "late.csv", folder / "early.csv"}, {});
  ASSERT_EQ(flight.samples.size(), 22U);
  EXPECT_EQ(flight.samples[0].time, 100.0);
  EXPECT_EQ(flight.samples[10].time, 110.0);
  EXPECT_EQ(flight.samples[11].time, 300.0);
  EXPECT_EQ(readTrajectoryFiles({folder}, {}).samples.size(), 22U);  // a folder
}

TEST_F(TrajectoryFiles, RepeatedEpochsCountOnce) {
  writeFlight(folder / "a.csv", 100.0, 110.0);
  writeFlight(folder / "b.csv", 105.0, 120.0);
  writeFlight(folder / "c.csv", 100.5, 104.5);  // between the samples of the first
  const auto flight = readTrajectoryFiles({folder}, {});
  ASSERT_EQ(flight.samples.size(), 21U);
  for (std::size_t i = 0; i < 21; ++i) EXPECT_EQ(flight.samples[i].time, 100.0 + double(i));
  EXPECT_NE(flight.remarks[0].find("samples repeat those of other files"), std::string::npos);
}

TEST_F(TrajectoryFiles, OverlapsThatDifferAreRefused) {
  writeFlight(folder / "a.csv", 100.0, 110.0);
  writeFlight(folder / "b.csv", 105.0, 120.0, 0.05);
  const std::string message = refusal({folder});
  EXPECT_NE(message.find("b.csv and "), std::string::npos) << message;
  EXPECT_NE(message.find("lie 0.050 m apart at 105.000 s"), std::string::npos) << message;
}

TEST_F(TrajectoryFiles, AFileWithinAGapOfAnotherIsTaken) {
  writeFlight(folder / "a.csv", 100.0, 110.0);
  writeFlight(folder / "b.csv", 150.0, 160.0);
  writeFlight(folder / "c.csv", 120.0, 130.0, 500.0);  // another line of the same flight
  const auto flight = readTrajectoryFiles({folder}, {});
  ASSERT_EQ(flight.samples.size(), 33U);
  EXPECT_EQ(flight.samples[11].position.y(), 500.0);
}

TEST_F(TrajectoryFiles, WeekSecondsAndAbsoluteTimesMeet) {
  writeFlight(folder / "week.csv", 100.0, 110.0);
  writeFlight(folder / "gps.csv", 200.0, 210.0, 0.0, 2254 * 604800.0);
  const auto flight = readTrajectoryFiles({folder}, {});
  EXPECT_EQ(flight.samples.front().time, 100.0);
  EXPECT_EQ(flight.samples.back().time, 210.0);
  writeFlight(folder / "other.csv", 300.0, 310.0, 0.0, 2260 * 604800.0);
  EXPECT_NE(refusal({folder}).find("another GPS week"), std::string::npos);
}

TEST_F(TrajectoryFiles, BadListsAreRefused) {
  writeFlight(folder / "a.csv", 100.0, 110.0);
  EXPECT_NE(refusal({folder / "a.csv", folder / "a.csv"}).find("given twice"), std::string::npos);
  const fs::path empty = folder / "empty";
  fs::create_directory(empty);
  EXPECT_NE(refusal({empty}).find("holds no trajectory"), std::string::npos);
  EXPECT_NE(refusal({folder / "a.csv", folder / "none.csv"}).find("there is no such file"),
            std::string::npos);
}

TEST_F(TrajectoryFiles, FactsNeedNoProjection) {
  std::ofstream(folder / "a.txt") << "GPSTime Lat Lon H-Ell Roll Pitch Heading\n"
                                     "100 40 9 500 1 2 3\n100.5 40 9 500 1 2 3\n";
  const TrajectoryFacts facts = inspectTrajectory(folder / "a.txt", {});
  EXPECT_EQ(facts.samples, 2U);
  EXPECT_TRUE(facts.attitude);
  EXPECT_EQ(facts.time_kind, "seconds of the GPS week");
  EXPECT_EQ(facts.median_step, 0.5);
  EXPECT_NE(facts.frame.find("datum not stated: WGS 84 (ITRF) assumed"), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
