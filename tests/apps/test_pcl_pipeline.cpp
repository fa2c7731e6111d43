// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// PCL's filters, ours and PCD files in one pipeline: what no library of ours can promise alone.
#include <cstdint>
#include <cstring>
#include <memory>

#include <gtest/gtest.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/passthrough.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/pcd_io.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/filters/impl/system_bias_correction.hpp>
#include <pcl_als/filters/incidence_selection.h>
#include <pcl_als/filters/intensity_correction.h>
#include <pcl_als/filters/overlap_selection.h>
#include <pcl_als/filters/surface_selection.h>
#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>
#include <pcl_als/registration/iterative_closest_patch.h>

#include "test_files.h"

namespace {

/// A user's own point: what SystemBiasCorrection needs, and a field that it has never heard of.
struct EIGEN_ALIGN16 UserPoint {
  PCL_ADD_POINT4D;
  double gps_time;
  std::uint32_t pulse;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

}  // namespace

POINT_CLOUD_REGISTER_POINT_STRUCT(UserPoint,
                                  (float, x, x)(float, y, y)(float, z, z)(double, gps_time,
                                                                          gps_time)(std::uint32_t,
                                                                                    pulse, pulse))

namespace pcl_als {
namespace {

using Cloud = pcl::PointCloud<PointLidar>;

std::uint64_t bits(double value) {
  std::uint64_t result;
  std::memcpy(&result, &value, sizeof(result));
  return result;
}

/// Time of the i-th point: no two share their bits, and none is a float.
double timeOf(std::size_t i) {
  return 401000.0 + static_cast<double>(i) / 3.0 * 1e-4;
}

/// A strip of 50 x 40 points, 0.5 m apart, on a slope of 1:10, 1000 m under the sensor.
Cloud::Ptr makeStrip() {
  Cloud::Ptr cloud(new Cloud);
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 50; ++column) {
      PointLidar p(0.5F * static_cast<float>(column), 0.5F * static_cast<float>(row),
                   0.05F * static_cast<float>(column));
      p.gps_time = timeOf(cloud->size());
      p.intensity = static_cast<float>(cloud->size());
      p.scan_angle = -12.006F;
      p.point_source_id = 57139;
      p.return_number = 2;
      p.number_of_returns = 3;
      p.classification = 6;
      p.flags = kOverlap | kScanDirection;
      cloud->push_back(p);
    }
  }
  return cloud;
}

/// North at 60 m/s, 1000 m up, over the middle of the strip.
std::shared_ptr<const Trajectory> makeTrajectory() {
  std::vector<TrajectorySample> samples;
  for (int i = -200; i <= 200; ++i) {
    TrajectorySample sample;
    sample.time = 401000.0 + 0.01 * i;
    sample.position = Eigen::Vector3d(12.5, 0.6 * i, 1000.0);
    samples.push_back(sample);
  }
  return std::make_shared<const Trajectory>(std::move(samples));
}

void expectSameAttributes(const PointLidar& a, const PointLidar& b) {
  EXPECT_EQ(bits(a.gps_time), bits(b.gps_time));
  EXPECT_EQ(a.scan_angle, b.scan_angle);
  EXPECT_EQ(a.point_source_id, b.point_source_id);
  EXPECT_EQ(a.return_number, b.return_number);
  EXPECT_EQ(a.number_of_returns, b.number_of_returns);
  EXPECT_EQ(a.classification, b.classification);
  EXPECT_EQ(a.flags, b.flags);
}

TEST(PclPipeline, VoxelGridTakesMeansAndTheFirstPointsFields) {
  const Cloud::Ptr strip = makeStrip();
  pcl::VoxelGrid<PointLidar> grid;
  grid.setInputCloud(strip);
  grid.setLeafSize(1.0F, 1.0F, 100.0F);  // 2 x 2 points each
  Cloud thinned;
  grid.filter(thinned);
  ASSERT_EQ(thinned.size(), 25U * 20U);
  const PointLidar& first = thinned.front();  // of points 0, 1, 50 and 51
  EXPECT_FLOAT_EQ(first.x, 0.25F);
  EXPECT_FLOAT_EQ(first.y, 0.25F);
  EXPECT_FLOAT_EQ(first.z, 0.025F);
  EXPECT_FLOAT_EQ(first.intensity, 25.5F);
  expectSameAttributes(first, strip->front());
}

TEST(PclPipeline, PassThroughKeepsEveryBitAndFiltersByOurFields) {
  const Cloud::Ptr strip = makeStrip();
  pcl::PassThrough<PointLidar> pass;
  pass.setInputCloud(strip);
  pass.setFilterFieldName("intensity");
  pass.setFilterLimits(100.0F, 199.0F);
  Cloud chosen;
  pass.filter(chosen);
  ASSERT_EQ(chosen.size(), 100U);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    expectSameAttributes(chosen[i], (*strip)[100 + i]);
}

template <typename Class>
void expectAllCores(Class settings) {
  EXPECT_EQ(settings.getNumberOfThreads(), 0);
  settings.setNumberOfThreads(3);
  EXPECT_EQ(settings.getNumberOfThreads(), 3);
  EXPECT_THROW(settings.setNumberOfThreads(-1), UsageError);
}

TEST(PclPipeline, EveryClassUsesAllCoresByDefault) {
  expectAllCores(SystemBiasCorrection<PointLidar>());
  expectAllCores(IntensityCorrection<PointLidar>());
  expectAllCores(IncidenceSelection<PointLidar>());
  expectAllCores(OverlapSelection<PointLidar>());
  expectAllCores(SurfaceSelection<PointLidar>());
  expectAllCores(IterativeClosestPatch<PointLidar, PointLidar>());
  expectAllCores(CorrespondenceEstimationPointToPatch<PointLidar, PointLidar>());
  EXPECT_EQ(SuitablePointsSettings().threads, 0);
}

TEST(PclPipeline, NormalsOfAPlane) {
  const Cloud::Ptr strip = makeStrip();
  pcl::NormalEstimation<PointLidar, pcl::Normal> estimation;
  estimation.setInputCloud(strip);
  estimation.setKSearch(12);
  estimation.setViewPoint(0.0F, 0.0F, 1000.0F);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  ASSERT_EQ(normals.size(), strip->size());
  const Eigen::Vector3f expected = Eigen::Vector3f(-0.1F, 0.0F, 1.0F).normalized();
  for (const pcl::Normal& normal : normals) {
    const float off = (normal.getNormalVector3fMap() - expected).norm();
    ASSERT_LT(off, 1e-3F);  // float covariance of coordinates of some metres
  }
}

TEST(PclPipeline, BackToPcdWithEveryTimeToTheLastBit) {
  const Cloud::Ptr strip = makeStrip();
  SystemVector biases = SystemVector::Zero();
  biases[indexOf(SystemParameter::boresight_roll)] = 90.0 * kRadiansPerArcsec;
  SystemBiasCorrection<PointLidar> correction;
  correction.setInputCloud(strip);
  correction.setTrajectory(makeTrajectory());
  correction.setBiases(biases);
  Cloud::Ptr corrected(new Cloud);
  correction.filter(*corrected);
  // Roll of 90" at 1000 m: 0.436 m across the flight.
  EXPECT_NEAR(std::abs(corrected->front().x - strip->front().x), 0.436F, 0.001F);

  pcl::PassThrough<PointLidar> pass;
  pass.setInputCloud(corrected);
  pass.setFilterFieldName("x");
  pass.setFilterLimits(-100.0F, 100.0F);
  Cloud passed;
  pass.filter(passed);
  const std::string path = (test::scratch("pcl_pipeline") / "strip.pcd").string();
  for (const bool binary : {true, false}) {
    pcl::PCDWriter writer;
    // The text form needs 17 digits for times; PCL's default of 8 would lose them.
    ASSERT_EQ(binary ? writer.writeBinary(path, passed) : writer.writeASCII(path, passed, 17), 0);
    Cloud back;
    ASSERT_EQ(pcl::io::loadPCDFile(path, back), 0);
    ASSERT_EQ(back.size(), strip->size());
    for (std::size_t i = 0; i < back.size(); ++i) expectSameAttributes(back[i], (*strip)[i]);
  }
}

TEST(PclPipeline, AUsersOwnPointTypeKeepsItsFields) {
  pcl::PointCloud<UserPoint>::Ptr cloud(new pcl::PointCloud<UserPoint>);
  const Cloud::Ptr strip = makeStrip();
  for (const PointLidar& p : *strip) {
    UserPoint own{};
    own.getVector4fMap() = p.getVector4fMap();
    own.gps_time = p.gps_time;
    own.pulse = 7U * static_cast<std::uint32_t>(cloud->size());
    cloud->push_back(own);
  }
  SystemVector biases = SystemVector::Zero();
  biases[indexOf(SystemParameter::range_bias)] = 0.1;
  SystemBiasCorrection<UserPoint> correction;
  correction.setInputCloud(cloud);
  correction.setTrajectory(makeTrajectory());
  correction.setBiases(biases);
  pcl::PointCloud<UserPoint> corrected;
  correction.filter(corrected);
  ASSERT_EQ(corrected.size(), cloud->size());
  for (std::size_t i = 0; i < corrected.size(); ++i) {
    ASSERT_EQ(corrected[i].pulse, 7U * i);
    ASSERT_EQ(bits(corrected[i].gps_time), bits(timeOf(i)));
    // Straight down a range too long by 0.1 m is 0.1 m too low; 1 % at the edges (8 degrees).
    ASSERT_NEAR(corrected[i].z - (*cloud)[i].z, 0.1F, 0.001F);
  }
}

}  // namespace
}  // namespace pcl_als
