// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include "field_differences.h"

namespace pcl_als {
namespace {

std::vector<int> valuesOf(const ValueCounts& counts, PointField field = PointField::user_data) {
  return FieldDivision::of(field, counts).values;
}

TEST(FieldDifferences, ValuesThatAreCompared) {
  EXPECT_TRUE(valuesOf({{1, {{0, 1000}}}}).empty());
  EXPECT_TRUE(valuesOf({{1, {{0, 1000}, {7, 5}}}}).empty());  // few points
  EXPECT_EQ(valuesOf({{1, {{0, 400}, {3, 600}}}, {2, {{0, 100}}}}), (std::vector<int>{0, 3}));
  // Every strip has a value of its own, such as the number of the flight.
  EXPECT_TRUE(valuesOf({{1, {{0, 1000}}}, {2, {{1, 1000}}}}).empty());
  ValueCounts many;
  for (int value = 0; value < 40; ++value) many[1][value] = 100;
  EXPECT_TRUE(valuesOf(many).empty());
}

/// The mirror of a polygon turns one way; a few points at the ends of lines seem to go back.
TEST(FieldDifferences, DirectionsOfAnOscillatingMirror) {
  const PointField direction = PointField::scan_direction;
  EXPECT_EQ(valuesOf({{1, {{-1, 480}, {0, 20}, {1, 500}}}}, direction), (std::vector<int>{-1, 1}));
  EXPECT_TRUE(valuesOf({{1, {{-1, 80}, {1, 920}}}}, direction).empty());
  EXPECT_TRUE(valuesOf({{1, {{0, 1000}}}}, direction).empty());  // recorded
}

TEST(FieldDifferences, StripsAreDivided) {
  FieldDivision division;
  division.values = {2, 5};
  EXPECT_EQ(division.nameOf(1), "channel5");
  EXPECT_EQ(division.partOf(3, 1), 7);
  EXPECT_EQ(division.repeated(std::vector<double>{0.5, 1.5}),
            (std::vector<double>{0.5, 0.5, 1.5, 1.5}));
  EXPECT_EQ(division.pairs({{0, 1}}, {0, 1}),
            (std::vector<StripPair>{{0, 1}, {2, 3}, {0, 2}, {0, 3}, {1, 2}, {1, 3}}));
  const StripSystems systems = division.systems(2);
  EXPECT_EQ(systems.count, 2);
  EXPECT_EQ(systems.system, (std::vector<int>{0, 1, 0, 1}));
  EXPECT_EQ(systems.pass, (std::vector<int>{0, 0, 2, 2}));
}

}  // namespace
}  // namespace pcl_als
