// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/classification/land_cover_filter.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

const RasterGrid kCoverGrid{512000.0, 5403000.0, 1.0, 10, 10, ""};

GaussianClass classAt(const std::string& name, double height, double intensity) {
  GaussianClass c;
  c.name = name;
  c.mean = Eigen::Vector2d(height, intensity);
  c.covariance = Eigen::Vector2d(1.0, 100.0).asDiagonal();
  c.prior = 0.5;
  c.samples = 50;
  return c;
}

std::shared_ptr<const PointClassifier> classifier() {
  const GaussianModel model{{"height", "intensity"},
                            {classAt("tree", 8.0, 50.0), classAt("grass", 0.0, 50.0)}};
  auto raster = std::make_shared<Raster>();
  raster->grid = kCoverGrid;
  raster->bands = {{"terrain", std::vector<float>(kCoverGrid.cells(), 300.0F)}};
  return std::make_shared<PointClassifier>(std::make_shared<MaximumLikelihood>(model), raster);
}

pcl::PointCloud<PointLidar>::Ptr cloudOf(std::initializer_list<Eigen::Vector3f> places) {
  const pcl::PointCloud<PointLidar>::Ptr cloud(new pcl::PointCloud<PointLidar>);
  for (const Eigen::Vector3f& p : places) {
    PointLidar point(p.x(), p.y(), p.z());
    point.intensity = 50.0F;
    point.gps_time = 401000.25;
    point.classification = 1;
    cloud->push_back(point);
  }
  return cloud;
}

/// A filter of that classifier whose floats are relative to the raster's south-west corner.
LandCoverFilter<PointLidar> filterOf(const pcl::PointCloud<PointLidar>::Ptr& cloud) {
  LandCoverFilter<PointLidar> filter;
  filter.setClassifier(classifier());
  LocalFrame frame;
  frame.origin = {512000.0, 5402990.0, 0.0};
  filter.setLocalFrame(frame);
  filter.setInputCloud(cloud);
  return filter;
}

// A leaf and the ground under it, in one cell, beside the raster, not finite.
TEST(LandCoverFilter, PointsOfOneCellCanBeOfDifferentClasses) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  const auto cloud = cloudOf({{5, 5, 307}, {5, 5, 300.2F}, {-5, 5, 307}, {5, 5, none}});
  LandCoverFilter<PointLidar> filter = filterOf(cloud);
  pcl::PointCloud<PointLidar> output;
  filter.filter(output);
  ASSERT_EQ(output.size(), 4U);
  EXPECT_EQ(output[0].classification, 5);
  EXPECT_EQ(output[1].classification, 3);
  EXPECT_EQ(output[2].classification, 1);
  EXPECT_EQ(output[3].classification, 1);
  EXPECT_EQ(filter.getUnclassified(), 2U);
  EXPECT_EQ(output[0].gps_time, 401000.25);
  EXPECT_EQ((*cloud)[0].classification, 1);  // the input stays
}

TEST(LandCoverFilter, KeepsPointsBesideTheIndicesAndTakesCodes) {
  const auto cloud = cloudOf({{5, 5, 307}, {6, 5, 307}});
  LandCoverFilter<PointLidar> filter = filterOf(cloud);
  filter.setCodes({{"tree", 4}});
  filter.setIndices(pcl::IndicesPtr(new pcl::Indices{1}));
  pcl::PointCloud<PointLidar> output;
  filter.filter(output);
  EXPECT_EQ(output[0].classification, 1);
  EXPECT_EQ(output[1].classification, 4);
}

TEST(LandCoverFilter, NoiseStaysNoise) {
  const auto cloud = cloudOf({{5, 5, 307}, {5, 5, 307}, {5, 5, 307}});
  (*cloud)[0].classification = 7;
  (*cloud)[1].classification = 18;
  LandCoverFilter<PointLidar> filter = filterOf(cloud);
  pcl::PointCloud<PointLidar> output;
  filter.filter(output);
  EXPECT_EQ(output[0].classification, 7);
  EXPECT_EQ(output[1].classification, 18);
  EXPECT_EQ(output[2].classification, 5);
  EXPECT_EQ(filter.getUnclassified(), 2U);
}

TEST(LandCoverFilter, RefusesWhatItCannotUse) {
  LandCoverFilter<PointLidar> filter;
  filter.setInputCloud(cloudOf({{5, 5, 307}}));
  pcl::PointCloud<PointLidar> output;
  EXPECT_THROW(filter.filter(output), UsageError);
  GaussianModel model{{"slope"}, {}};
  model.classes.push_back(
      {"x", Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Identity(1, 1), 1.0, 9, 0.0});
  const auto raster = std::make_shared<Raster>();
  EXPECT_THROW(PointClassifier(std::make_shared<MaximumLikelihood>(model), raster), UsageError);
}

}  // namespace
}  // namespace pcl_als
