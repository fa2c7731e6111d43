// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

/// Writes \a text to a file of its own.
std::filesystem::path csvFile(const std::string& text) {
  const auto path = test::scratch("trajectory_csv") / "trajectory.csv";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// The message of the InputError that reading \a text gives.
std::string refusalOfTable(const std::string& text) {
  return test::messageOf<InputError>([&] { readTrajectory(csvFile(text)); });
}

void expectTwoSamples(const std::vector<TrajectorySample>& samples) {
  ASSERT_EQ(samples.size(), 2U);
  EXPECT_EQ(samples[0].time, 401000.005);
  EXPECT_EQ(samples[0].position, Eigen::Vector3d(700402.3197, 5661069.72, -2.5));
  EXPECT_EQ(samples[1].time, 401000.01);
  EXPECT_EQ(samples[1].position.x(), 1e5);
}

TEST(TrajectoryCsv, ReadsWithoutAttitude) {
  const auto samples = readTrajectory(
      csvFile("time,x,y,z\n401000.005,700402.3197,5661069.72,-2.5\n401000.01,1e5,2,3\n"));
  expectTwoSamples(samples);
  EXPECT_FALSE(samples[0].hasAttitude());
}

TEST(TrajectoryCsv, AnglesBecomeRadians) {
  const auto samples = readTrajectory(
      csvFile("heading,time,pitch,x,y,z,roll,comment\n270,1,-1,10,20,30,2,fine day\n"));
  ASSERT_EQ(samples.size(), 1U);
  EXPECT_EQ(samples[0].position, Eigen::Vector3d(10, 20, 30));
  EXPECT_DOUBLE_EQ(samples[0].heading, 1.5 * kPi);
  EXPECT_DOUBLE_EQ(samples[0].pitch, -kPi / 180.0);
  EXPECT_DOUBLE_EQ(samples[0].roll, kPi / 90.0);
}

TEST(TrajectoryCsv, AcceptsEverySeparatorAndLineEnd) {
  for (const std::string separator : {",", ";", "\t", " ", "   ", " , "}) {
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      std::string text = "Time,\"X\",y,Z";
      text += end + "401000.005,700402.3197,5661069.72,-2.5" + end + "401000.01,+1e5,2,3" + end;
      std::string replaced;
      for (const char c : text) replaced += c == ',' ? separator : std::string(1, c);
      expectTwoSamples(readTrajectory(csvFile(replaced)));
    }
  }
}

// 2026-11: headers as they are delivered were refused; only time,x,y,z,roll,pitch,heading were
// known.
TEST(TrajectoryCsv, AcceptsTheNamesInUse) {
  for (const std::string header :
       {"GpsTime,Easting,Northing,Height,Roll,Pitch,Azimuth",
        "\"GPS Time (s)\",East,North,Elevation [m],Roll [deg],Pitch [deg],Heading [deg]",
        "gps_time,X,Y,Alt,ROLL,PITCH,HDG", "sow,X_m,Y_m,Altitude_m,roll_deg,pitch_deg,yaw_deg"}) {
    const auto samples = readTrajectory(csvFile(header + "\n1,10,20,30,2,-1,270\n"));
    ASSERT_EQ(samples.size(), 1U) << header;
    EXPECT_EQ(samples[0].time, 1.0) << header;
    EXPECT_EQ(samples[0].position, Eigen::Vector3d(10, 20, 30)) << header;
    EXPECT_DOUBLE_EQ(samples[0].roll, kPi / 90.0) << header;
    EXPECT_DOUBLE_EQ(samples[0].pitch, -kPi / 180.0) << header;
    EXPECT_DOUBLE_EQ(samples[0].heading, 1.5 * kPi) << header;
  }
}

TEST(TrajectoryCsv, TakesRadiansWhereTheNameSaysSo) {
  const auto samples = readTrajectory(
      csvFile("time,x,y,z,roll_rad,Pitch (rad),heading[radians]\n1,2,3,4,0.1,0.2,3\n"));
  EXPECT_EQ(samples[0].roll, 0.1);
  EXPECT_EQ(samples[0].pitch, 0.2);
  EXPECT_EQ(samples[0].heading, 3.0);
}

TEST(TrajectoryCsv, SaysWhichColumnsItTook) {
  EXPECT_EQ(readTrajectoryFile(csvFile("time,X,Y,z\n1,2,3,4\n")).columns, "");
  const TrajectoryFile taken = readTrajectoryFile(csvFile("GpsTime,Y,X,Z,Yaw\n1,20,10,4,5\n"));
  EXPECT_EQ(taken.columns, "columns: time from GpsTime, heading from Yaw");
  EXPECT_EQ(taken.attitude, AttitudeForm::yaw);
  EXPECT_EQ(taken.samples[0].position, Eigen::Vector3d(10, 20, 4));  // Y stands before X
  EXPECT_EQ(readTrajectoryFile(csvFile("time,x,y,z,azimuth\n1,2,3,4,5\n")).attitude,
            AttitudeForm::heading);
}

TEST(TrajectoryCsv, SkipsByteOrderMarkCommentsAndEmptyLines) {
  expectTwoSamples(
      readTrajectory(csvFile("\xEF\xBB\xBF# made by hand\n\ntime,x,y,z\n# first\n"
                             "401000.005,700402.3197,5661069.72,-2.5,\n\n401000.01,1e5,2,3")));
  for (const std::string mark : {"#", "%", "//", "% ", "// "}) {
    SCOPED_TRACE(mark);
    const std::string records =
        "401000.005 700402.3197 5661069.72 -2.5\n401000.01 1e5 2 3\n" + mark + "the end\n";
    expectTwoSamples(readTrajectory(csvFile(mark + "flight 7\ntime x y z\n" + records)));
    expectTwoSamples(readTrajectory(csvFile(mark + "time x y z\n" + records)));
    EXPECT_NE(refusalOfTable(mark + "flight 7\n" + records).find("line 2 holds 4 numbers"),
              std::string::npos);
  }
}

TEST(TrajectoryCsv, UnknownAttitudeIsNan) {
  const auto samples =
      readTrajectory(csvFile("time,x,y,z,roll,pitch,heading\n1,2,3,4,nan,,5\n2,2,3,4,1,2,3\n"));
  EXPECT_FALSE(samples[0].hasAttitude());
  EXPECT_TRUE(samples[1].hasAttitude());
}

TEST(TrajectoryCsv, KeepsFileOrder) {
  const auto samples = readTrajectory(csvFile("time,x,y,z\n3,0,0,0\n1,0,0,0\n2,0,0,0\n"));
  EXPECT_EQ(samples[0].time, 3.0);
  EXPECT_EQ(samples[1].time, 1.0);
}

TEST(TrajectoryCsv, RunsOnAcrossTheEndOfTheWeek) {
  const auto samples = readTrajectory(csvFile("time,x,y,z\n604799.5,0,0,0\n0,0,0,0\n0.5,0,0,0\n"));
  EXPECT_EQ(samples[0].time, 604799.5);
  EXPECT_EQ(samples[1].time, 604800.0);
  EXPECT_EQ(samples[2].time, 604800.5);
}

TEST(TrajectoryCsv, ErrorsNameFileLineAndColumn) {
  const struct {
    const char *text, *expected;
  } cases[] = {
      {"", "is empty"},
      {"# only a comment\n", "is empty"},
      {"time,x,y,z\n", "has a header but no records"},
      {"time,x,z\n1,2,3\n", "line 1: no column 'y' in the header 'time,x,z'"},
      {"time,x,y,z,Azimuth,yaw\n1,2,3,4,5,6\n",
       "columns 'Azimuth' and 'yaw' both name the heading"},
      {"time,x,y,z,Height\n1,2,3,4,5\n", "columns 'z' and 'Height' both name the z"},
      {"time,x (ft),y,z\n1,2,3,4\n", "column 'x (ft)': the unit ft is not supported"},
      {"a,x,y,z\n1,2,3,4\n", "accepted names (in any case): time, gps_time, "},
      {"time,x,y,x\n1,2,3,4\n", "line 1: column 'x' appears twice"},
      {"0,5,5,3\n1,6,5,3\n",
       "line 1 holds 4 numbers, but the file has no header line: name the columns"},
      {"\n# flight 7\n0 5 6 3 1 2 nan\n", "line 3 holds 7 numbers, but the file has no header"},
      {"0;5;6;3;\n", "line 1 holds 4 numbers, but the file has no header"},
      {"2020-01-02,5,6,3\n",
       "no column 'time' in the header '2020-01-02,5,6,3'; is the line with "
       "the names of the columns missing?; accepted names"},
      {"time,x,y,z\n1,2,3,4\n2,2,abc,4\n", "line 3, column 'y': 'abc' is not a number"},
      {"time,x,y,z\n1,2,3,4m\n", "line 2, column 'z': '4m' is not a number"},
      {"time;x;y;z\n1;2,5;3;4\n", "line 2, column 'x': '2,5' is not a number"},
      {"time,x,y,z\n#\n1,2,,4\n", "line 3, column 'y': '' is not a number"},
      {"time,x,y,z\n1,2,3\n", "line 2: 3 column(s), the header has 4"},
      {"time,x,y,z\n1,2,3,4,5\n", "line 2: 5 column(s), the header has 4"},
      {"time,x,y,z\nnan,2,3,4\n", "line 2, column 'time': 'nan' is not a finite number"},
      {"time,x,y,z\n1,inf,3,4\n", "line 2, column 'x': 'inf' is not a finite number"},
      {"time,x,y,z\n1,1e999,3,4\n", "line 2, column 'x': '1e999' is not a number"},
      {"time,x,y,z,roll\n1,2,3,4,-inf\n", "column 'roll': '-inf' is not a finite number"},
  };
  for (const auto& row : cases) {
    const std::string message = refusalOfTable(row.text);
    EXPECT_NE(message.find(row.expected), std::string::npos) << row.expected << " / " << message;
    EXPECT_NE(message.find("trajectory.csv: "), std::string::npos) << message;
  }
}

TEST(TrajectoryCsv, BytesThatAreNoTextAreQuotedSafely) {
  const std::string message = refusalOfTable("time,x,y,z\n1,2,\x01\x02\x1b[31m,4\n");
  EXPECT_NE(message.find("'??"), std::string::npos) << message;
  EXPECT_NE(refusalOfTable(std::string("time,x\n\0,4\n", 11)).find("zero byte"), std::string::npos);
}

TEST(TrajectoryCsv, MissingFileAndFolderAreNamed) {
  const auto folder = test::scratch("trajectory_csv_folder");
  EXPECT_THROW(readTrajectory(folder), InputError);
  EXPECT_THROW(readTrajectory(folder / "none.csv"), InputError);
}

TEST(TrajectoryCsv, ReadsTheTitanTrajectories) {
  const auto path = test::testData("real/titan/position_attitude.txt");
  const auto full = test::testData("real/titan/attitude_200hz.txt");
  PCL_ALS_REQUIRE_DATA(path);
  PCL_ALS_REQUIRE_DATA(full);
  const auto samples = readTrajectory(*path);
  EXPECT_EQ(samples[0].time, 407107.0);
  EXPECT_EQ(samples[0].position, Eigen::Vector3d(276252.047, 3289429.249, 541.019));
  EXPECT_FALSE(samples[0].hasAttitude());       // no roll
  const auto attitude = readTrajectory(*full);  // Y before X
  EXPECT_EQ(attitude[0].position, Eigen::Vector3d(276318.006408, 3289429.723912, 538.873527));
  EXPECT_DOUBLE_EQ(attitude[0].heading, -90.494178 * kRadiansPerDegree);
}

TEST(TrajectoryCsv, ReadsTheHeliosTrajectory) {
  const auto path = test::testData("helios/trajectory.csv");
  PCL_ALS_REQUIRE_DATA(path);
  const auto samples = readTrajectory(*path);
  EXPECT_GT(samples.size(), 10000U);
  EXPECT_EQ(samples[0].position, Eigen::Vector3d(700402.3211, 5661070.0, 2212.5018));
  EXPECT_DOUBLE_EQ(samples[0].heading, 179.3794220 * kRadiansPerDegree);
}

}  // namespace
}  // namespace pcl_als
