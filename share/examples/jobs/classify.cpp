// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// classify TRAINING.csv CHECKS.csv MAP.tif STRIP…: a map of the land cover and its accuracy.
#include <exception>
#include <iostream>

#include <pcl_als/io/class_io.h>
#include <pcl_als/processing/land_cover_job.h>
#include <pcl_als/report/accuracy_report.h>

int main(int argc, char** argv) try {
  pcl_als::LandCoverOptions options;
  options.training = pcl_als::readClassSites(argv[1]);
  options.checks = pcl_als::readClassSites(argv[2]);
  options.map = argv[3];
  const auto files = pcl_als::rasterInput({argv + 4, argv + argc});
  const auto classified = pcl_als::classifyLandCover(files, options);
  std::vector<std::string> names;
  for (const auto& each : classified.model->classes) names.push_back(each.name);
  const auto accuracy = pcl_als::assessSites(pcl_als::countSites(classified.checks.sites, names));
  std::cout << "overall accuracy " << accuracy.overall.value << '\n';
  return classified.undetermined.empty() ? 0 : 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
