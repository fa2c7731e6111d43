// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include "part_consistency.h"
#include "simulated_observations.h"

namespace pcl_als {
namespace {

/// Twenty areas in a row from west to east; \a extra: what scan_angle_scale of the eastern half has
/// in addition.
std::vector<PartDifference> differences(double extra, unsigned seed) {
  std::vector<AreaObservations> areas = simulated(someBiases(), 0.02, seed);
  for (std::size_t i = 10; i < areas.size(); ++i) {
    for (PairObservation& o : areas[i])
      o.misclosure += o.row()[indexOf(P::scan_angle_scale)] * extra;
  }
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, model());
  Adjustment whole(errors, 1);
  whole.accumulate(areas, unitWeights(areas));
  AreaAdjustment adjustment{whole, {}, {}, kSix};
  for (std::size_t i = 0; i < areas.size(); ++i) {
    adjustment.pairs.push_back(areas[i].size());
    adjustment.places.emplace_back(50.0 * static_cast<double>(i), 7.0 * static_cast<double>(i % 2));
  }
  return partDifferences(adjustment);
}

TEST(PartConsistency, HalvesOfOneSystemAgree) {
  int found = 0;
  for (unsigned seed = 0; seed < 50; ++seed)
    found += static_cast<int>(differences(0.0, seed).size());
  // Six parameters, two ways to halve: one in a hundred at 3.3 standard deviations.
  EXPECT_LE(found, 3);
}

// 2026-11: scan_angle_scale of a real block differed by 3.3 combined standard deviations between
// its halves, because its strips are bent.
TEST(PartConsistency, ADifferenceIsInTheStandardDeviation) {
  const std::vector<PartDifference> found = differences(2e-4, 3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].parameter, P::scan_angle_scale);
  EXPECT_NEAR(found[0].difference, 2e-4, 4.0 * found[0].std);
  EXPECT_NE(found[0].halves.find("eastern"), std::string::npos);
  CalibrationResult result;
  result[P::scan_angle_scale].status = ParameterStatus::estimated;
  result[P::scan_angle_scale].std = 0.5 * found[0].std;
  judgeParts(found, result);
  EXPECT_NEAR(result[P::scan_angle_scale].std, 0.5 * std::abs(found[0].difference), 1e-12);
  EXPECT_FALSE(result[P::scan_angle_scale].reason.empty());
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_EQ(result.warnings[0].hint, Hint::strips);
}

}  // namespace
}  // namespace pcl_als
