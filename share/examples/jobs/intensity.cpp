// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// intensity TRAJECTORY FOLDER STRIP…: corrects intensities and estimates the gains of strips.
#include <exception>
#include <filesystem>
#include <iostream>

#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/radiometry/atmosphere.h>

int main(int argc, char** argv) try {
  const std::vector<std::string> strips(argv + 3, argv + argc);
  std::vector<std::string> outputs;
  for (const std::string& strip : strips)
    outputs.push_back(argv[2] / std::filesystem::path(strip).filename());
  pcl_als::Atmosphere air;  // of the day of the flight
  air.visibility_km = 48.3, air.temperature_c = 29.8, air.pressure_kpa = 101.81;
  pcl_als::IntensityOptions options;
  options.settings.model.extinction_per_km = pcl_als::extinctionOf(air).total();
  options.settings.overlaps.estimate_gains = true;
  const auto flight = pcl_als::loadTrajectory(argv[1]).trajectory;
  const auto corrected = pcl_als::correctIntensity(strips, outputs, flight, options);
  for (std::size_t i = 0; i < corrected.strips.size(); ++i)
    std::cout << corrected.strips[i] << ' ' << corrected.gains[i] << '\n';
  return corrected.unreliable.empty() ? 0 : 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
