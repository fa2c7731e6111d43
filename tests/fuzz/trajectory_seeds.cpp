// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Small trajectories of every format but SBET, written by hand from their descriptions.
#include "fuzz_seeds.h"
#include "trajectory_bytes.h"

namespace pcl_als::fuzz {

std::vector<std::string> exportSeeds() {
  return {// Inertial Explorer: lines before the header, units below it.
          "Project: a\nProgram: Inertial Explorer\n\nGPSTime Latitude Longitude H-Ell Roll Pitch "
          "Heading SDEast SDNorth SDHeight\n(sec) (deg) (deg) (m) (deg) (deg) (deg) (m) (m) (m)\n"
          "400825.0 37.7 -119.1 3000.5 0.1 -0.2 359 0.01 0.01 0.02\n"
          "400825.005 37.7 -119.1001 3000.5 0.1 -0.2 359 0.01 0.01 0.02\n",
          // Degrees, minutes and seconds; a GPS week and UTC.
          "UTCTime,Week,Lat,Lon,Height,Roll,Pitch,Yaw\n1000,2300,47 12 30.5,8 30 1.25,900,1,2,3\n"
          "1000.5,2300,47 12 30.6,8 30 1.26,900,1,2,3\n",
          "# TerraPOS\n# Time X-ECEF Y-ECEF Z-ECEF\n1 4000000 600000 4900000\n2 4000060 600000 "
          "4900000\n",
          "Time;Easting;Northing;Height [m];roll_rad;pitch_rad;heading_gon\n1;2;3;4;0.1;0.1;200\n",
          // 2026-11-23, found by fuzz_trajectory_csv: a comment without text and a field of blanks
          // were null pointers.
          "#\n# *\n, \t,\ntime x y z\n1 2 3 4\n2 3 4 5\n", "1 2 3 4 5 6 7\n2 3 4 5 6 7 8\n"};
}

std::vector<std::string> terrascanSeeds() {
  return {test::terrascanTrajectory(3)};
}

std::vector<std::string> smrmsgSeeds() {
  test::Bytes records;
  for (int i = 0; i < 3; ++i) {
    records.f64(400825.0 + i).f64(0.02).f64(0.02).f64(0.03);
    for (int k = 0; k < 3; ++k) records.f64(0.001);
    records.f64(0.2).f64(0.2).f64(0.5);
  }
  return {records.str()};
}

std::vector<std::string> pofSeeds() {
  test::PofBytes day, week;
  week.minor = 0, week.unit = 2, week.system = 1;
  return {day.str(), week.str()};
}

std::vector<std::string> poqSeeds() {
  return {test::poqBytes(3, 1), test::poqBytes(2, 0)};
}

std::vector<std::string> solSeeds() {
  return {test::solBytes(3)};
}

}  // namespace pcl_als::fuzz
