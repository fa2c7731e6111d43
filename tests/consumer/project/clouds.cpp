// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// clouds STRIP…: the lines of programs.md on clouds in memory, for the strips, trajectory.csv and
// control.csv of a block; run.sh compares the lines and the result. Writes the clouds as PCD files.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>

#include <pcl_als/calibration/system_calibration.h>
#include <pcl_als/filters/overlap_selection.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/delivery_check.h>
#include <pcl_als/processing/trajectory_loading.h>

int main(int argc, char** argv) try {
  const auto strips = pcl_als::loadStrips({argv + 1, argv + argc});
  const auto trajectory = pcl_als::loadTrajectory("trajectory.csv").trajectory;
  pcl::PointCloud<pcl_als::PointLidar> common;
  // programs.md
  pcl_als::SystemCalibration<pcl_als::PointLidar> calibration;
  pcl_als::OverlapSelection<pcl_als::PointLidar> overlap;  // a pcl::FilterIndices
  overlap.setInputCloud(strips[0].cloud);
  overlap.setLocalFrame(strips[0].frame);
  overlap.addOtherStrip(strips[1].cloud, strips[1].frame);
  overlap.filter(common);
  for (const auto& strip : strips) calibration.addInputStrip(strip.cloud, strip.frame, strip.id);
  calibration.setTrajectory(trajectory);
  pcl_als::CalibrationOptions options;
  options.control = pcl_als::readControl("control.csv");
  calibration.setOptions(options);
  calibration.calibrate();
  pcl_als::writeCalibration("from_clouds.json", calibration.getResult());
  // end
  pcl_als::DeliveryCheck<pcl_als::PointLidar> check;
  for (const auto& strip : strips) {
    pcl_als::savePcd("cloud" + strip.id + ".pcd", strip);
    check.addInputStrip(strip.cloud, strip.frame, strip.id);
  }
  check.check();
  const pcl_als::CheckedPair& pair = check.getResult().pairs.front();
  std::cout << pair.a << " and " << pair.b << ": " << common.size() << " points of one in common, "
            << pair.assessment.normal.rms << " m RMS\n";
  const bool selected = !common.empty() && common.size() <= strips[0].cloud->size();
  return selected ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::cerr << "clouds: " << error.what() << '\n';
  return EXIT_FAILURE;
}
