// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Files written by hand from the descriptions of the exports of trajectory software.
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/trajectory_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

constexpr const char* kUtm32 = "EPSG:32632";

std::filesystem::path exportFile(const std::string& text) {
  const auto path = test::scratch("trajectory_exports") / "flight.txt";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

TrajectoryReading reading(const std::string& crs = {}) {
  TrajectoryReading reading;
  reading.crs = crs;
  return reading;
}

std::string refusalOfReading(const std::string& text, const TrajectoryReading& how) {
  return test::messageOf<Error>([&] { readTrajectoryFile(exportFile(text), how); });
}

const std::string kInertialExplorer =
    "Project:     flight\n"
    "Program:     Inertial Explorer Version 8.90\n"
    "Profile:     Lidar\n"
    "Source:      GNSS/INS Epochs(Smoothed TC Combined)\n"
    "\n"
    "Datum:       WGS84, (processing datum)\n"
    "Master 1:    Name base, Status ENABLED\n"
    "             Position 47 00 00.00000, 9 00 00.00000, 500.000 m (WGS84, Ellipsoidal hgt)\n"
    "\n";

/// A file of map coordinates with a date in a column of this name.
std::string dated(const std::string& name, const std::string& date, const std::string& time) {
  return name + ",UTCTime,X,Y,Z\n" + date + "," + time + ",500000,5600000,900\n" + date + "," +
         time + "1,500006,5600000,900\n";
}

// 2013-09-21 is the Saturday (day 6) of GPS week 1758; GPS time was 16 s ahead of UTC.
TEST(InertialExplorer, SecondsOfTheDayBesideADate) {
  constexpr double kTime = 1758 * 604800.0 + 6 * 86400.0 + 72007.5 + 16.0;
  for (const auto& [name, date] :
       std::vector<std::pair<std::string, std::string>>{{"Date", "2013/09/21"},
                                                        {"Date", "2013-09-21"},
                                                        {"Date", "20130921"},
                                                        {"Date", "21.09.2013"},
                                                        {"Date", "09/21/2013"},
                                                        {"Date(MDY)", "09/21/2013"},
                                                        {"Date(DMY)", "21/09/2013"}}) {
    const TrajectoryFile flight =
        readTrajectoryFile(exportFile(dated(name, date, "72007.5")), reading());
    EXPECT_NEAR(flight.samples.front().time, kTime, 1e-6) << name << " " << date;
    TrajectoryReading stated = reading();
    stated.leap_seconds = 16.0;
    EXPECT_NEAR(
        readTrajectoryFile(exportFile(dated(name, date, "72007.5")), stated).samples[0].time, kTime,
        1e-6);
  }
  // Seconds of the week beside a date.
  const TrajectoryFile week =
      readTrajectoryFile(exportFile(dated("Date", "2013-09-21", "590407.5")), reading());
  EXPECT_NEAR(week.samples.front().time, kTime, 1e-6);
  EXPECT_NE(refusalOfReading(dated("Date", "09/08/2013", "72007.5"), reading()).find("Date(YMD)"),
            std::string::npos);
  EXPECT_NE(
      refusalOfReading(dated("Date", "2013-09-20", "590407.5"), reading()).find("day of the week"),
      std::string::npos);
}

#ifdef PCL_ALS_HAVE_PROJ

/// 4 429 529.0302 m: the meridian arc from the equator to 40 degrees on WGS 84.
constexpr double kNorthing40 = 0.9996 * 4429529.0302;

TEST(InertialExplorer, DegreesMinutesSecondsBelowALineOfUnits) {
  const TrajectoryFile flight = readTrajectoryFile(
      exportFile(
          kInertialExplorer +
          "  GPSTime       Latitude        Longitude        H-Ell   Heading    Pitch     Roll  "
          "SDNorth SDEast SDHeight HdngSD PitchSD RollSD\n"
          "    (sec)   (+/-D M S)       (+/-D M S)          (m)     (deg)    (deg)    (deg)  "
          "(m) (m) (m) (arcmin) (arcmin) (arcmin)\n"
          "  1000.000  40 00 00.00000   9 00 00.00000   3000.000  45.00000  -1.00000  2.00000 "
          "0.01 0.02 0.03 1.2 0.6 0.3\n"
          "  1001.000  40 00 00.00000   9 00 00.00000   3000.500  45.00000  -1.00000  2.00000 "
          "0.01 0.02 0.03 1.2 0.6 0.3\n"),
      reading(kUtm32));
  ASSERT_EQ(flight.samples.size(), 2U);
  const TrajectorySample& sample = flight.samples[0];
  EXPECT_EQ(sample.time, 1000.0);
  EXPECT_NEAR(sample.position.x(), 500000.0, 1e-6);
  EXPECT_NEAR(sample.position.y(), kNorthing40, 1e-3);
  EXPECT_EQ(sample.position.z(), 3000.0);
  EXPECT_DOUBLE_EQ(sample.pitch, -kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(sample.roll, 2.0 * kRadiansPerDegree);
  EXPECT_NEAR(sample.heading, 0.25 * kPi, 1e-9);  // on the central meridian
  ASSERT_EQ(flight.accuracy.size(), 2U);
  EXPECT_EQ(flight.accuracy[1].position, Eigen::Vector3d(0.02, 0.01, 0.03));
  EXPECT_DOUBLE_EQ(flight.accuracy[1].angles.x(), 0.3 / 60.0 * kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(flight.accuracy[1].angles.z(), 1.2 / 60.0 * kRadiansPerDegree);
}

TEST(InertialExplorer, SouthAndWestAndTheWeek) {
  const TrajectoryFile flight = readTrajectoryFile(
      exportFile(
          kInertialExplorer +
          "Week     GPSTime     UTCTime   Longitude    Latitude    H-Ell  Heading  Pitch  Roll\n"
          "week       (sec)       (sec)       (deg)       (deg)      (m)    (deg)  (deg) (deg)\n"
          "2254  120974.000  120956.000   -0.0100000   -0.0100000   10.0   359.0    1.0  -2.0\n"),
      reading("EPSG:32731"));
  const TrajectorySample& sample = flight.samples.front();
  EXPECT_EQ(sample.time, 2254 * 604800.0 + 120974.0);  // the GPS column, not that of UTC
  EXPECT_LT(sample.position.x(), 500000.0);            // the central meridian is 3 degrees east
  EXPECT_NEAR(sample.position.y(), 1e7 - 1105.0, 2.0);
}

TEST(InertialExplorer, SignOfZeroDegreesCounts) {
  const std::string head = "GPSTime Latitude Longitude H-Ell\n(sec) (+/-D M S) (+/-D M S) (m)\n";
  const auto north =
      readTrajectoryFile(exportFile(head + "1 0 30 0.0 3 0 0.0 5\n"), reading(kUtm32));
  const auto south =
      readTrajectoryFile(exportFile(head + "1 -0 30 0.0 3 0 0.0 5\n"), reading(kUtm32));
  EXPECT_NEAR(north.samples[0].position.y(), -south.samples[0].position.y(), 1e-6);
  EXPECT_GT(north.samples[0].position.y(), 50000.0);
}

const std::string kPospac =
    "************************************************\n"
    " POS Export Utility\n"
    " Copyright (C) 1997-2018 by Applanix Corporation\n"
    "************************************************\n\n"
    " Mapping frame datum: WGS84  ; Mapping frame projection : TM;\n"
    " TIME, DISTANCE, EASTING, NORTHING, ELLIPSOID HEIGHT, LATITUDE, LONGITUDE, ELLIPSOID HEIGHT, "
    "ROLL, PITCH, HEADING, EAST VELOCITY, NORTH VELOCITY, UP VELOCITY, EAST SD, NORTH SD, HEIGHT "
    "SD, ROLL SD, PITCH SD, HEADING SD\n\n"
    "  (time in Sec, distance in Meters, position in Meters, lat, long in Degrees, orientation "
    "angles and SD in Degrees, velocity in Meter/Sec, position SD in Meters)  \n\n"
    "200000.005   0.0  111.0  222.0  333.0  40.0  9.0  3000.0  1.0  2.0  90.0  60.0 0.0 0.0  "
    "0.011 0.012 0.013 0.001 0.002 0.003\n";

TEST(Pospac, NamesWithCommasAndNumbersWithBlanks) {
  const TrajectoryFile flight = readTrajectoryFile(exportFile(kPospac), reading(kUtm32));
  ASSERT_EQ(flight.samples.size(), 1U);
  // Latitude and longitude, which need no projection to be known.
  EXPECT_NEAR(flight.samples[0].position.y(), kNorthing40, 1e-3);
  EXPECT_DOUBLE_EQ(flight.samples[0].pitch, 2.0 * kRadiansPerDegree);
  EXPECT_EQ(flight.accuracy[0].position, Eigen::Vector3d(0.011, 0.012, 0.013));
  EXPECT_DOUBLE_EQ(flight.accuracy[0].angles.z(), 0.003 * kRadiansPerDegree);
}

TEST(Terrapos, HeaderInAComment) {
  const TrajectoryFile flight = readTrajectoryFile(
      exportFile(
          "# Output from TerraPos\n#\n# Reference frame in navigation file:\n# ITRF2014\n# Week "
          "(GPS)\n# ToW (GPS)\n#---------------------------------------\n"
          "# Week       ToW (s)      Lat (deg)       Lon (deg)   Hght (m)    Roll(d)   Pitch(d)    "
          "Head(d)  sN (m)  sE (m)  sH (m)  sR (m)  #S    PDOP\n"
          "#---------------------------------------\n"
          " 1972  518430.000000   40.000000000     9.000000000    56.7994  1.0 2.0 90.0  5.300   "
          "5.895  10.821   0.1  6     3.5\n"),
      reading(kUtm32));
  ASSERT_EQ(flight.samples.size(), 1U);
  EXPECT_EQ(flight.samples[0].time, 1972 * 604800.0 + 518430.0);
  EXPECT_NEAR(flight.samples[0].position.y(), kNorthing40, 1e-3);
  EXPECT_EQ(flight.samples[0].position.z(), 56.7994);
  EXPECT_NEAR(flight.samples[0].heading, 0.5 * kPi, 1e-9);
  EXPECT_EQ(flight.accuracy[0].position, Eigen::Vector3d(5.895, 5.3, 10.821));
}

TEST(TrajectoryFrames, GeocentricCoordinates) {
  // Above the equator at 9 degrees east: radius a + h in the direction of the longitude.
  const double r = 6378137.0 + 1000.0, lon = 9.0 * kRadiansPerDegree;
  char record[100];
  std::snprintf(record, sizeof record, "1,%.6f,%.6f,0\n", r * std::cos(lon), r * std::sin(lon));
  const auto flight = readTrajectoryFile(
      exportFile(std::string("time,X-ECEF,Y-ECEF,Z-ECEF\n") + record), reading(kUtm32));
  EXPECT_NEAR(flight.samples[0].position.x(), 500000.0, 1e-4);
  EXPECT_NEAR(flight.samples[0].position.y(), 0.0, 1e-4);
  EXPECT_NEAR(flight.samples[0].position.z(), 1000.0, 1e-4);
}

TEST(TrajectoryFrames, AnotherZoneIsBroughtToThatOfThePoints) {
  TrajectoryReading how = reading("EPSG:32633");
  how.own_crs = kUtm32;
  // 12 degrees east, the limit of both zones: their eastings mirror each other at 500 km, their
  // grids differ by twice the convergence of 3 degrees times the sine of the latitude.
  const auto west = readTrajectoryFile(
      exportFile("time,lat,lon,h,heading,roll,pitch\n1,40,12,5,90,0,0\n"), reading(kUtm32));
  const Eigen::Vector3d p = west.samples[0].position;
  char record[100];
  std::snprintf(record, sizeof record, "1,%.6f,%.6f,5,0,0,90\n", p.x(), p.y());
  const auto east =
      readTrajectoryFile(exportFile(std::string("time,x,y,z,roll,pitch,heading\n") + record), how);
  EXPECT_NEAR(east.samples[0].position.x(), 1e6 - p.x(), 1e-3);
  EXPECT_NEAR(east.samples[0].position.y(), p.y(), 1e-3);
  const double convergence = 3.0 * kRadiansPerDegree * std::sin(40.0 * kRadiansPerDegree);
  EXPECT_NEAR(east.samples[0].heading - 0.5 * kPi, 2.0 * convergence, 2e-4);  // series: dl^3
}

TEST(TrajectoryFrames, TrueNorthOfMapCoordinatesIsStated) {
  const std::string text = "time,x,y,z,roll,pitch,heading\n1,300000,4400000,5,0,0,90\n";
  TrajectoryReading how = reading(kUtm32);
  const double grid = readTrajectoryFile(exportFile(text), how).samples[0].heading;
  how.north = NorthReference::true_north;
  const TrajectoryFile turned = readTrajectoryFile(exportFile(text), how);
  // West of the central meridian true north lies east of grid north.
  EXPECT_GT(turned.samples[0].heading - grid, 1.0 * kRadiansPerDegree);
  EXPECT_LT(turned.samples[0].heading - grid, 2.0 * kRadiansPerDegree);
  EXPECT_NE(turned.remarks[0].find("headings are from true north"), std::string::npos);
}

TEST(TrajectoryFrames, SaysHowHeightsAreTaken) {
  const auto flight = readTrajectoryFile(exportFile("time,lat,lon,h\n1,40,9,5\n"), reading(kUtm32));
  ASSERT_EQ(flight.remarks.size(), 1U);
  EXPECT_NE(flight.remarks[0].find("its heights are ellipsoidal; the CRS of the points has no "
                                   "vertical part"),
            std::string::npos);
  TrajectoryReading how = reading(kUtm32);
  how.geoid = "47.5";
  const auto lowered = readTrajectoryFile(exportFile("time,lat,lon,h\n1,40,9,5\n"), how);
  EXPECT_EQ(lowered.samples[0].position.z(), 5.0 - 47.5);
  how.geoid = "no_such_grid.gtx";
  EXPECT_THROW(readTrajectoryFile(exportFile("time,lat,lon,h\n1,40,9,5\n"), how), InputError);
}

TEST(TrajectoryFrames, HeightsAboveAGeoidStayAsTheyAre) {
  const auto flight =
      readTrajectoryFile(exportFile("time,lat,lon,H-MSL\n1,40,9,5\n"), reading(kUtm32));
  EXPECT_EQ(flight.samples[0].position.z(), 5.0);
  EXPECT_NE(flight.frame.find("height above a geoid"), std::string::npos);
}

#endif

TEST(TrajectoryFrames, AConstantUndulationIsSubtracted) {
  TrajectoryReading how;
  how.geoid = "47.5";
  EXPECT_EQ(readTrajectoryFile(exportFile("time,x,y,z\n1,2,3,100\n"), how).samples[0].position.z(),
            52.5);
}

TEST(NamedColumns, ReplaceTheHeader) {
  TrajectoryReading how;
  how.columns = {"time", "skip", "easting", "northing", "height", "roll", "pitch", "heading"};
  for (const std::string text : {"any words, of a header\n(s) (m)\n100.5,7,10,20,30,1,2,90\n",
                                 "100.5 7 10 20 30 1 2 90\n", "100.5;x;10;20;30;1;2;90\n"}) {
    const auto flight = readTrajectoryFile(exportFile(text), how);
    ASSERT_EQ(flight.samples.size(), 1U) << text;
    EXPECT_EQ(flight.samples[0].time, 100.5);
    EXPECT_EQ(flight.samples[0].position, Eigen::Vector3d(10, 20, 30));
    EXPECT_DOUBLE_EQ(flight.samples[0].heading, 0.5 * kPi);
  }
  EXPECT_NE(refusalOfReading("1,2,3,4,5,6,7,8,9\n", how).find("9 column(s), the header has 8"),
            std::string::npos);
  EXPECT_NE(refusalOfReading("1,2,3\n", how).find("no line has 8 columns"), std::string::npos);
  how.columns = {"time", "easting", "height"};
  EXPECT_NE(refusalOfReading("1,2,3\n", how).find("no column 'y'"), std::string::npos);
}

TEST(TrajectoryAngles, GonRadiansAndTheUnitOfTheCaller) {
  const std::string head = "time,x,y,z,roll,pitch,heading\n";
  TrajectoryReading how;
  how.angles = AngleUnit::gon;
  EXPECT_DOUBLE_EQ(
      readTrajectoryFile(exportFile(head + "1,2,3,4,0,0,100\n"), how).samples[0].heading,
      0.5 * kPi);
  how.angles = AngleUnit::radians;
  EXPECT_EQ(readTrajectoryFile(exportFile(head + "1,2,3,4,0,0,1.5\n"), how).samples[0].heading,
            1.5);
  // What a column states counts more.
  EXPECT_DOUBLE_EQ(readTrajectoryFile(exportFile("time,x,y,z,heading[gon]\n1,2,3,4,200\n"), how)
                       .samples[0]
                       .heading,
                   kPi);
}

TEST(TrajectoryAngles, AxesOfEastNorthUp) {
  TrajectoryReading how;
  how.axes = AttitudeAxes::enu;
  const auto sample =
      readTrajectoryFile(exportFile("time,x,y,z,roll,pitch,yaw\n1,2,3,4,1,2,0\n"), how).samples[0];
  EXPECT_DOUBLE_EQ(sample.roll, kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(sample.pitch, -2.0 * kRadiansPerDegree);
  EXPECT_DOUBLE_EQ(sample.heading, 0.5 * kPi);  // yaw 0 points east
}

TEST(TrajectoryTimes, UtcNeedsLeapSeconds) {
  const std::string text = "UTCTime,x,y,z\n100,2,3,4\n";
  TrajectoryReading how;
  EXPECT_NE(refusalOfReading(text, how).find("leap seconds"), std::string::npos);
  how.leap_seconds = 18.0;
  EXPECT_EQ(readTrajectoryFile(exportFile(text), how).samples[0].time, 118.0);
  // A GPS week gives them: 2254 is in 2023.
  EXPECT_EQ(
      readTrajectoryFile(exportFile("week,UTCTime,x,y,z\n2254,100,2,3,4\n"), TrajectoryReading())
          .samples[0]
          .time,
      2254 * 604800.0 + 118.0);
}

TEST(TrajectoryText, LinesBeforeTheHeaderAndUnitsInTheNames) {
  // As exported by tools for unmanned aircraft: words first, then the header.
  const auto flight = readTrajectoryFile(
      exportFile(
          "Trajectory of flight 3\nSoftware 4.2\n\nGPS time [s];Easting [m];Northing [m];Altitude "
          "[m];Roll [deg];Pitch [deg];Heading [deg]\n5;10;20;30;0;0;180\n"),
      TrajectoryReading());
  EXPECT_EQ(flight.samples[0].position, Eigen::Vector3d(10, 20, 30));
  EXPECT_DOUBLE_EQ(flight.samples[0].heading, kPi);
}

}  // namespace
}  // namespace pcl_als
