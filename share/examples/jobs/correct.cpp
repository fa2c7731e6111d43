// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// correct TRAJECTORY CALIBRATION.json FOLDER STRIP…: takes a calibration out of strips.
#include <exception>
#include <filesystem>
#include <iostream>

#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/processing/trajectory_loading.h>

int main(int argc, char** argv) try {
  const auto calibration = pcl_als::readCalibration(argv[2]);
  const auto flight =
      pcl_als::loadTrajectory(argv[1], pcl_als::trajectoryLoadingOptions(calibration)).trajectory;
  for (int i = 4; i < argc; ++i) {
    const std::filesystem::path strip = argv[i], output = argv[3] / strip.filename();
    const auto corrected = pcl_als::correctPointFile(strip, output, calibration, flight);
    std::cout << output.string() << ": " << corrected.points << " points\n";
  }
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
