// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/image_block_io.h>

#include "test_files.h"

namespace pcl_als {
namespace {

std::filesystem::path imageFile(const std::string& name, const std::string& text) {
  const auto path = test::scratch("image_block") / name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

FrameCamera pixels() {
  FrameCamera camera;
  camera.name = "survey";
  camera.focal_length = 100.5;
  camera.pixel_size = 0.006;
  camera.format = {54.0, 40.392};
  camera.principal_point = {0.021, -0.013};
  camera.radial = {2e-6, -6e-10, 1e-13};
  camera.tangential = {1.5e-7, -1e-7};
  return camera;
}

const std::string kCamera =
    R"({"format": "pcl_als camera", "version": 1, "focal_length_mm": 100.5,
 "principal_point_mm": [0.021, -0.013], "pixel_size_mm": 0.006, "image_size_px": [9000, 6732],
 "distortion": {"k1_per_mm2": 2e-6}})";

/// The refusal of a camera in which a part of the text is replaced.
std::string camera(const std::string& part, const std::string& with) {
  std::string text = kCamera;
  text.replace(text.find(part), part.size(), with);
  return test::messageOf<InputError>([&] { readCamera(imageFile("camera.json", text)); });
}

std::string images(const std::string& text) {
  return test::messageOf<InputError>([&] { readImages(imageFile("images.csv", text)); });
}

std::string measurements(const std::string& text, const FrameCamera& camera = pixels()) {
  return test::messageOf<InputError>(
      [&] { readMeasurements(imageFile("measurements.csv", text), camera, 0.0); });
}

std::string lines(const std::string& text) {
  return test::messageOf<InputError>([&] { readLines(imageFile("lines.csv", text)); });
}

void expectPart(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
}

TEST(ImageBlockIo, CamerasAreReadAsWritten) {
  const auto path = test::scratch("camera") / "camera.json";
  FrameCamera given = pixels();
  for (const bool millimetres : {false, true}) {
    if (millimetres) given.pixel_size = 0.0;
    writeCamera(path, given);
    const FrameCamera read = readCamera(path);
    EXPECT_EQ(read.name, given.name);
    EXPECT_EQ(read.focal_length, given.focal_length);
    EXPECT_LT((read.format - given.format).norm(), 1e-12);
    EXPECT_EQ(read.principal_point, given.principal_point);
    EXPECT_EQ(read.radial, given.radial);
    EXPECT_EQ(read.tangential, given.tangential);
    EXPECT_EQ(read.pixel_size, given.pixel_size);
  }
}

TEST(ImageBlockIo, CamerasThatCannotBeAreRefused) {
  expectPart(camera("pcl_als camera", "camera"), "is no camera");
  expectPart(camera("\"version\": 1", "\"version\": 2"), "'version' is not 1");
  expectPart(camera("100.5", "-100.5"), "'focal_length_mm' must be more than 0");
  expectPart(camera("100.5", "0.1005"), "is its unit mm?");
  expectPart(camera("[0.021, -0.013]", "[4500, 3366]"), "mm from the middle of the image");
  expectPart(camera("[0.021, -0.013]", "[0.021]"), "list of two numbers");
  expectPart(camera("principal_point_mm", "principal_point"), "is 'principal_point_mm' meant?");
  expectPart(camera("k1_per_mm2", "k1"), "'distortion.k1' is not known");
  expectPart(camera("2e-6", "2e-2"), "displaces a corner of the image");
  expectPart(camera("{\"k1_per_mm2\": 2e-6}", "[2e-6]"), "must be an object");
}

TEST(ImageBlockIo, OrientationsAreReadAsWritten) {
  ImageOrientation image;
  image.id = "I1";
  image.position = {500000.12345, 5400000.54321, 1000.0};
  image.angles = {0.01, -0.02, 3.0};
  std::vector<ImageOrientation> given = {image, image};
  given[1].id = "I2";
  given[1].position_sigma = 0.05;
  given[1].angle_sigma = 0.001 * kRadiansPerDegree;
  const auto path = test::scratch("images") / "images.csv";
  writeImages(path, given);
  const auto read = readImages(path);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_LT((read[0].position - image.position).norm(), 1e-5);
  EXPECT_LT((read[0].angles - image.angles).norm(), 1e-10);
  EXPECT_EQ(read[0].position_sigma, 0.0);
  EXPECT_NEAR(read[1].position_sigma, 0.05, 1e-12);
  EXPECT_NEAR(read[1].angle_sigma, given[1].angle_sigma, 1e-12);
}

TEST(ImageBlockIo, OrientationsThatCannotBeAreRefused) {
  const std::string header = "image,x,y,z,omega,phi,kappa\n";
  expectPart(images(header), "has a header but no images");
  expectPart(images(header + "I1,1,2,3,0,0,0\nI1,1,2,3,0,0,0\n"), "line 3, column 'image'");
  expectPart(images(header + "I1,nan,2,3,0,0,0\n"), "column 'x': 'nan'");
  expectPart(images(header + "I1,1e300,2,3,0,0,0\n"), "is not a coordinate in metres");
  expectPart(images(header + "I1,1,2,3,0,0,1e5\n"), "is not an angle in degrees");
  expectPart(images(header + ",1,2,3,0,0,0\n"), "must not be empty");
  expectPart(images("image,x,y,z,omega,phi\nI1,1,2,3,0,0\n"), "kappa");
}

TEST(ImageBlockIo, MeasurementsAreReadAsWritten) {
  const FrameCamera camera = pixels();
  using Kind = ImageMeasurement::Kind;
  const std::vector<ImageMeasurement> given = {{"I1", "P1", Kind::point, {-26.0, 19.0}, 0.0018},
                                               {"I1", "R1", Kind::line, {20.0, -10.0}, 0.0024},
                                               {"I1", "R1", Kind::line, {21.0, -10.0}, 0.0024}};
  const auto path = test::scratch("measurements") / "measurements.csv";
  writeMeasurements(path, camera, given);
  const auto read = readMeasurements(path, camera, 0.0);
  ASSERT_EQ(read.size(), given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    EXPECT_LT((read[i].position - given[i].position).norm(), 1e-7);  // 1e-5 px
    EXPECT_EQ(read[i].kind, given[i].kind);
    EXPECT_NEAR(read[i].sigma, given[i].sigma, 1e-9);
  }
}

TEST(ImageBlockIo, StandardDeviationsHaveADefaultInEachUnit) {
  const std::string text = "image,kind,feature,x,y\nI1,point,P1,10,20\n";
  EXPECT_NEAR(readMeasurements(imageFile("m.csv", text), pixels(), 0.0).front().sigma, 0.003,
              1e-12);
  FrameCamera camera = pixels();
  camera.pixel_size = 0.0;
  EXPECT_NEAR(readMeasurements(imageFile("m.csv", text), camera, 0.0).front().sigma, 0.003, 1e-12);
  EXPECT_NEAR(readMeasurements(imageFile("m.csv", text), camera, 0.01).front().sigma, 0.01, 1e-12);
}

TEST(ImageBlockIo, MeasurementsThatCannotBeAreRefused) {
  const std::string header = "image,kind,feature,x,y,sigma\n";
  expectPart(measurements(header), "has a header but no coordinates");
  expectPart(measurements(header + "I1,edge,P1,1,2,0.3\n"), "is neither point nor line");
  expectPart(measurements(header + "I1,point,P1,9300,2,0.3\n"), "is outside the image");
  expectPart(measurements(header + "I1,point,P1,1,2,0.3\nI1,point,P1,4,2,0.3\n"),
             "line 3, column 'feature': 'P1' is measured twice in image I1");
  expectPart(measurements(header + "I1,line,R1,1,2,0.3\nI1,line,R1,1,2,0.3\n"), "same place");
  expectPart(measurements(header + "I1,point,P1,1,2,-1\n"), "must not be negative");
  expectPart(measurements(header + "I1,point,P1,1,2,1e-9\n"), "is not a standard deviation");
  expectPart(measurements(header + "I1,point,P1,1,2,1e9\n"), "is not a standard deviation");
  // Millimetres from the middle where pixels are expected: all near the upper left corner.
  expectPart(measurements(header + "I1,point,P1,1,2,0.3\nI1,point,P2,26,19,0.3\n"
                                   "I1,point,P3,20,3,0.3\n"),
             "their unit is not px");
  FrameCamera in_mm = pixels();
  in_mm.pixel_size = 0.0;
  const std::string centimetres =
      header + "I1,point,P1,-2.6,1.9,\nI1,point,P2,2.6,1.7,\nI2,point,P1,1.1,-1.9,\n";
  expectPart(measurements(centimetres, in_mm), "their unit is not mm");
}

TEST(ImageBlockIo, LinesAreReadAsWritten) {
  ObjectLine line;
  line.id = "L1";
  line.kind = ObjectLine::Kind::valley;
  line.start = {500000.0, 5400000.0, 100.0};
  line.end = {500010.0, 5400003.0, 100.5};
  Eigen::Matrix4d root = Eigen::Matrix4d::Random();
  line.covariance = 1e-4 * (root * root.transpose() + Eigen::Matrix4d::Identity());
  line.strips = {"1", "4"};
  const auto path = test::scratch("lines") / "lines.csv";
  writeLines(path, {line});
  const auto read = readLines(path);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].kind, line.kind);
  EXPECT_EQ(read[0].strips, line.strips);
  EXPECT_LT((read[0].end - line.end).norm(), 1e-5);
  EXPECT_LT((read[0].covariance - line.covariance).norm(), 1e-4 * line.covariance.norm());
}

TEST(ImageBlockIo, LinesThatCannotBeAreRefused) {
  const std::string header = "id,x1,y1,z1,x2,y2,z2,sigma\n";
  expectPart(lines(header), "has a header but no lines");
  expectPart(lines(header + "L1,0,0,0,9,0,0,0.1\nL1,0,0,0,9,0,0,0.1\n"), "names two lines");
  expectPart(lines(header + "L1,0,0,0,0,0,0,0.1\n"), "vertical or has no length");
  expectPart(lines(header + "L1,0,0,0,0,0,9,0.1\n"), "vertical or has no length");
  expectPart(lines(header + "L1,0,0,0,9,0,0,0\n"), "must be more than 0");
  expectPart(lines(header + "L1,0,0,0,9,0,0,nan\n"), "column 'sigma'");
  expectPart(lines(header + "L1,0,0,1e300,9,0,0,0.1\n"), "is not a coordinate in metres");
  expectPart(lines("id,x1,y1,z1,x2,y2,z2\nL1,0,0,0,9,0,0\n"), "sigma_plan_1");
  expectPart(lines("id,x1,y1,z1,x2,y2,z2,sigma,r_p1p2,r_p1h1,r_h1p2\n"
                   "L1,0,0,0,9,0,0,0.1,0.99,0.99,-0.99\n"),
             "exclude each other");
}

}  // namespace
}  // namespace pcl_als
