// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstring>
#include <limits>

#include <gtest/gtest.h>
#include <pcl/point_cloud.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/impl/system_bias_correction.hpp>

#include "filter_checks.h"
#include "swath.h"

/// A user's own point type: nothing but what the filter needs and one field more.
struct EIGEN_ALIGN16 LabelledPoint {
  PCL_ADD_POINT4D;
  double gps_time;
  std::uint16_t label;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
POINT_CLOUD_REGISTER_POINT_STRUCT(LabelledPoint,
                                  (float, x, x)(float, y, y)(float, z, z)(double, gps_time,
                                                                          gps_time)(std::uint16_t,
                                                                                    label, label))

namespace pcl_als {
namespace {

using test::effectAt;
using test::flownNorth;
using test::kOrigin;
using test::refusalOf;
using test::swath;
using test::SwathPoint;
using test::typicalBiases;
using Cloud = pcl::PointCloud<PointLidar>;

PointLidar lidarPoint(const LocalFrame& frame, const SwathPoint& point, int i) {
  PointLidar lidar;
  lidar.getVector3fMap() = frame.toLocal(point.ground);
  lidar.gps_time = point.time;
  lidar.intensity = static_cast<float>(i) + 0.5F;
  lidar.scan_angle = -3.0F;
  lidar.point_source_id = 7;
  lidar.classification = static_cast<std::uint8_t>(i % 32);
  return lidar;
}

Cloud::Ptr cloudOf(const LocalFrame& frame, const std::vector<SwathPoint>& points) {
  Cloud::Ptr cloud(new Cloud);
  int i = 0;
  for (const SwathPoint& point : points) cloud->push_back(lidarPoint(frame, point, i++));
  return cloud;
}

/// A filter over a swath of 20 s around kOrigin.
struct SwathFilter {
  LocalFrame frame = LocalFrame::around(kOrigin);
  std::shared_ptr<const Trajectory> trajectory = flownNorth(kOrigin, 20.0);
  Cloud::Ptr cloud = cloudOf(frame, swath(kOrigin, 20.0, 5000));
  SystemBiasCorrection<PointLidar> filter;

  SwathFilter() {
    filter.setTrajectory(trajectory);
    filter.setLocalFrame(frame);
    filter.setBiases(typicalBiases());
    filter.setInputCloud(cloud);
  }
  Eigen::Vector3d ground(const PointLidar& point) const {
    return frame.toGround(point.getVector3fMap());
  }
};

/// Compares all but the coordinates.
void expectSameFields(const PointLidar& a, const PointLidar& b) {
  PointLidar moved = b;
  moved.x = a.x, moved.y = a.y, moved.z = a.z;
  EXPECT_EQ(std::memcmp(&a, &moved, sizeof a), 0);
}

TEST(SystemBiasCorrection, RollByHand) {
  // Flown north 1000 m above a point 200 m to the right, 1e-3 rad of roll: Eq. (8) with c = 1,
  // s = 0, x = 200, z = -1000 gives east z df = -1 m, up -x df = -0.2 m; it is subtracted. The
  // second order: east x df^2 / 2 = 0.1 mm, up z df^2 / 2 = 0.5 mm.
  TrajectorySample a, b;
  a.position = {0.0, -60.0, 1000.0}, a.time = -1.0;
  b.position = {0.0, 60.0, 1000.0}, b.time = 1.0;
  SystemBiasCorrection<PointLidar> filter;
  filter.setTrajectory(std::make_shared<Trajectory>(std::vector<TrajectorySample>{a, b}));
  filter.setBiases(SystemVector::Unit(indexOf(SystemParameter::boresight_roll)) * 1e-3);
  Cloud::Ptr cloud(new Cloud);
  cloud->push_back(PointLidar(200.0F, 0.0F, 0.0F));
  filter.setInputCloud(cloud);
  Cloud corrected;
  filter.filter(corrected);
  ASSERT_EQ(corrected.size(), 1U);
  EXPECT_NEAR(corrected[0].x, 201.0 - 0.0001, 2e-5);
  EXPECT_FLOAT_EQ(corrected[0].y, 0.0F);
  EXPECT_NEAR(corrected[0].z, 0.2 + 0.0005, 2e-5);
}

TEST(SystemBiasCorrection, SubtractsTheEffectAndKeepsEveryOtherField) {
  SwathFilter f;
  const Cloud before = *f.cloud;
  Cloud corrected;
  f.filter.filter(corrected);
  ASSERT_EQ(corrected.size(), before.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const SwathPoint point{before[i].gps_time, f.ground(before[i])};
    const Eigen::Vector3d effect = effectAt(*f.trajectory, point, typicalBiases());
    // Half a step of a float up to 2 km: 6.1e-5 m.
    EXPECT_LT((f.ground(corrected[i]) - (point.ground - effect)).cwiseAbs().maxCoeff(), 6.2e-5);
    expectSameFields(before[i], corrected[i]);
    largest = std::max(largest, effect.norm());
  }
  EXPECT_GT(largest, 0.4);
  EXPECT_EQ(std::memcmp(before.data(), f.cloud->data(), before.size() * sizeof(PointLidar)), 0);
  EXPECT_EQ(f.filter.getCoverage().points, before.size());
  EXPECT_EQ(f.filter.getCoverage().missed(), 0U);
}

TEST(SystemBiasCorrection, InvertUndoesIt) {
  SwathFilter f;
  Cloud::Ptr corrected(new Cloud);
  f.filter.filter(*corrected);
  f.filter.setInputCloud(corrected);
  f.filter.setInvert(true);
  Cloud back;
  f.filter.filter(back);
  for (std::size_t i = 0; i < back.size(); ++i) {
    // Two roundings to a float up to 2 km.
    EXPECT_LT((back[i].getVector3fMap() - (*f.cloud)[i].getVector3fMap()).norm(), 2.2e-4F) << i;
  }
}

TEST(SystemBiasCorrection, ZeroBiasesChangeNoBit) {
  SwathFilter f;
  f.filter.setBiases(SystemVector::Zero());
  Cloud corrected;
  f.filter.filter(corrected);
  EXPECT_EQ(std::memcmp(corrected.data(), f.cloud->data(), corrected.size() * sizeof(PointLidar)),
            0);
}

TEST(SystemBiasCorrection, TakesTheBiasesOfACalibration) {
  CalibrationResult result;
  result[SystemParameter::range_bias].bias = 0.25;
  SystemBiasCorrection<PointLidar> filter;
  filter.setCalibration(result);
  EXPECT_EQ(filter.getBiases(), SystemVector::Unit(6) * 0.25);
}

/// Two systems of one swath, by turns: each point is moved as by the calibration of its system
/// alone, and by the offset of its coordinates.
TEST(SystemBiasCorrection, CorrectsEachPointByItsSystem) {
  SwathFilter fixture;
  CalibrationResult calibration;
  calibration[SystemParameter::boresight_roll].bias = 1e-3;
  calibration.systems.resize(2);
  calibration.systems[0].group = {"first", {"7", "8.ch0"}};
  calibration.systems[0].parameters = calibration.parameters;
  calibration.systems[1].group = {"second", {"8.ch1"}};
  calibration.systems[1].parameters[indexOf(SystemParameter::range_bias)].bias = 0.5;
  calibration.systems[1].offset = {0.0, 0.0, 0.25};
  for (std::size_t i = 0; i < fixture.cloud->size(); ++i) {
    PointLidar& point = (*fixture.cloud)[i];
    point.point_source_id = i % 3 == 0 ? 7 : 8;
    point.flags = static_cast<std::uint8_t>(i % 3 == 2 ? 1U << 6U : 0U);
  }
  const auto corrected = [&](const CalibrationResult& by) {
    SystemBiasCorrection<PointLidar> filter;
    filter.setTrajectory(fixture.trajectory);
    filter.setLocalFrame(fixture.frame);
    filter.setCalibration(by);
    filter.setInputCloud(fixture.cloud);
    Cloud cloud;
    filter.filter(cloud);
    return cloud;
  };
  CalibrationResult first = calibration, second = calibration;
  first.systems.clear();
  second.systems.clear();
  second.parameters = calibration.systems[1].parameters;
  const Cloud both = corrected(calibration), a = corrected(first), b = corrected(second);
  for (std::size_t i = 0; i < both.size(); ++i) {
    const PointLidar& expected = i % 3 == 2 ? b[i] : a[i];
    EXPECT_EQ(both[i].x, expected.x) << i;
    EXPECT_EQ(both[i].y, expected.y) << i;
    // 1e-4: floats of some hundred metres.
    EXPECT_NEAR(both[i].z, expected.z - (i % 3 == 2 ? 0.25F : 0.0F), 1e-4F) << i;
  }
  (*fixture.cloud)[5].point_source_id = 9;
  EXPECT_THROW(corrected(calibration), InputError);
}

TEST(SystemBiasCorrection, ACalibrationWithAnAdverseVerdictIsRefused) {
  CalibrationResult result;
  result.verdict.downgrade(CalibrationStatus::no_improvement, "the misfit is larger");
  SystemBiasCorrection<PointLidar> filter;
  EXPECT_THROW(filter.setCalibration(result), UsageError);
}

TEST(SystemBiasCorrection, RefusesPointsWithoutTrajectoryUnlessTheyMayStay) {
  SwathFilter f;
  (*f.cloud)[3].gps_time = 99.0;
  (*f.cloud)[4].gps_time = std::nan("");
  Cloud corrected;
  try {
    f.filter.filter(corrected);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("2 of 5000 points"), std::string::npos)
        << error.what();
  }
  f.filter.setKeepUncovered(true);
  f.filter.filter(corrected);
  EXPECT_EQ(corrected[3].getVector3fMap(), (*f.cloud)[3].getVector3fMap());
  EXPECT_NE(corrected[5].getVector3fMap(), (*f.cloud)[5].getVector3fMap());
  EXPECT_EQ(f.filter.getCoverage().after_end, 1U);
  EXPECT_EQ(f.filter.getCoverage().without_time, 1U);
}

TEST(SystemBiasCorrection, PassesPointsThatAreNotFiniteOn) {
  SwathFilter f;
  PointLidar& hole = (*f.cloud)[10];
  hole.x = hole.y = hole.z = std::numeric_limits<float>::quiet_NaN();
  hole.gps_time = 1e6;  // would be refused
  f.cloud->is_dense = false;
  Cloud corrected;
  f.filter.filter(corrected);
  EXPECT_EQ(std::memcmp(&corrected[10], &hole, sizeof hole), 0);
  EXPECT_NE(corrected[11].x, (*f.cloud)[11].x);
  EXPECT_FALSE(corrected.is_dense);
}

TEST(SystemBiasCorrection, EmptyAndOnePointClouds) {
  SwathFilter f;
  Cloud::Ptr few(new Cloud);
  f.filter.setInputCloud(few);
  Cloud corrected;
  f.filter.filter(corrected);
  EXPECT_TRUE(corrected.empty());
  few->push_back((*f.cloud)[42]);
  f.filter.setInputCloud(few);
  f.filter.filter(corrected);
  ASSERT_EQ(corrected.size(), 1U);
  EXPECT_NE(corrected[0].x, (*few)[0].x);
}

TEST(SystemBiasCorrection, CorrectsOnlyTheIndices) {
  SwathFilter f;
  pcl::IndicesPtr indices(new pcl::Indices{1, 3});
  f.filter.setIndices(indices);
  Cloud corrected;
  f.filter.filter(corrected);
  ASSERT_EQ(corrected.size(), f.cloud->size());
  EXPECT_EQ(corrected[2].x, (*f.cloud)[2].x);
  EXPECT_NE(corrected[3].x, (*f.cloud)[3].x);
}

TEST(SystemBiasCorrection, MayReplaceItsInput) {
  SwathFilter f;
  Cloud apart;
  f.filter.filter(apart);
  f.filter.filter(*f.cloud);
  for (std::size_t i = 0; i < apart.size(); ++i) {
    ASSERT_EQ(apart[i].getVector3fMap(), (*f.cloud)[i].getVector3fMap());
    ASSERT_EQ(apart[i].gps_time, (*f.cloud)[i].gps_time);
  }
}

TEST(SystemBiasCorrection, ThreadsChangeNoBit) {
  SwathFilter f;
  f.cloud = cloudOf(f.frame, swath(kOrigin, 20.0, 70000));
  f.filter.setInputCloud(f.cloud);
  Cloud one, eight;
  EXPECT_EQ(f.filter.getNumberOfThreads(), 0);  // all cores
  f.filter.setNumberOfThreads(1);
  f.filter.filter(one);
  f.filter.setNumberOfThreads(8);
  f.filter.filter(eight);
  EXPECT_EQ(std::memcmp(one.data(), eight.data(), one.size() * sizeof(PointLidar)), 0);
}

TEST(SystemBiasCorrection, TimeOffsetIsAddedToPointTimes) {
  SwathFilter f;
  Cloud expected, shifted;
  f.filter.filter(expected);
  for (PointLidar& point : *f.cloud) point.gps_time += 1024.0;
  EXPECT_THROW(f.filter.filter(shifted), InputError);
  f.filter.setTimeOffset(-1024.0);
  f.filter.filter(shifted);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    // Adding 1024 s rounds times to 1e-13 s: nothing in metres.
    ASSERT_NEAR(shifted[i].x, expected[i].x, 6.2e-5);
    ASSERT_EQ(shifted[i].gps_time, (*f.cloud)[i].gps_time);
  }
}

TEST(SystemBiasCorrection, AFrameThatWasNotSetIsNamed) {
  SwathFilter f;
  f.filter.setLocalFrame(LocalFrame());
  const std::string text = refusalOf(f.filter);
  EXPECT_NE(text.find("setLocalFrame"), std::string::npos) << text;
  EXPECT_NE(text.find(" m beside the trajectory"), std::string::npos) << text;
  f.filter.setCheckTrajectory(false);
  EXPECT_EQ(refusalOf(f.filter), "");
  // A frame of elsewhere on the same map, 20 km away.
  f.filter.setCheckTrajectory(true);
  f.filter.setLocalFrame(LocalFrame::around(kOrigin + Eigen::Vector3d(0.0, 20e3, 0.0)));
  EXPECT_NE(refusalOf(f.filter).find("setLocalFrame"), std::string::npos);
}

TEST(SystemBiasCorrection, AUsersOwnPointTypeWorks) {
  SwathFilter f;
  pcl::PointCloud<LabelledPoint>::Ptr cloud(new pcl::PointCloud<LabelledPoint>);
  for (const PointLidar& from : *f.cloud) {
    LabelledPoint point;
    point.x = from.x, point.y = from.y, point.z = from.z;
    point.gps_time = from.gps_time, point.label = 5;
    cloud->push_back(point);
  }
  SystemBiasCorrection<LabelledPoint> filter;
  filter.setTrajectory(f.trajectory);
  filter.setLocalFrame(f.frame);
  filter.setBiases(typicalBiases());
  filter.setInputCloud(cloud);
  pcl::PointCloud<LabelledPoint> corrected;
  filter.filter(corrected);
  Cloud expected;
  f.filter.filter(expected);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(corrected[i].x, expected[i].x);
    ASSERT_EQ(corrected[i].label, 5);
  }
}

TEST(SystemBiasCorrection, RefusesToRunWithoutATrajectory) {
  SystemBiasCorrection<PointLidar> filter;
  Cloud::Ptr cloud(new Cloud(1, 1));
  filter.setInputCloud(cloud);
  Cloud corrected;
  EXPECT_THROW(filter.filter(corrected), UsageError);
}

TEST(SystemBiasCorrection, HundredKilometresInPartsAreRightToAMillimetre) {
  constexpr double kSeconds = 100000.0 / 60.0;
  const auto trajectory = flownNorth(kOrigin, kSeconds);
  const auto points = swath(kOrigin, kSeconds, 60000);
  constexpr std::size_t kParts =
      14;  // 7.2 km each: within LocalFrame::kMaximumExtent of the middle
  double largest = 0.0, worst_whole = 0.0;
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t first = points.size() * part / kParts;
    const std::size_t last = points.size() * (part + 1) / kParts;
    const std::vector<SwathPoint> own(points.begin() + static_cast<std::ptrdiff_t>(first),
                                      points.begin() + static_cast<std::ptrdiff_t>(last));
    const LocalFrame frame = LocalFrame::around(own[own.size() / 2].ground);
    SystemBiasCorrection<PointLidar> filter;
    filter.setTrajectory(trajectory);
    filter.setLocalFrame(frame);
    filter.setBiases(typicalBiases());
    filter.setInputCloud(cloudOf(frame, own));
    Cloud corrected;
    filter.filter(corrected);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Eigen::Vector3d expected =
          own[i].ground - effectAt(*trajectory, own[i], typicalBiases());
      const Eigen::Vector3d found = frame.toGround(corrected[i].getVector3fMap());
      largest = std::max(largest, (found - expected).cwiseAbs().maxCoeff());
      // In one part the float alone would cost this.
      const auto whole = static_cast<double>(static_cast<float>(expected.y() - kOrigin.y()));
      worst_whole = std::max(worst_whole, std::abs(whole - (expected.y() - kOrigin.y())));
    }
  }
  // Two roundings to a float up to 4 km: 2.5e-4 m.
  EXPECT_LT(largest, 1e-3);
  EXPECT_GT(worst_whole, 3e-3);
}

}  // namespace
}  // namespace pcl_als
