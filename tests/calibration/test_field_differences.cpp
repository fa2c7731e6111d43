// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "field_differences.h"

namespace pcl_als {
namespace {

using Pairs = std::vector<std::vector<FieldPair>>;
constexpr double kHeight = 1000.0;  // metres
constexpr double kHalfAngle = 0.35;

/// Pairs on planes of random slope across the swath of a scanner flown north. Errors of one area
/// are correlated: the two values were measured some moments apart.
Pairs simulatedPairs(double roll_arcsec, double range, unsigned seed, double shared = 0.003) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Pairs pairs(32);
  for (std::vector<FieldPair>& area : pairs) {
    const double x = kHeight * std::tan(kHalfAngle) * uniform(random),
                 drift = shared * normal(random);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d up =
          Eigen::Vector3d(0.3 * uniform(random), 0.3 * uniform(random), 1.0).normalized();
      // The right of the flight is east. A roll moves a point by (z, 0, -x), a range bias along the
      // pulse, away from the sensor: both written out here by hand.
      const double length = std::hypot(x, kHeight);
      const Eigen::Vector3d rolled(-kHeight, 0.0, -x), farther(x / length, 0.0, -kHeight / length);
      FieldPair pair;
      pair.value = 1;
      pair.row =
          up.transpose() * designBlock(ScanGeometry{x, 0.0, -kHeight, -std::atan2(x, kHeight)});
      pair.variance = 0.0004;
      pair.distance = up.dot(rolled) * roll_arcsec * kRadiansPerArcsec + up.dot(farther) * range +
                      drift + 0.02 * normal(random);
      area.push_back(pair);
    }
  }
  return pairs;
}

ErrorFinding findingOf(const std::string& source, const Pairs& pairs) {
  const ComparedValues values{PointField::user_data, 0, {1}};
  const ScanGeometry edge{kHeight * std::tan(kHalfAngle), 0.0, -kHeight, -kHalfAngle};
  for (const ErrorFinding& finding : fieldDifferences(values, pairs, edge))
    if (finding.source == source) return finding;
  ADD_FAILURE() << "no " << source;
  return {};
}

TEST(FieldDifferences, RollOfASecondScanner) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const ErrorFinding roll =
        findingOf("user_data1_boresight_roll", simulatedPairs(20.0, 0.0, seed));
    EXPECT_GT(roll.probability, 0.99);
    EXPECT_TRUE(roll.determined);
    EXPECT_NEAR(roll.value, 20.0, 4.0 * roll.std);
    EXPECT_LT(roll.std, 2.0);
    EXPECT_EQ(roll.title,
              "boresight roll of points with user data 1 against points with user data 0");
  }
}

TEST(FieldDifferences, SignAndSizeOfARangeDifference) {
  const ErrorFinding range = findingOf("user_data1_range_bias", simulatedPairs(0.0, -0.04, 1));
  EXPECT_GT(range.probability, 0.99);
  EXPECT_NEAR(range.value, -0.04, 4.0 * range.std);
}

/// Errors that are constant in an area are no difference of the instrument.
TEST(FieldDifferences, NothingIsFoundWhereThereIsNone) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const ComparedValues values{PointField::scanner_channel, 0, {1}};
    const ScanGeometry edge{kHeight * std::tan(kHalfAngle), 0.0, -kHeight, -kHalfAngle};
    for (const ErrorFinding& finding :
         fieldDifferences(values, simulatedPairs(0.0, 0.0, seed, 0.02), edge))
      EXPECT_LT(finding.probability, 0.9) << seed << " " << finding.source << " " << finding.value;
  }
}

TEST(FieldDifferences, ValuesThatAreCompared) {
  const auto compared = [](const std::map<int, std::size_t>& counts) {
    return comparedValues(PointField::user_data, counts);
  };
  EXPECT_TRUE(compared({{0, 1000}}).others.empty());
  EXPECT_TRUE(compared({{0, 1000}, {7, 5}}).others.empty());  // few points
  const ComparedValues two = compared({{0, 400}, {3, 600}});
  EXPECT_EQ(two.reference, 3);
  EXPECT_EQ(two.others, std::vector<int>{0});
  std::map<int, std::size_t> many;
  for (int value = 0; value < 40; ++value) many[value] = 100;
  EXPECT_TRUE(compared(many).others.empty());
}

}  // namespace
}  // namespace pcl_als
