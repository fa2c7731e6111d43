// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// SystemBiasCorrection with calibrations of several systems, which the channels of a scanner are.
#include <gtest/gtest.h>
#include <pcl/point_cloud.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/impl/system_bias_correction.hpp>

#include "filter_checks.h"
#include "swath.h"

/// A point type without the fields by which systems are told apart.
struct EIGEN_ALIGN16 PlainPoint {
  PCL_ADD_POINT4D;
  double gps_time;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
POINT_CLOUD_REGISTER_POINT_STRUCT(PlainPoint,
                                  (float, x, x)(float, y, y)(float, z, z)(double, gps_time,
                                                                          gps_time))

/// One with the channel in a field of its own.
struct EIGEN_ALIGN16 BeamPoint {
  PCL_ADD_POINT4D;
  double gps_time;
  std::uint16_t point_source_id;
  float beam;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
POINT_CLOUD_REGISTER_POINT_STRUCT(BeamPoint, (float, x, x)(float, y, y)(float, z, z)(
                                                 double, gps_time,
                                                 gps_time)(std::uint16_t, point_source_id,
                                                           point_source_id)(float, beam, beam))

namespace pcl_als {
namespace {

using test::kOrigin;
using test::refusalOf;
using Cloud = pcl::PointCloud<PointLidar>;

/// The points of a strip, half of them of channel 4 and half of channel 5.
struct ChannelFilter {
  LocalFrame frame = LocalFrame::around(kOrigin);
  std::shared_ptr<const Trajectory> trajectory = test::flownNorth(kOrigin, 20.0);
  Cloud::Ptr cloud{new Cloud};
  SystemBiasCorrection<PointLidar> filter;

  ChannelFilter() {
    for (const test::SwathPoint& from : test::swath(kOrigin, 20.0, 5000)) {
      PointLidar point;
      point.getVector3fMap() = frame.toLocal(from.ground);
      point.gps_time = from.time;
      point.point_source_id = 7;
      point.user_data = static_cast<std::uint8_t>(4 + cloud->size() % 2);
      cloud->push_back(point);
    }
    filter.setTrajectory(trajectory);
    filter.setLocalFrame(frame);
    filter.setInputCloud(cloud);
  }
};

/// Two systems, of which only that of channel 5 has biases; the channel is in \a field.
CalibrationResult ofChannels(const std::string& field) {
  CalibrationResult calibration;
  calibration.converged = true;
  calibration.channel_field = field;
  for (const char* strip : {"7.ch4", "7.ch5"}) {
    SystemEstimate system;
    system.group.name = strip;
    system.group.strips = {strip};
    calibration.systems.push_back(system);
  }
  const SystemVector biases = test::typicalBiases();
  for (int i = 0; i < kSystemParameterCount; ++i) {
    ParameterEstimate& parameter = calibration.systems[1].parameters[static_cast<std::size_t>(i)];
    parameter.status = ParameterStatus::estimated;
    parameter.bias = biases[i];
  }
  return calibration;
}

TEST(ChannelsOfClouds, ChannelsOfTheUserDataHaveTheirOwnBiases) {
  ChannelFilter f;
  Cloud all, corrected;
  f.filter.setBiases(test::typicalBiases());
  f.filter.filter(all);
  f.filter.setCalibration(ofChannels("user_data"));
  f.filter.filter(corrected);
  for (std::size_t i = 0; i < f.cloud->size(); ++i) {
    const Cloud& expected = i % 2 == 0 ? *f.cloud : all;
    ASSERT_EQ(corrected[i].getVector3fMap(), expected[i].getVector3fMap()) << i;
    ASSERT_EQ(corrected[i].user_data, 4 + i % 2);
  }
  EXPECT_GT((all[1].getVector3fMap() - (*f.cloud)[1].getVector3fMap()).norm(), 0.1F);
}

// A field of any type, or a column beside the cloud, gives the channels as the user data do.
TEST(ChannelsOfClouds, OtherFieldsAndColumnsGiveTheSame) {
  ChannelFilter f;
  Cloud expected, by_column;
  f.filter.setCalibration(ofChannels("user_data"));
  f.filter.filter(expected);
  std::vector<std::uint8_t> channels;
  pcl::PointCloud<BeamPoint>::Ptr beams(new pcl::PointCloud<BeamPoint>);
  for (const PointLidar& from : *f.cloud) {
    channels.push_back(from.user_data);
    BeamPoint& point = beams->emplace_back();
    point.getVector3fMap() = from.getVector3fMap();
    point.gps_time = from.gps_time;
    point.point_source_id = from.point_source_id;
    point.beam = from.user_data;
  }
  f.filter.setCalibration(ofChannels("beam"));
  f.filter.setChannels(channels);
  f.filter.filter(by_column);
  SystemBiasCorrection<BeamPoint> filter;
  filter.setTrajectory(f.trajectory);
  filter.setLocalFrame(f.frame);
  filter.setCalibration(ofChannels("beam"));
  filter.setInputCloud(beams);
  pcl::PointCloud<BeamPoint> by_field;
  filter.filter(by_field);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    ASSERT_EQ(by_column[i].getVector3fMap(), expected[i].getVector3fMap()) << i;
    ASSERT_EQ(by_field[i].getVector3fMap(), expected[i].getVector3fMap()) << i;
  }
  f.filter.setChannels({1, 2});
  EXPECT_NE(refusalOf(f.filter).find("2 channels"), std::string::npos) << refusalOf(f.filter);
  (*beams)[7].beam = 300.0F;
  EXPECT_THROW(filter.filter(by_field), InputError);
}

TEST(ChannelsOfClouds, AFieldWithoutWhichPointsWouldGetTheBiasesOfAnotherChannelIsNamed) {
  ChannelFilter f;
  f.filter.setCalibration(ofChannels("beam"));
  EXPECT_NE(refusalOf(f.filter).find("field beam"), std::string::npos) << refusalOf(f.filter);
  // Without an id of their strip the points belong to none of the systems.
  f.filter.setCalibration(ofChannels("user_data"));
  for (PointLidar& point : *f.cloud) point.point_source_id = 0, point.user_data = 4;
  EXPECT_NE(refusalOf(f.filter).find("point source id"), std::string::npos) << refusalOf(f.filter);
  f.filter.setStripId("7");
  EXPECT_EQ(refusalOf(f.filter), "");

  pcl::PointCloud<PlainPoint>::Ptr cloud(new pcl::PointCloud<PlainPoint>(1, 1));
  SystemBiasCorrection<PlainPoint> filter;
  filter.setTrajectory(f.trajectory);
  filter.setInputCloud(cloud);
  pcl::PointCloud<PlainPoint> corrected;
  for (const char* field : {"user_data", "scanner_channel"}) {
    filter.setCalibration(ofChannels(field));
    filter.setStripId("");
    EXPECT_THROW(filter.filter(corrected), UsageError);  // no point_source_id
    filter.setStripId("7");
    EXPECT_THROW(filter.filter(corrected), UsageError);  // no user_data, no flags
  }
}

}  // namespace
}  // namespace pcl_als
