// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/survey/offset_from_block.h>

namespace pcl_als {
namespace {

using Box = Eigen::AlignedBox2d;
using Eigen::Vector2d;

Box around(double x, double y) {
  return {Vector2d(x - 500.0, y - 500.0), Vector2d(x + 500.0, y + 500.0)};
}

const Box kBlock = around(600000.0, 5700000.0);

std::string causeOf(const Box& given) {
  return OffsetFromBlock(given, kBlock).cause;
}

TEST(OffsetFromBlock, IsSilentWhereCoordinatesMeet) {
  const OffsetFromBlock place(around(600900.0, 5700000.0), kBlock);
  EXPECT_EQ(place.distance, 0.0);
  EXPECT_EQ(place.cause, "");
  EXPECT_EQ(OffsetFromBlock(Box(), kBlock).distance, 0.0);
}

TEST(OffsetFromBlock, NamesTheOnlyReason) {
  EXPECT_NE(causeOf(around(5700000.0, 600000.0)).find("x and y exchanged"), std::string::npos);
  EXPECT_NE(causeOf(around(600000.0 / 0.3048, 5700000.0 / 0.3048)).find("in feet"),
            std::string::npos);
  EXPECT_NE(causeOf(around(32600000.0, 5700000.0)).find("number of the zone"), std::string::npos);
  EXPECT_NE(causeOf({Vector2d(10.4, 51.4), Vector2d(10.5, 51.5)}).find("degrees"),
            std::string::npos);
  // A zone of 6 degrees at latitude 51.2: 6 * 111.3 km * cos(51.2 degrees) = 418 km.
  EXPECT_NE(causeOf(around(182000.0, 5710000.0)).find("6 degrees away"), std::string::npos);
  EXPECT_EQ(causeOf(around(650000.0, 5700000.0)), "");
}

TEST(OffsetFromBlock, StatesTheDistanceBetweenTheBoxes) {
  EXPECT_EQ(OffsetFromBlock(around(600000.0, 5701300.0), kBlock).text(), "300 m beside the strips");
  EXPECT_EQ(OffsetFromBlock(around(651000.0, 5700000.0), kBlock).text(),
            "50.0 km beside the strips");
}

}  // namespace
}  // namespace pcl_als
