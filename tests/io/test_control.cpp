// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

std::filesystem::path controlFile(const std::string& text) {
  const auto path = test::scratch("control") / "control.csv";
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

std::string refusalOfControl(const std::string& text) {
  return test::messageOf<InputError>([&] { readControl(controlFile(text)); });
}

TEST(Control, ReadsPointsWithoutSigma) {
  const auto points =
      readControl(controlFile("id,x,y,z\nGCP 01,700777.23,5660698.408,1055.3258\n2,1,2,3\n"));
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].id, "GCP 01");
  EXPECT_EQ(points[0].position, Eigen::Vector3d(700777.23, 5660698.408, 1055.3258));
  EXPECT_EQ(points[0].sigma, 0.0);
}

TEST(Control, ReadsSigmaInAnyColumnOrder) {
  const auto points = readControl(controlFile("z;sigma;id;y;x\n3;0.02;a;2;1\n4;;b;2;1\n"));
  EXPECT_EQ(points[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(points[0].sigma, 0.02);
  EXPECT_EQ(points[1].sigma, 0.0);
}

TEST(Control, ReadsPlanarPatches) {
  const auto points = readControl(controlFile(
      "id,x,y,z,sigma,nx,ny,nz,extent\nroof,1,2,3,0.01,0,-3,-4,2.5\nground,1,2,3,0.02,,,,\n"));
  EXPECT_EQ(points[0].kind, ControlPoint::Kind::patch);
  EXPECT_TRUE(points[0].normal.isApprox(Eigen::Vector3d(0.0, 0.6, 0.8)));  // upward, of length 1
  EXPECT_EQ(points[0].extent, 2.5);
  EXPECT_EQ(points[1].kind, ControlPoint::Kind::height);
  EXPECT_EQ(readControl(controlFile("id,x,y,z,nx,ny,nz\na,1,2,3,0,0,1\n"))[0].extent, 2.0);
  EXPECT_NE(refusalOfControl("id,x,y,z,nx,ny,nz\na,1,2,3,0,,1\n").find("all of nx, ny and nz"),
            std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z,nx,ny,nz\na,1,2,3,1,0,0\n").find("at most 60 degrees"),
            std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z,nx,ny,nz,extent\na,1,2,3,0,0,1,-1\n").find("above 0"),
            std::string::npos);
}

TEST(Control, ReadsTargets) {
  const std::string header = "id,x,y,z,sigma,diameter,sigma_plan\n";
  const auto points =
      readControl(controlFile(header + "T1,1,2,3,0.01,2,0.02\nT2,1,2,3,0.01,1.5,\nG,1,2,3,,,\n"));
  EXPECT_EQ(points[0].kind, ControlPoint::Kind::target);
  EXPECT_EQ(points[0].diameter, 2.0);
  EXPECT_EQ(points[0].sigma_plan, 0.02);
  EXPECT_EQ(points[1].kind, ControlPoint::Kind::target);
  EXPECT_EQ(points[1].sigma_plan, 0.0);
  EXPECT_EQ(points[2].kind, ControlPoint::Kind::height);
  const LengthUnit feet = lengthUnitNamed("ft", "control");
  const auto in_feet = readControl(controlFile(header + "T1,1,2,3,0.01,5,0.02\n"), feet);
  EXPECT_NEAR(in_feet[0].diameter, 1.524, 1e-12);
  EXPECT_NEAR(in_feet[0].sigma_plan, 0.006096, 1e-12);
  EXPECT_NE(refusalOfControl(header + "T1,1,2,3,,0.05,\n").find("line 2, column 'diameter'"),
            std::string::npos);
  EXPECT_NE(refusalOfControl(header + "T1,1,2,3,,25,\n").find("must be 0.1 to 20 m"),
            std::string::npos);
  EXPECT_NE(refusalOfControl(header + "T1,1,2,3,,2,-1\n").find("must not be negative"),
            std::string::npos);
  EXPECT_NE(refusalOfControl(header + "T1,1,2,3,,,0.02\n").find("needs its diameter"),
            std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z,nx,ny,nz,diameter\nT1,1,2,3,0,0,1,2\n")
                .find("a normal or a diameter"),
            std::string::npos);
}

TEST(Control, ErrorsNameLineAndColumn) {
  EXPECT_NE(refusalOfControl("id,x,y\na,1,2\n").find("no column 'z'"), std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z\na,1,2,high\n").find("line 2, column 'z': 'high'"),
            std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z\n,1,2,3\n").find("column 'id'"), std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z,sigma\na,1,2,3,1e160\n").find("must not exceed 100 m"),
            std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z,sigma\na,1,2,3,-1\n").find("must not be negative"),
            std::string::npos);
  EXPECT_NE(refusalOfControl("id,x,y,z\n").find("no control points"), std::string::npos);
  EXPECT_NE(refusalOfControl("").find("is empty"), std::string::npos);
}

// 2026-11: the numbers of the first line were taken for names of columns.
TEST(Control, AsksForAMissingHeader) {
  EXPECT_NE(refusalOfControl("1,5,5,3\n2,6,5,3\n")
                .find("control.csv: line 1 holds 4 numbers, but the file has no header line"),
            std::string::npos);
  EXPECT_NE(refusalOfControl("# made by hand\n1;5;5;3;\n").find("line 2 holds 4 numbers"),
            std::string::npos);
  for (const char* text : {"GCP01,700223.687,5659983.470,990.548\n", "GCP01,5,5,3\n"}) {
    EXPECT_NE(refusalOfControl(text).find("is the line with the names of the columns missing?"),
              std::string::npos)
        << refusalOfControl(text);
  }
  EXPECT_EQ(refusalOfControl("id,x,y\na,1,2\n").find("missing?"), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
