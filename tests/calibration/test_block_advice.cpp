// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <string>

#include <gtest/gtest.h>

#include "block_advice.h"
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
  const SurveyBlock chosen = survey.block(request);
  EXPECT_TRUE(describeObservability(chosen, BlockCalibration()).empty());  // without pairs
  const BlockCalibration calibration = survey.calibrate(chosen);
  const std::vector<std::string> lines = describeObservability(chosen, calibration);
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines.front().find("opposite lines"), std::string::npos) << lines.front();

  const ObservedBlock block = observedBlock(calibration.adjusted, chosen.trajectory());
  ASSERT_EQ(block.strips.size(), survey.strips.size());
  // A sample of the pairs of the last adjustment.
  EXPECT_GT(block.observationCount(), kRepresentative / 2);
  EXPECT_LT(block.observationCount(), 2 * kRepresentative);
  EXPECT_GT(block.control_points, 0U);
}

}  // namespace
}  // namespace pcl_als
