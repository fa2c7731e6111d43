// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// The lines of the README and of programs.md; run.sh compares them.
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>

int main() {
  auto calibration = pcl_als::readCalibration("calibration.json");
  const pcl_als::SystemCorrection biases(calibration, pcl_als::readTrajectory("trajectory.csv"));
  for (pcl_als::Strip<>& strip : pcl_als::loadStrips({"strip1.las", "strip2.las"})) {
    pcl_als::SystemBiasCorrection<pcl_als::PointLidar> correction;  // a pcl::Filter
    correction.setCorrection(biases);
    correction.setLocalFrame(strip.frame);  // floats are relative to a double origin
    correction.setInputCloud(strip.cloud);
    correction.filter(*strip.cloud);
    pcl_als::savePcd("corrected" + strip.id + ".pcd", strip);
  }
}
