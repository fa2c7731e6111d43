// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/plan_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

std::filesystem::path writePlan(const std::string& name, const std::string& text) {
  const auto path = test::scratch("plan_" + name) / name;
  std::ofstream(path) << text;
  return path;
}

TEST(FlightLines, AreReadByColumnName) {
  const auto path = writePlan("plan.csv",
                              "speed;height;id;y2;x2;y1;x1\n70;540;a;4;3;2;1\n"
                              ";1150;b;8;7;6;5\n");
  const auto lines = readFlightLines(path);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0].id, "a");
  EXPECT_EQ(lines[0].start, Eigen::Vector2d(1.0, 2.0));
  EXPECT_EQ(lines[0].end, Eigen::Vector2d(3.0, 4.0));
  EXPECT_EQ(lines[0].speed, 70.0);
  EXPECT_FALSE(lines[0].density.has_value());
  EXPECT_EQ(lines[1].height, 1150.0);
  EXPECT_FALSE(lines[1].speed.has_value());
}

TEST(ElevationGrid, HasNorthOnTopAndValuesAtCentres) {
  const char* header = "NCOLS 3\nNROWS 2\nXLLCORNER 100\nYLLCORNER 200\nCELLSIZE 10\n";
  const auto path =
      writePlan("grid.asc", std::string(header) + "NODATA_value -9999\n10 20 -9999\n0 10 20\n");
  const ElevationGrid grid = ElevationGrid::read(path);
  EXPECT_EQ(grid.columns(), 3U);
  EXPECT_EQ(grid.rows(), 2U);
  EXPECT_DOUBLE_EQ(grid.mean(), 12.0);
  Eigen::Vector2d gradient;
  ASSERT_TRUE(grid.at({105.0, 205.0}, gradient).has_value());
  EXPECT_DOUBLE_EQ(*grid.at({105.0, 205.0}, gradient), 0.0);  // the south-western cell
  EXPECT_DOUBLE_EQ(*grid.at({110.0, 210.0}, gradient), 10.0);
  EXPECT_DOUBLE_EQ(gradient.x(), 1.0);                          // uphill to the east
  EXPECT_DOUBLE_EQ(gradient.y(), 1.0);                          // and to the north
  EXPECT_FALSE(grid.at({118.0, 210.0}, gradient).has_value());  // beside a cell without a value
  EXPECT_FALSE(grid.at({104.0, 210.0}, gradient).has_value());
  EXPECT_FALSE(grid.at({NAN, 210.0}, gradient).has_value());
}

TEST(ElevationGrid, TakesCentresToo) {
  const auto path =
      writePlan("centre.asc", "ncols 2\nnrows 2\nxllcenter 0\nyllcenter 0\ncellsize 4\n1 2\n3 4\n");
  Eigen::Vector2d gradient;
  EXPECT_DOUBLE_EQ(*ElevationGrid::read(path).at({0.0, 0.0}, gradient), 3.0);
}

}  // namespace
}  // namespace pcl_als
