// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// check STRIP…: how well overlapping strips fit each other, and whether the delivery keeps a
// quality level.
#include <exception>
#include <iostream>

#include <pcl_als/processing/check_delivery.h>
#include <pcl_als/processing/delivery_requirement.h>
#include <pcl_als/report/quality_report.h>

int main(int argc, char** argv) try {
  pcl_als::SurveyReader survey({argv + 1, argv + argc});
  pcl_als::QualityReport report;
  report.block = pcl_als::checkDelivery(survey, nullptr).block;
  report.quality_level = 2;  // of the USGS Lidar Base Specification
  std::cout << pcl_als::qualityText(report);
  return pcl_als::requireLevel(report.block, report.quality_level).kept ? 0 : 3;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
