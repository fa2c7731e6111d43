// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// What PCD files of other programs hold besides the columns of PointLidar, or in place of them.
#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/pcd_io.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/time_reference.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

/// Points a few metres apart, with intensities about a value and times of the GPS week.
Strip<PointLidar> stripOf(float intensity) {
  Strip<PointLidar> strip;
  strip.frame.origin = {583390.0, 5283100.0, 500.0};
  for (int i = 0; i < 2000; ++i) {
    PointLidar p(static_cast<float>(i % 50), static_cast<float>(i / 50), 0.0F);
    p.gps_time = 269347.28 + 1e-3 * i;
    p.intensity = intensity * (0.5F + 0.01F * static_cast<float>(i % 101));
    p.point_source_id = 17;
    strip.cloud->push_back(p);
  }
  return strip;
}

/// As pcl_voxel_grid does it, which knows no point type.
pcl::PCLPointCloud2 thinnedByBytes(const pcl::PointCloud<PointLidar>& cloud) {
  const pcl::PCLPointCloud2::Ptr blob(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(cloud, *blob);
  pcl::VoxelGrid<pcl::PCLPointCloud2> grid;
  grid.setInputCloud(blob);
  grid.setLeafSize(2.0F, 2.0F, 2.0F);
  pcl::PCLPointCloud2 thinned;
  grid.filter(thinned);
  return thinned;
}

void expectTimeFault(const fs::path& path) {
  SCOPED_TRACE(path.string());
  const auto reader = PointReader::open(path);
  EXPECT_EQ(reader->info().time_kind, TimeKind::none);
  const std::string fault = reader->info().time_fault;
  EXPECT_NE(fault.find("averages of bytes"), std::string::npos) << fault;
  const std::vector<std::string> remarks = reader->remarks();
  EXPECT_EQ(std::count(remarks.begin(), remarks.end(), fault), 1);
  PcdFindings findings;
  const Strip<PointLidar> strip = loadPcd(path, {}, findings);
  EXPECT_EQ(findings.time_fault, fault);
  EXPECT_EQ(findings.remarks, remarks);
  ASSERT_FALSE(strip.cloud->empty());
  EXPECT_TRUE(std::all_of(strip.cloud->begin(), strip.cloud->end(),
                          [](const PointLidar& p) { return p.gps_time == 0.0; }));
  try {
    reconcileTimes(reader->info(), {0.0, 0.0}, {269340.0, 269360.0}, std::nullopt);
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), path.string() + ": " + fault);
  }
}

/// The mean of the intensity decides what the times seem to be: from 2 to 50 they could be true.
TEST(PcdFindings, AveragedTimesAreRecognisedWhateverTheIntensity) {
  const auto folder = test::scratch("pcd_averaged");
  for (const float intensity : {0.0F, 0.3F, 3.0F, 8.0F, 20.0F, 40.0F, 100.0F, 1000.0F, 30000.0F}) {
    SCOPED_TRACE(intensity);
    const pcl::PCLPointCloud2 thinned = thinnedByBytes(*stripOf(intensity).cloud);
    ASSERT_LT(thinned.width, 700U);
    pcl::PCDWriter writer;
    const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
    const auto level = Eigen::Quaternionf::Identity();
    const fs::path binary = folder / "binary.pcd", ascii = folder / "ascii.pcd";
    ASSERT_EQ(writer.writeBinary(binary.string(), thinned, origin, level), 0);
    expectTimeFault(binary);
    ASSERT_EQ(writer.writeASCII(ascii.string(), thinned, origin, level, 8), 0);
    expectTimeFault(ascii);
  }
}

TEST(PcdFindings, TimesOfPointsAreNone) {
  const auto folder = test::scratch("pcd_times");
  for (const float intensity : {0.0F, 3.0F, 9.03F, 40.0F, 1000.0F}) {
    Strip<PointLidar> strip = stripOf(intensity);
    savePcd(folder / "whole.pcd", strip);
    pcl::VoxelGrid<PointLidar> grid;  // of the point type: it knows what has a mean
    grid.setInputCloud(strip.cloud);
    grid.setLeafSize(2.0F, 2.0F, 2.0F);
    pcl::PointCloud<PointLidar> thinned;
    grid.filter(thinned);
    *strip.cloud = thinned;
    savePcd(folder / "thinned.pcd", strip);
    for (PointLidar& p : *strip.cloud) p.gps_time = 0.0;
    savePcd(folder / "zero.pcd", strip);
    for (const char* name : {"whole.pcd", "thinned.pcd", "zero.pcd"}) {
      const auto reader = PointReader::open(folder / name);
      EXPECT_EQ(reader->info().time_fault, "") << name << intensity;
      EXPECT_EQ(reader->info().time_kind, TimeKind::week_seconds) << name << intensity;
    }
    EXPECT_GE((*loadPcd(folder / "thinned.pcd").cloud)[0].gps_time, 269347.28);
  }
}

/// One point with some fields of one byte behind its coordinates.
void writeBytesOf(const fs::path& path, const std::string& names, const std::string& values) {
  const auto count = static_cast<std::size_t>(std::count(values.begin(), values.end(), ' '));
  std::string sizes, types, ones;
  for (std::size_t i = 0; i <= count; ++i) sizes += " 1", types += " U", ones += " 1";
  test::writeBytes(path, "FIELDS x y z " + names + "\nSIZE 4 4 4" + sizes + "\nTYPE F F F" + types +
                             "\nCOUNT 1 1 1" + ones +
                             "\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n" + "1 2 3 " + values +
                             "\n");
}

TEST(PcdFindings, TheChannelIsFoundAsOtherFieldsAre) {
  const auto folder = test::scratch("pcd_channel");
  const auto channelOf = [&](const char* name, std::vector<std::string>& remarks) {
    PointWindow window;
    window.channel_field = name;
    const auto reader = PointReader::open(folder / "a.pcd", window);
    remarks = reader->remarks();
    PointChunk p;
    EXPECT_TRUE(reader->read(p));
    return static_cast<int>(p.channel.at(0));
  };
  std::vector<std::string> remarks;
  writeBytesOf(folder / "a.pcd", "UserData Beam beam LaserNumber", "5 6 7 8");
  EXPECT_EQ(channelOf("user_data", remarks), 5);
  EXPECT_EQ(channelOf("beam", remarks), 7);  // the very name
  EXPECT_EQ(channelOf("Beam", remarks), 6);
  EXPECT_EQ(channelOf("laser_number", remarks), 8);
  EXPECT_EQ(remarks, std::vector<std::string>{"its fields are not used: Beam, beam"});
  EXPECT_EQ((*loadPcd(folder / "a.pcd").cloud)[0].user_data, 5);
  // Neither has the name.
  EXPECT_THROW(channelOf("BEAM", remarks), InputError);
  EXPECT_THROW(channelOf("mirror", remarks), InputError);
}

TEST(PcdFindings, UnusedFieldsAreNamedOfCloudsAsWell) {
  const auto folder = test::scratch("pcd_lost");
  writeBytesOf(folder / "a.pcd", "Red _ Classification", "5 6 7");
  PcdFindings findings;
  EXPECT_EQ((*loadPcd(folder / "a.pcd", {}, findings).cloud)[0].classification, 7);
  EXPECT_EQ(findings.remarks, std::vector<std::string>{"its field is not used: Red"});
  EXPECT_EQ(findings.time_fault, "");
}

/// Also without id, CRS and corrections, and with some fields only.
TEST(PcdFindings, OurFilesAreKnownByAComment) {
  const auto folder = test::scratch("pcd_ours");
  Strip<PointLidar> strip = stripOf(5.0F);
  strip.frame.origin = {120.0, 50.0, 0.0};  // could be the pose of a sensor
  savePcd(folder / "a.pcd", strip);
  std::ifstream file(folder / "a.pcd", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::string comment = "# pcl_als frame: VIEWPOINT is the origin of the coordinates\n";
  ASSERT_NE(bytes.find(comment), std::string::npos);
  const std::string rest =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\n"
      "VIEWPOINT 120 50 0 1 0 0 0\nPOINTS 1\nDATA ascii\n1 2 3\n";
  test::writeBytes(folder / "ours.pcd", comment + rest);
  test::writeBytes(folder / "other.pcd", "# of somebody else\n" + rest);
  EXPECT_EQ(PointReader::open(folder / "ours.pcd")->info().minimum, Eigen::Vector3d(121, 52, 3));
  EXPECT_TRUE(PointReader::open(folder / "ours.pcd")->remarks().empty());
  EXPECT_EQ(PointReader::open(folder / "other.pcd")->info().minimum, Eigen::Vector3d(1, 2, 3));
}

/// The text of a PCD of two points with one field besides the coordinates.
std::string pcdOfTwoPoints(const std::string& size, const std::string& field,
                           const std::string& type, const std::string& first,
                           const std::string& second) {
  const std::string sizes = size + ' ' + size + ' ' + size + ' ';
  return "FIELDS x y z " + field + "\nSIZE " + sizes + type.substr(2) + "\nTYPE F F F " +
         type.substr(0, 1) +
         "\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 1\nDATA ascii\n500000.25 5400000 100 " + first +
         "\n500009.5 5400007 101 " + second + '\n';
}

TEST(PcdFindings, DoublesHaveFineSteps) {
  const fs::path path = test::scratch("pcd_steps") / "a.pcd";
  test::writeBytes(path, pcdOfTwoPoints("8", "intensity", "F 4", "7", "8"));
  EXPECT_EQ(PointReader::open(path)->info().resolution.x(), 1e-6);
  test::writeBytes(path, pcdOfTwoPoints("4", "intensity", "F 4", "7", "8"));
  EXPECT_NEAR(PointReader::open(path)->info().resolution.x(), 0.64, 0.01);
}

/// The bits of an unsigned id in a signed field, and times as counts of nanoseconds.
TEST(PcdFindings, IntegersOfOtherTypesAreRead) {
  const fs::path path = test::scratch("pcd_types") / "a.pcd";
  PointChunk p;
  test::writeBytes(path, pcdOfTwoPoints("8", "PointSourceID", "I 2", "-26000", "17"));
  ASSERT_TRUE(PointReader::open(path)->read(p));
  EXPECT_EQ(p.point_source_id, (std::vector<std::uint16_t>{39536, 17}));
  test::writeBytes(path, pcdOfTwoPoints("8", "PointSourceID", "I 4", "-26000", "17"));
  EXPECT_THROW(PointReader::open(path), InputError);
  test::writeBytes(
      path, pcdOfTwoPoints("8", "gps_time", "U 8", "1756080000000000000", "1756080001500000000"));
  const auto reader = PointReader::open(path);
  ASSERT_TRUE(reader->read(p));
  EXPECT_NEAR(p.gps_time[0], 1756080000.0, 1e-3);
  EXPECT_NEAR(p.gps_time[1], 1756080001.5, 1e-3);
}

}  // namespace
}  // namespace pcl_als
