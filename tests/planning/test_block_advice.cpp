// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/planning/block_advice.h>

#include "simulated_survey.h"

namespace pcl_als {
namespace {

TEST(DescribeObservability, OfACalibratedBlockNamesFactsAndDeterminedDirections) {
  auto options = simulation::SimulationOptions::preset("small", 1.0, 0.3);
  options.noise = simulation::NoiseOptions::named("range");
  const test::SimulatedSurvey survey(options);
  test::SimulatedSurvey::Request request;
  request.settings.selection.point_budget = 200'000;
  request.settings.candidates = 10'000;
  request.control = survey.control;
  request.rigorous = true;
  const auto calibration = survey.loaded(request);
  EXPECT_TRUE(
      describeObservability(*calibration, CalibrationResult()).empty());  // not yet adjusted
  const CalibrationResult result = calibration->calibrate();
  const std::vector<std::string> lines = describeObservability(*calibration, result);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.front().find("opposite lines"), std::string::npos) << lines.front();

  const ObservedBlock block = observedBlock(calibration->adjusted(), *calibration->trajectory());
  ASSERT_EQ(block.strips.size(), survey.strips.size());
  // A sample of the pairs of the last adjustment.
  EXPECT_GT(block.observationCount(), kRepresentative / 2);
  EXPECT_LT(block.observationCount(), 2 * kRepresentative);
  EXPECT_GT(block.control_points, 0U);
}

}  // namespace
}  // namespace pcl_als
