// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// calibrate TRAJECTORY CONTROL.csv CALIBRATION.json STRIP…: estimates the biases of a system.
#include <exception>
#include <iostream>

#include <pcl_als/calibration/survey_calibration.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/trajectory_loading.h>

int main(int argc, char** argv) try {
  pcl_als::SurveyReader survey({argv + 4, argv + argc});
  pcl_als::TrajectoryLoadingOptions reading;
  reading.crs = survey.reference().crs;  // of the points, for an SBET
  const auto flight = pcl_als::loadTrajectory(argv[1], reading).trajectory;
  pcl_als::CalibrationOptions options;
  options.control = pcl_als::readControl(argv[2]);
  const auto calibration = pcl_als::calibrateSurvey(survey, flight, options);
  pcl_als::writeCalibration(argv[3], calibration.result);
  std::cout << calibration.result.fullReport();
  return calibration.result.verdict.usable() ? 0 : 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
