// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Attitudes of trajectory files whose axes the course shows.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/processing/trajectory_loading.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

enum class As { heading, yaw_from_east, quaternion_ned, quaternion_enu };
constexpr double kPitch = 2.5, kRoll = -1.5, kCrab = 3.0;  // degrees

Eigen::Quaterniond quaternionAbout(int axis, double degrees) {
  return Eigen::Quaterniond(
      Eigen::AngleAxisd(degrees * kRadiansPerDegree, Eigen::Vector3d::Unit(axis)));
}

std::string attitudeOf(double heading, As as) {
  char text[160];
  if (as == As::heading || as == As::yaw_from_east) {
    std::snprintf(text, sizeof text, "%.12f,%.12f,%.12f", kRoll, kPitch,
                  as == As::heading ? heading : 90.0 - heading);
    return text;
  }
  const bool ned = as == As::quaternion_ned;
  const Eigen::Quaterniond q = quaternionAbout(2, ned ? heading : 90.0 - heading) *
                               quaternionAbout(1, ned ? kPitch : -kPitch) *
                               quaternionAbout(0, kRoll);
  std::snprintf(text, sizeof text, "%.15f,%.15f,%.15f,%.15f", q.w(), q.x(), q.y(), q.z());
  return text;
}

/// The names of the attitude's columns.
std::string namesOf(As as) {
  if (as == As::heading) return "roll,pitch,heading";
  return as == As::yaw_from_east ? "roll,pitch,yaw" : "qw,qx,qy,qz";
}

/// A line of 20 s at 60 m/s on the map, from a time on.
fs::path onMap(const fs::path& path, As as, double course, double start) {
  std::ofstream out(path);
  out << "time,x,y,z," << namesOf(as) << '\n';
  for (int i = 0; i < 200; ++i) {
    const double way = 6.0 * i, c = course * kRadiansPerDegree;
    char record[120];
    std::snprintf(record, sizeof record, "%.1f,%.4f,%.4f,900,", start + 0.1 * i,
                  5e5 + way * std::sin(c), 5e6 + way * std::cos(c));
    out << record << attitudeOf(course - kCrab, as) << '\n';
  }
  return path;
}

TrajectoryLoadingOptions options() {
  TrajectoryLoadingOptions options;
  options.keep_samples = true;
  return options;
}

void expectEqualFlights(const LoadedTrajectory& flight, const LoadedTrajectory& other) {
  ASSERT_EQ(flight.samples.size(), other.samples.size());
  for (std::size_t i = 0; i < flight.samples.size(); ++i) {
    const TrajectorySample &a = flight.samples[i], &b = other.samples[i];
    EXPECT_EQ(a.time, b.time);
    EXPECT_NEAR((a.position - b.position).norm(), 0.0, 1e-6);
    EXPECT_NEAR(a.roll, b.roll, 1e-9);
    EXPECT_NEAR(a.pitch, b.pitch, 1e-9);
    EXPECT_NEAR(std::remainder(a.heading - b.heading, 2.0 * kPi), 0.0, 1e-9);
  }
}

bool remarks(const LoadedTrajectory& flight, const std::string& text) {
  return std::any_of(flight.remarks.begin(), flight.remarks.end(), [&](const std::string& remark) {
    return remark.find(text) != std::string::npos;
  });
}

TEST(LoadedTrajectory, TakesEveryFormOfAnAttitudeAsTheSame) {
  const fs::path folder = test::scratch("flight_file");
  for (const double course : {12.0, 101.0, 192.0, 303.0}) {
    const LoadedTrajectory plain =
        loadTrajectory(onMap(folder / "p.csv", As::heading, course, 1e5), options());
    for (const As as : {As::yaw_from_east, As::quaternion_ned, As::quaternion_enu}) {
      const LoadedTrajectory flight =
          loadTrajectory(onMap(folder / "f.csv", as, course, 1e5), options());
      expectEqualFlights(flight, plain);
      EXPECT_TRUE(flight.trajectory->hasAttitude());
      EXPECT_TRUE(remarks(flight, as == As::quaternion_ned ? "to north, east, down, as the course"
                                  : as == As::quaternion_enu
                                      ? "to east, north, up, as the course"
                                      : "yaw is counter-clockwise from east"));
    }
  }
}

TEST(LoadedTrajectory, JoinsFilesOfDifferentForms) {
  const fs::path folder = test::scratch("flight_file_forms");
  const auto flown = [&](As first, As second, As third) {
    return loadTrajectory({onMap(folder / "1.csv", first, 12.0, 1e5),
                           onMap(folder / "2.csv", second, 101.0, 1e5 + 100.0),
                           onMap(folder / "3.csv", third, 192.0, 1e5 + 200.0)},
                          options());
  };
  const LoadedTrajectory plain = flown(As::heading, As::heading, As::heading);
  expectEqualFlights(flown(As::heading, As::yaw_from_east, As::quaternion_enu), plain);
  expectEqualFlights(flown(As::quaternion_ned, As::heading, As::yaw_from_east), plain);
}

TEST(LoadedTrajectory, AsksForAxesThatTheCourseDoesNotShow) {
  const fs::path folder = test::scratch("flight_file_undecided");
  const fs::path path = onMap(folder / "diagonal.csv", As::quaternion_enu, 47.0, 1e5);
  try {
    loadTrajectory(path, options());
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_EQ(error.hint(), Hint::axes);
    EXPECT_NE(std::string(error.what())
                  .find("diagonal.csv: the course does not show whether its "
                        "quaternions turn the body to north, east, down"),
              std::string::npos)
        << error.what();
  }
  const LoadedTrajectory plain =
      loadTrajectory(onMap(folder / "p.csv", As::heading, 47.0, 1e5), options());
  TrajectoryLoadingOptions stated = options();
  stated.axes = AttitudeAxes::enu;
  expectEqualFlights(loadTrajectory(path, stated), plain);
  // Where no attitude is used, none is needed, and none is passed on.
  TrajectoryLoadingOptions positions = options();
  positions.attitude = AttitudeUse::ignore;
  const LoadedTrajectory flight = loadTrajectory(path, positions);
  EXPECT_FALSE(flight.samples.front().hasAttitude());
  EXPECT_EQ(flight.samples.size(), 200U);
  // Another file of the flight shows what this one does not.
  const fs::path north = onMap(folder / "north.csv", As::quaternion_enu, 2.0, 1e5 + 100.0);
  EXPECT_TRUE(loadTrajectory({path, north}, options()).trajectory->hasAttitude());
}

TEST(LoadedTrajectory, StatedAxesOfAYawAreKept) {
  const fs::path path =
      onMap(test::scratch("flight_file_stated") / "f.csv", As::yaw_from_east, 12.0, 1e5);
  TrajectoryLoadingOptions stated = options();
  stated.axes = AttitudeAxes::ned;
  EXPECT_NEAR(loadTrajectory(path, stated).samples[0].heading,
              (90.0 - 12.0 + kCrab) * kRadiansPerDegree, 1e-9);
}

TEST(LoadedTrajectory, IsInspectedWithTheAxesOfTheCourse) {
  const fs::path folder = test::scratch("flight_file_facts");
  const auto facts = [](const fs::path& path, AttitudeAxes axes) {
    TrajectoryReading reading;
    reading.axes = axes;
    return inspectFlight({path}, reading).at(0).second;
  };
  for (const As as : {As::heading, As::yaw_from_east, As::quaternion_ned, As::quaternion_enu}) {
    const auto found = facts(onMap(folder / "f.csv", as, 101.0, 1e5), AttitudeAxes::by_course);
    EXPECT_NEAR(found.local[3].heading, (101.0 - kCrab) * kRadiansPerDegree, 1e-9);
    EXPECT_NEAR(found.local[3].pitch, kPitch * kRadiansPerDegree, 1e-9);
    EXPECT_EQ(found.axes.empty(), as == As::heading);
    EXPECT_EQ(found.attitude_form, AttitudeForm::heading);
  }
  const fs::path diagonal = onMap(folder / "d.csv", As::quaternion_enu, 47.0, 1e5);
  EXPECT_EQ(facts(diagonal, AttitudeAxes::by_course).attitude_form, AttitudeForm::quaternion);
  const auto stated = facts(diagonal, AttitudeAxes::enu);
  EXPECT_EQ(stated.attitude_form, AttitudeForm::heading);
  EXPECT_NEAR(stated.local[3].heading, (47.0 - kCrab) * kRadiansPerDegree, 1e-9);
}

#ifdef PCL_ALS_HAVE_PROJ

/// The same in latitude and longitude, where headings count from true north.
fs::path onEllipsoid(const fs::path& path, As as, double course) {
  std::ofstream out(path);
  out << "time,lat,lon,h," << namesOf(as) << '\n';
  constexpr double kMetresPerDegree = 111e3;
  for (int i = 0; i < 200; ++i) {
    const double way = 6.0 * i / kMetresPerDegree, c = course * kRadiansPerDegree;
    char record[120];
    std::snprintf(record, sizeof record, "%.1f,%.10f,%.10f,900,", 1e5 + 0.1 * i,
                  47.0 + way * std::cos(c),
                  6.2 + way * std::sin(c) / std::cos(47.0 * kRadiansPerDegree));
    out << record << attitudeOf(course - kCrab, as) << '\n';
  }
  return path;
}

// 2026-11: the convergence was added to the yaw before this became a heading, which gave it the
// wrong sign: 4.1 degrees here, 2.8 degrees of longitude west of the central meridian.
TEST(LoadedTrajectory, TurnsEveryFormToGridNorth) {
  const fs::path folder = test::scratch("flight_file_north");
  TrajectoryLoadingOptions in_utm = options();
  in_utm.crs = "EPSG:32632";
  const double convergence = -2.8 * std::sin(47.0 * kRadiansPerDegree);  // degrees
  for (const double course : {20.0, 110.0, 250.0}) {
    const LoadedTrajectory plain =
        loadTrajectory(onEllipsoid(folder / "p.csv", As::heading, course), in_utm);
    const double turned = plain.samples[0].heading - (course - kCrab) * kRadiansPerDegree;
    EXPECT_NEAR(turned / kRadiansPerDegree, -convergence, 0.01);
    for (const As as : {As::yaw_from_east, As::quaternion_ned, As::quaternion_enu})
      expectEqualFlights(loadTrajectory(onEllipsoid(folder / "f.csv", as, course), in_utm), plain);
    TrajectoryLoadingOptions stated = in_utm;
    stated.axes = AttitudeAxes::enu;
    expectEqualFlights(
        loadTrajectory(onEllipsoid(folder / "f.csv", As::quaternion_enu, course), stated), plain);
  }
}

#endif

}  // namespace
}  // namespace pcl_als
