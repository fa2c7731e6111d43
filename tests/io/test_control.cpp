// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

std::filesystem::path file(const std::string& text) {
  const auto path = test::scratch("control") / "control.csv";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string refusal(const std::string& text) {
  try {
    readControl(file(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Control, ReadsPointsWithoutSigma) {
  const auto points =
      readControl(file("id,x,y,z\nGCP 01,700777.23,5660698.408,1055.3258\n2,1,2,3\n"));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].id, "GCP 01");
  EXPECT_EQ(points[0].position, Eigen::Vector3d(700777.23, 5660698.408, 1055.3258));
  EXPECT_EQ(points[0].sigma, 0.0);
}

TEST(Control, ReadsSigmaInAnyColumnOrder) {
  const auto points = readControl(file("z;sigma;id;y;x\n3;0.02;a;2;1\n4;;b;2;1\n"));
  EXPECT_EQ(points[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(points[0].sigma, 0.02);
  EXPECT_EQ(points[1].sigma, 0.0);
}

TEST(Control, ErrorsNameLineAndColumn) {
  EXPECT_NE(refusal("id,x,y\na,1,2\n").find("no column 'z'"), std::string::npos);
  EXPECT_NE(refusal("id,x,y,z\na,1,2,high\n").find("line 2, column 'z': 'high'"),
            std::string::npos);
  EXPECT_NE(refusal("id,x,y,z\n,1,2,3\n").find("column 'id'"), std::string::npos);
  EXPECT_NE(refusal("id,x,y,z,sigma\na,1,2,3,1e160\n").find("must not exceed 100 m"),
            std::string::npos);
  EXPECT_NE(refusal("id,x,y,z,sigma\na,1,2,3,-1\n").find("must not be negative"),
            std::string::npos);
  EXPECT_NE(refusal("id,x,y,z\n").find("no control points"), std::string::npos);
  EXPECT_NE(refusal("").find("is empty"), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
