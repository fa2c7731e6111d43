// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/quality/swath_separation.h>

#include "swath_scenes.h"

namespace pcl_als {
namespace {

using test::Flight;
using test::fly;
using test::kOrigin;

SwathSeparation gridOf(std::size_t strips) {
  return {
      RasterGrid::covering(kOrigin.x(), kOrigin.y(), kOrigin.x() + 60.0, kOrigin.y() + 60.0, 2.0),
      strips};
}

void add(SwathSeparation& separation, int strip, const std::vector<LidarReturn>& points) {
  for (const LidarReturn& point : points) separation.add(strip, point);
}

TEST(SwathSeparation, SlopesSeparateNothing) {
  // 31 degrees; cell means lie up to half a metre aside of each other: 0.3 m if it counted.
  const auto slope = [](double x, double y) { return 0.5 * x + 0.33 * y; };
  Flight sparse;
  sparse.spacing = 0.9;
  sparse.seed = 2;
  sparse.shift.z() = -0.06;
  SwathSeparation separation = gridOf(2);
  add(separation, 0, fly(slope, {}, kOrigin));
  add(separation, 1, fly(slope, sparse, kOrigin));
  const RasterGrid& grid = separation.grid();
  const auto cells = separation.rows(0, grid.rows);
  int seen = 0;
  for (int row = 2; row < 28; ++row) {
    for (int column = 2; column < 28; ++column) {
      const auto& cell = cells[grid.index(column, row)];
      ASSERT_EQ(cell.strips, 2);
      EXPECT_NEAR(cell.separation, 0.06, 0.004);  // coordinates in mm; heights as float, 8 um
      ++seen;
    }
  }
  EXPECT_EQ(seen, 26 * 26);
}

TEST(SwathSeparation, LargestDifferenceOfSeveralStrips) {
  const auto flat = [](double, double) { return 0.0; };
  SwathSeparation separation = gridOf(3);
  for (int strip = 0; strip < 3; ++strip) {
    Flight flight;
    flight.shift.z() = strip == 1 ? 0.10 : strip == 2 ? -0.05 : 0.0;
    flight.seed = static_cast<unsigned>(strip + 1);
    add(separation, strip, fly(flat, flight, kOrigin));
  }
  const auto cells = separation.rows(15, 1);
  EXPECT_EQ(cells[15].strips, 3);
  EXPECT_NEAR(cells[15].separation, 0.15, 1e-3);
}

TEST(SwathSeparation, LastReturnsOnlyAndNothingThatIsExcluded) {
  SwathSeparation separation = gridOf(1);
  LidarReturn point;
  point.position = kOrigin + Eigen::Vector3d(30.0, 30.0, 5.0);
  point.intensity = 100.0F;
  separation.add(0, point);
  point.position.z() += 10.0;
  point.return_number = 1;
  point.number_of_returns = 2;
  separation.add(0, point);  // not a last return
  point.number_of_returns = 1;
  point.classification = 7;
  separation.add(0, point);
  point.classification = 0;
  point.position.x() += 1000.0;
  separation.add(0, point);  // beside the grid
  const auto cells = separation.rows(0, separation.grid().rows);
  int strips = 0;
  for (const auto& cell : cells) {
    strips += cell.strips;
    if (cell.strips > 0) {
      EXPECT_EQ(cell.intensity, 100.0F);
    }
  }
  EXPECT_EQ(strips, 1);
}

TEST(SwathSeparation, WhereACellHoldsAStepTheNearestReturnCounts) {
  // A kerb of 3 m through the middle of cells at x = 31: means would mix both levels.
  const auto step = [](double x, double) { return x < 31.3 ? 0.0 : 3.0; };
  Flight sparse;
  sparse.spacing = 0.7;
  sparse.seed = 2;
  SwathSeparation separation = gridOf(2);
  add(separation, 0, fly(step, {}, kOrigin));
  add(separation, 1, fly(step, sparse, kOrigin));
  int wrong = 0;
  for (int row = 1; row < 29; ++row)
    wrong += separation.rows(row, 1)[15].separation > 0.08F ? 1 : 0;
  EXPECT_LE(wrong, 9);  // of 28; the two nearest returns lie on different sides now and then
}

TEST(SwathSeparation, BreaksOfTheSpecification) {
  EXPECT_EQ(separationColour(0.08F, 0.0800001), SeparationColour::green);
  EXPECT_EQ(separationColour(0.081F, 0.08), SeparationColour::yellow);
  EXPECT_EQ(separationColour(0.161F, 0.08), SeparationColour::red);
  EXPECT_EQ(separationColour(0.081F, 0.04), SeparationColour::red);
}

TEST(SwathSeparation, PixelsAreColourOverIntensity) {
  const SwathSeparation::Stretch stretch{0.0F, 200.0F};
  SwathSeparation::Cell cell;
  EXPECT_EQ(separationPixel(cell, stretch, 0.08).alpha, 0);
  cell.strips = 1;
  cell.intensity = 100.0F;
  SeparationPixel pixel = separationPixel(cell, stretch, 0.08);
  EXPECT_EQ(pixel.red, 128);  // 127.5: grey
  EXPECT_EQ(pixel.red, pixel.green);
  EXPECT_EQ(pixel.red, pixel.blue);
  cell.strips = 2;
  cell.separation = 1.0F;
  pixel = separationPixel(cell, stretch, 0.08);
  EXPECT_EQ(pixel.red, 191);   // (255 + 127.5) / 2
  EXPECT_EQ(pixel.green, 64);  // 127.5 / 2
  cell.separation = 0.1F;
  EXPECT_EQ(separationPixel(cell, stretch, 0.08).green, 191);
}

}  // namespace
}  // namespace pcl_als
