// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Attitudes that text trajectories give as quaternions.
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

constexpr double kHalf = 0.70710678118654752;  // sine and cosine of 45 degrees
const double kC5 = std::cos(5.0 * kRadiansPerDegree), kS5 = std::sin(5.0 * kRadiansPerDegree);
const double kC15 = std::cos(15.0 * kRadiansPerDegree), kS15 = std::sin(15.0 * kRadiansPerDegree);

std::filesystem::path quaternionFile(const std::string& text) {
  const auto path = test::scratch("quaternions") / "flight.txt";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

TrajectoryReading axes(AttitudeAxes stated) {
  TrajectoryReading reading;
  reading.axes = stated;
  return reading;
}

/// The sample of a file with one record, \a wxyz.
TrajectorySample sampleOf(const std::array<double, 4>& wxyz, AttitudeAxes stated) {
  char record[200];
  std::snprintf(record, sizeof record, "1 2 3 4 %.17g %.17g %.17g %.17g\n", wxyz[1], wxyz[2],
                wxyz[3], wxyz[0]);
  const auto path = quaternionFile(std::string("timestamp tx ty tz qx qy qz qw\n") + record);
  return readTrajectoryFile(path, axes(stated)).samples.at(0);
}

/// Angles in degrees, the heading in [0, 360).
void expectAngles(const TrajectorySample& sample, double roll, double pitch, double heading) {
  constexpr double kNear = 1e-12;
  EXPECT_NEAR(sample.roll, roll * kRadiansPerDegree, kNear);
  EXPECT_NEAR(sample.pitch, pitch * kRadiansPerDegree, kNear);
  EXPECT_NEAR(std::remainder(sample.heading - heading * kRadiansPerDegree, 2.0 * kPi), 0.0, kNear);
  EXPECT_GE(sample.heading, 0.0);
  EXPECT_LE(sample.heading, 2.0 * kPi);
}

// Half angles: a turn about one axis by t is cos(t/2) with sin(t/2) in its part.
TEST(Quaternions, OfNorthEastDown) {
  const struct {
    std::array<double, 4> wxyz;
    double roll, pitch, heading;
  } rows[] = {
      {{1, 0, 0, 0}, 0, 0, 0},
      {{kHalf, 0, 0, kHalf}, 0, 0, 90},
      {{0, 0, 0, 1}, 0, 0, 180},
      {{kHalf, 0, 0, -kHalf}, 0, 0, 270},
      {{kC15, 0, 0, kS15}, 0, 0, 30},
      {{kC15, kS15, 0, 0}, 30, 0, 0},
      {{kC5, 0, kS5, 0}, 0, 10, 0},
      {{kC5, 0, -kS5, 0}, 0, -10, 0},
      // (1 + k) (C + S j) / sqrt(2) = (C - S i + S j + C k) / sqrt(2), as k j = -i.
      {{kHalf * kC15, -kHalf * kS15, kHalf * kS15, kHalf * kC15}, 0, 30, 90},
      // (1 + k) (C + S i) / sqrt(2) = (C + S i + S j + C k) / sqrt(2), as k i = j.
      {{kHalf * kC15, kHalf * kS15, kHalf * kS15, kHalf * kC15}, 30, 0, 90},
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(testing::Message() << row.roll << ' ' << row.pitch << ' ' << row.heading);
    expectAngles(sampleOf(row.wxyz, AttitudeAxes::ned), row.roll, row.pitch, row.heading);
    const auto& q = row.wxyz;
    expectAngles(sampleOf({-q[0], -q[1], -q[2], -q[3]}, AttitudeAxes::ned), row.roll, row.pitch,
                 row.heading);
  }
}

TEST(Quaternions, OfEastNorthUp) {
  const struct {
    std::array<double, 4> wxyz;
    double roll, pitch, heading;
  } rows[] = {
      {{1, 0, 0, 0}, 0, 0, 90},            // forward is east
      {{kHalf, 0, 0, kHalf}, 0, 0, 0},     // a quarter to the left: north
      {{0, 0, 0, 1}, 0, 0, 270},           // west
      {{kHalf, 0, 0, -kHalf}, 0, 0, 180},  // a quarter to the right: south
      {{kC15, kS15, 0, 0}, 30, 0, 90},     // left wing up
      {{kC5, 0, kS5, 0}, 0, -10, 90},      // about the left wing: nose down
  };
  for (const auto& row : rows) {
    SCOPED_TRACE(testing::Message() << row.roll << ' ' << row.pitch << ' ' << row.heading);
    expectAngles(sampleOf(row.wxyz, AttitudeAxes::enu), row.roll, row.pitch, row.heading);
  }
}

// The directions of the body's axes tell the angles without any formula of them.
TEST(Quaternions, TurnTheBodyAsTheAnglesDo) {
  for (int heading = 15; heading < 360; heading += 30) {
    for (const double pitch : {-20.0, 3.0}) {
      for (const double roll : {-40.0, 2.0, 100.0}) {
        const double h = heading * kRadiansPerDegree, p = pitch * kRadiansPerDegree,
                     r = roll * kRadiansPerDegree;
        // East, north, up of the nose, and of the right wing: level, then rolled about the nose.
        const Eigen::Vector3d nose(std::cos(p) * std::sin(h), std::cos(p) * std::cos(h),
                                   std::sin(p));
        const Eigen::Vector3d level(std::cos(h), -std::sin(h), 0.0);
        const Eigen::Vector3d right = std::cos(r) * level + std::sin(r) * nose.cross(level);
        Eigen::Matrix3d enu, ned;
        enu << nose, -right, nose.cross(-right);
        const auto down = [](const Eigen::Vector3d& v) {
          return Eigen::Vector3d(v.y(), v.x(), -v.z());
        };
        ned << down(nose), down(right), down(nose.cross(right));
        const Eigen::Quaterniond e(enu), n(ned);
        SCOPED_TRACE(testing::Message() << roll << ' ' << pitch << ' ' << heading);
        expectAngles(sampleOf({e.w(), e.x(), e.y(), e.z()}, AttitudeAxes::enu), roll, pitch,
                     heading);
        expectAngles(sampleOf({n.w(), n.x(), n.y(), n.z()}, AttitudeAxes::ned), roll, pitch,
                     heading);
      }
    }
  }
}

TEST(Quaternions, AreFoundByTheNamesInUse) {
  for (const char* names :
       {"time,x,y,z,qw,qx,qy,qz", "Time;X;Y;Z;Q0;Q1;Q2;Q3",
        "# timestamp tx ty tz Quat_W Quat_X Quat_Y Quat_Z",
        "time\tx\ty\tz\tquaternion.w\tquaternion.x\tquaternion.y\tquaternion.z"}) {
    const char separator = std::string(names).find_first_of(",;\t") == std::string::npos
                               ? ' '
                               : names[std::string(names).find_first_of(",;\t")];
    std::string record = "1,2,3,4,0,0,0,1\n";
    for (char& c : record) c = c == ',' ? separator : c;
    const TrajectoryFile flight =
        readTrajectoryFile(quaternionFile(std::string(names) + "\n" + record));
    ASSERT_EQ(flight.samples.size(), 1U) << names;
    EXPECT_EQ(flight.attitude, AttitudeForm::quaternion) << names;
    EXPECT_EQ(flight.samples[0].position, Eigen::Vector3d(2, 3, 4)) << names;
    expectAngles(flight.samples[0], 0, 0, 180);
    // What the caller states is not open.
    EXPECT_EQ(readTrajectoryFile(quaternionFile(std::string(names) + "\n" + record),
                                 axes(AttitudeAxes::ned))
                  .attitude,
              AttitudeForm::heading);
  }
}

TEST(Quaternions, YieldToRollPitchAndHeading) {
  const TrajectoryFile both = readTrajectoryFile(
      quaternionFile("time,x,y,z,roll,pitch,heading,qw,qx,qy,qz\n1,2,3,4,1,2,3,1,0,0,0\n"));
  EXPECT_EQ(both.attitude, AttitudeForm::heading);
  expectAngles(both.samples[0], 1, 2, 3);
  const TrajectoryFile part =
      readTrajectoryFile(quaternionFile("time,x,y,z,heading,qw,qx,qy,qz\n1,2,3,4,33,0,0,0,1\n"));
  EXPECT_EQ(part.attitude, AttitudeForm::quaternion);
  expectAngles(part.samples[0], 0, 0, 180);
  // A column q1 alone is something else, such as a quality.
  EXPECT_FALSE(readTrajectory(quaternionFile("time,x,y,z,q1\n1,2,3,4,7\n"))[0].hasAttitude());
}

TEST(Quaternions, AreNormalised) {
  expectAngles(sampleOf({0.95 * kC5, 0, 0.95 * kS5, 0}, AttitudeAxes::ned), 0, 10, 0);
  expectAngles(sampleOf({0.71, 0, 0, 0.71}, AttitudeAxes::ned), 0, 0, 90);
}

TEST(Quaternions, OfAnotherNormAreRefusedWithTheirLine) {
  const std::string head = "time,x,y,z,qw,qx,qy,qz\n0,2,3,4,1,0,0,0\n";
  const struct {
    const char *record, *norm;
  } rows[] = {{"1,2,3,4,0,0,0,0\n", "is 0, not 1"},
              {"1,2,3,4,1,1,0,0\n", "is 1.414, not 1"},
              {"1,2,3,4,0,30,40,0\n", "is 50, not 1"},
              {"1,2,3,4,1e300,1e300,0,0\n", "is inf, not 1"}};
  for (const auto& row : rows) {
    const std::string message =
        test::messageOf<InputError>([&] { readTrajectory(quaternionFile(head + row.record)); });
    EXPECT_NE(message.find("flight.txt: line 3: the norm of its quaternion"), std::string::npos)
        << message;
    EXPECT_NE(message.find(row.norm), std::string::npos) << message;
  }
  EXPECT_NE(test::messageOf<InputError>([&] {
              readTrajectory(quaternionFile("time,x,y,z,qw,qx,qz\n1,2,3,4,1,0,0\n"));
            }).find("no column 'qy'"),
            std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([&] {
              readTrajectory(quaternionFile("time,x,y,z,qw,qx,qy,qz\n1,2,3,4,1,0,0,a\n"));
            }).find("line 2, column 'qz': 'a' is not a number"),
            std::string::npos);
}

TEST(Quaternions, ThatLackAreUnknownAttitudes) {
  const auto samples = readTrajectory(
      quaternionFile("time,x,y,z,qw,qx,qy,qz\n1,2,3,4,,,,\n2,2,3,4,nan,0,0,1\n3,2,3,4,1,0,0,0\n"));
  EXPECT_FALSE(samples[0].hasAttitude());
  EXPECT_FALSE(samples[1].hasAttitude());
  EXPECT_TRUE(samples[2].hasAttitude());
}

}  // namespace
}  // namespace pcl_als
