// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <regex>

#include <gtest/gtest.h>
#include <pcl/conversions.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/pcd_io.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

Strip<PointLidar> someStrip(std::size_t count) {
  Strip<PointLidar> strip;
  strip.id = "57138";
  strip.frame.origin = {583390.0, 5283100.0, 500.0};
  strip.frame.crs = "EPSG:25832";
  for (std::size_t i = 0; i < count; ++i) {
    const float k = static_cast<float>(i);
    PointLidar p(0.1F + k / 3.0F, -1234.567F + k / 7.0F, k / 1000.0F);
    p.gps_time = std::nextafter(387654321.123456, 4e8) + 1e-6 * static_cast<double>(i);
    p.intensity = k;
    p.scan_angle = -0.006F * k;
    p.point_source_id = 57138;
    p.return_number = static_cast<std::uint8_t>(i % 4 + 1);
    p.number_of_returns = 4;
    p.classification = static_cast<std::uint8_t>(i % 256);
    p.flags = kEdgeOfFlightLine | kSynthetic;
    p.user_data = static_cast<std::uint8_t>(i % 7);
    strip.cloud->push_back(p);
  }
  return strip;
}

void expectSame(const pcl::PointCloud<PointLidar>& a, const pcl::PointCloud<PointLidar>& b) {
  ASSERT_EQ(a.size(), b.size());
  // From x to user_data; the bytes behind them are padding.
  constexpr std::size_t kBytes = offsetof(PointLidar, user_data) + 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    ASSERT_EQ(std::memcmp(&a[i], &b[i], kBytes), 0) << "point " << i;
}

TEST(PcdIo, KeepsEveryBit) {
  const auto folder = test::scratch("pcd_bits");
  const Strip<PointLidar> strip = someStrip(70000);  // more than one block
  savePcd(folder / "a.pcd", strip);
  const Strip<PointLidar> back = loadPcd(folder / "a.pcd");
  EXPECT_EQ(back.id, strip.id);
  EXPECT_EQ(back.frame.origin, strip.frame.origin);
  EXPECT_EQ(back.frame.crs, strip.frame.crs);
  expectSame(*back.cloud, *strip.cloud);
}

TEST(PcdIo, KeepsAnOriginThatFloatsCannotHold) {
  const auto folder = test::scratch("pcd_origin");
  Strip<PointLidar> strip = someStrip(3);
  strip.frame.origin = {583394.123456789, 5283100.987654321, 1.0 / 3.0};
  savePcd(folder / "a.pcd", strip);
  EXPECT_EQ(loadPcd(folder / "a.pcd").frame.origin, strip.frame.origin);
}

TEST(PcdIo, PclReadsWhatWeWrite) {
  const auto folder = test::scratch("pcd_pcl_reads");
  const Strip<PointLidar> strip = someStrip(100);
  savePcd(folder / "a.pcd", strip);
  pcl::PointCloud<PointLidar> all;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "a.pcd").string(), all), 0);
  expectSame(all, *strip.cloud);
  pcl::PointCloud<pcl::PointXYZI> some;
  ASSERT_EQ(pcl::io::loadPCDFile((folder / "a.pcd").string(), some), 0);
  EXPECT_EQ(some[99].intensity, 99.0F);
  EXPECT_EQ(some.sensor_origin_.head<3>().cast<double>(), strip.frame.origin);
}

TEST(PcdIo, WeReadWhatPclWrites) {
  const auto folder = test::scratch("pcd_pcl_writes");
  const Strip<PointLidar> strip = someStrip(3000);
  strip.cloud->sensor_origin_.head<3>() = strip.frame.origin.cast<float>();
  const pcl::PointCloud<PointLidar>& cloud = *strip.cloud;
  pcl::PCDWriter writer;
  ASSERT_EQ(writer.writeBinary((folder / "binary.pcd").string(), cloud), 0);
  ASSERT_EQ(writer.writeBinaryCompressed((folder / "compressed.pcd").string(), cloud), 0);
  ASSERT_EQ(writer.writeASCII((folder / "ascii.pcd").string(), cloud, 17), 0);
  for (const char* name : {"binary.pcd", "compressed.pcd", "ascii.pcd"}) {
    SCOPED_TRACE(name);
    const Strip<PointLidar> back = loadPcd(folder / name);
    EXPECT_EQ(back.frame.origin, strip.frame.origin);
    EXPECT_EQ(back.id, "57138");  // from the point source ids
    expectSame(*back.cloud, cloud);
  }
}

TEST(PcdIo, MissingFieldsKeepTheirDefaults) {
  const auto folder = test::scratch("pcd_missing");
  pcl::PointCloud<pcl::PointXYZ> cloud;
  cloud.push_back({1.0F, 2.0F, 3.0F});
  cloud.push_back({NAN, 2.0F, 3.0F});
  pcl::io::savePCDFileBinary((folder / "line7.pcd").string(), cloud);
  const Strip<PointLidar> strip = loadPcd(folder / "line7.pcd");
  ASSERT_EQ(strip.cloud->size(), 1U);  // the point without coordinates is excluded
  EXPECT_EQ(strip.id, "line7");
  EXPECT_EQ((*strip.cloud)[0].z, 3.0F);
  EXPECT_EQ((*strip.cloud)[0].gps_time, 0.0);
  EXPECT_EQ((*strip.cloud)[0].return_number, 1);
}

TEST(PcdIo, TextIdAndCrsStayOneLine) {
  const auto folder = test::scratch("pcd_comment");
  Strip<PointLidar> strip = someStrip(2);
  strip.id = "line\n7";
  strip.frame.crs = "PROJCS[\n  x]";
  savePcd(folder / "a.pcd", strip);
  EXPECT_EQ(loadPcd(folder / "a.pcd").id, "line 7");
  EXPECT_EQ(loadPcd(folder / "a.pcd").frame.crs, "PROJCS[   x]");
}

TEST(PcdIo, AnEmptyCloudIsNoError) {
  const auto folder = test::scratch("pcd_empty");
  savePcd(folder / "a.pcd", someStrip(0));
  EXPECT_TRUE(loadPcd(folder / "a.pcd").cloud->empty());
}

const std::string kHead =
    "# .PCD v0.7\n# pcl_als strip 7\nVERSION 0.7\nFIELDS x y z gps_time\nSIZE 4 4 4 8\nTYPE F F F "
    "F\nCOUNT 1 1 1 1\n"
    "WIDTH 2\nHEIGHT 1\nVIEWPOINT 100 200 0 1 0 0 0\nPOINTS 2\nDATA ascii\n";
const std::string kPoints = "1 2 3 230038.25\n4.5 5 6e0 230039\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(PcdReader, GivesGroundCoordinatesBoxAndKindOfTime) {
  const auto folder = test::scratch("pcd_reader");
  test::writeBytes(folder / "a.pcd", kHead + kPoints);
  const auto reader = PointReader::open(folder / "a.pcd");
  EXPECT_EQ(reader->info().format, "PCD ascii");
  EXPECT_EQ(reader->info().point_count, 2U);
  EXPECT_EQ(reader->info().minimum, Eigen::Vector3d(101, 202, 3));
  EXPECT_EQ(reader->info().maximum, Eigen::Vector3d(104.5, 205, 6));
  EXPECT_EQ(reader->info().time_kind, TimeKind::week_seconds);
  PointChunk chunk;
  ASSERT_TRUE(reader->read(chunk));
  EXPECT_EQ(chunk.x, (std::vector<double>{101.0, 104.5}));
  EXPECT_EQ(chunk.gps_time, (std::vector<double>{230038.25, 230039.0}));
  EXPECT_FALSE(reader->read(chunk));
  EXPECT_EQ(chunk.size(), 0U);
}

/// Text that is no CRS, or a code that PROJ does not know, must not be in the way of a LAS file.
TEST(PcdReader, ACrsThatCannotBeUsedIsNamed) {
  const auto folder = test::scratch("pcd_crs");
  const auto infoOf = [&](const std::string& crs) {
    test::writeBytes(folder / "a.pcd", replaced(kHead, "strip 7", "crs " + crs) + kPoints);
    EXPECT_EQ(loadPcd(folder / "a.pcd").frame.crs, PointReader::open(folder / "a.pcd")->info().crs);
    return PointReader::open(folder / "a.pcd")->info();
  };
  EXPECT_EQ(infoOf("EPSG:25832").crs, "EPSG:25832");
  EXPECT_EQ(infoOf("''").crs, "");
  EXPECT_EQ(infoOf("EPSG:65535").crs, "");
  EXPECT_EQ(infoOf("EPSG:65535").crs_ignored, "EPSG:65535 is not known to PROJ");
}

TEST(PcdReader, TimesOutsideTheWeekAreStandardTime) {
  const auto folder = test::scratch("pcd_reader_time");
  test::writeBytes(folder / "a.pcd", kHead + replaced(kPoints, "230039", "380000000"));
  EXPECT_EQ(PointReader::open(folder / "a.pcd")->info().time_kind, TimeKind::adjusted_standard);
}

TEST(PcdIo, DoublesGetAFrameAroundTheirCentre) {
  const auto folder = test::scratch("pcd_double");
  test::writeBytes(folder / "a.pcd",
                   "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 1\n"
                   "POINTS 2\nDATA ascii\n583394.125 5283100.25 498\n583396.125 5283104.25 502\n");
  const Strip<PointLidar> strip = loadPcd(folder / "a.pcd");
  EXPECT_EQ(strip.frame.origin, Eigen::Vector3d(583400, 5283100, 500));
  EXPECT_EQ(strip.frame.toGround((*strip.cloud)[1].getVector3fMap()),
            Eigen::Vector3d(583396.125, 5283104.25, 502));
}

/// The text of a PCD of one point.
std::string onePoint(const std::string& fields, const std::string& sizes, const std::string& types,
                     const std::string& values, const std::string& viewpoint = "0 0 0 1 0 0 0") {
  const std::string ones = std::regex_replace(types, std::regex("[A-Z]"), "1");
  return "FIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " + types + "\nCOUNT " + ones +
         "\nWIDTH 1\nHEIGHT 1\nVIEWPOINT " + viewpoint + "\nPOINTS 1\nDATA ascii\n" + values + '\n';
}

TEST(PcdReader, KnowsTheNamesOfOtherWriters) {
  const auto folder = test::scratch("pcd_names");
  const std::string sizes = "8 8 8 8 4 4 2 1 1 1 1", types = "F F F F F F U U U U U";
  const std::string values = "500000.5 5400000.25 100 269347.28 80 -12.5 17 2 3 6 9";
  for (const char* fields :
       {"X Y Z GpsTime Intensity ScanAngleRank PointSourceId ReturnNumber NumberOfReturns "
        "Classification UserData",  // PDAL
        "x y z gpstime intensity scanangle pointsourceid returnnumber numberofreturns "
        "classification userdata"}) {  // lasR
    test::writeBytes(folder / "a.pcd", onePoint(fields, sizes, types, values));
    const auto reader = PointReader::open(folder / "a.pcd");
    EXPECT_EQ(reader->info().time_kind, TimeKind::week_seconds);
    EXPECT_TRUE(reader->remarks().empty());
    PointChunk p;
    ASSERT_TRUE(reader->read(p));
    EXPECT_EQ(p.x[0], 500000.5);
    EXPECT_EQ(p.gps_time[0], 269347.28);
    EXPECT_EQ(p.intensity[0], 80.0F);
    EXPECT_EQ(p.scan_angle[0], -12.5F);
    EXPECT_EQ(p.point_source_id[0], 17);
    EXPECT_EQ(p.return_number[0], 2);
    EXPECT_EQ(p.number_of_returns[0], 3);
    EXPECT_EQ(p.classification[0], 6);
    EXPECT_EQ(p.user_data[0], 9);
  }
}

TEST(PcdReader, NamesFieldsThatAreNotUsed) {
  const auto folder = test::scratch("pcd_unused");
  test::writeBytes(folder / "a.pcd",
                   onePoint("x y z rgb _ t", "4 4 4 4 1 8", "F F F F U F", "1 2 3 4 5 6"));
  EXPECT_EQ(PointReader::open(folder / "a.pcd")->remarks(),
            std::vector<std::string>{"its fields are not used: rgb, t"});
}

TEST(PcdReader, AFieldWithTheVeryNameIsTheColumn) {
  const auto folder = test::scratch("pcd_same");
  const std::string sizes = "4 4 4 8 8", types = "F F F F F", values = "1 2 3 1000 2000";
  test::writeBytes(folder / "a.pcd", onePoint("x y z GpsTime gps_time", sizes, types, values));
  const auto reader = PointReader::open(folder / "a.pcd");
  PointChunk p;
  ASSERT_TRUE(reader->read(p));
  EXPECT_EQ(p.gps_time[0], 2000.0);
  EXPECT_EQ(reader->remarks(), std::vector<std::string>{"its field is not used: GpsTime"});
  test::writeBytes(folder / "b.pcd", onePoint("x y z GpsTime gpstime", sizes, types, values));
  try {
    PointReader::open(folder / "b.pcd");
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("fields GpsTime and gpstime are the same"),
              std::string::npos)
        << error.what();
  }
}

TEST(PcdReader, TheViewpointIsAPoseUnlessItCannotBe) {
  const auto folder = test::scratch("pcd_viewpoint");
  struct Case {
    const char *size, *values, *viewpoint;
    double x;  ///< of the point
    const char* remark;
  };
  for (const Case& c : {
           Case{"4", "1 2 3", "0 0 100 1 0 0 0", 1.0, "pose of the sensor"},
           Case{"4", "1 2 3", "500 0 100 0 1 0 0", 1.0, "pose of the sensor"},
           Case{"4", "1 2 3", "0 0 0 1 0 0 0", 1.0, ""},
           // What PCL leaves of a cloud with a frame, when it has other fields.
           Case{"4", "1 2 3", "583390 5283100 500 1 0 0 0", 583391.0, "origin of the coordinates"},
           Case{"4", "1 2 3", "583390 5283100 500 0 0 0 0", 583391.0, "origin of the coordinates"},
           // A sensor in the midst of its points.
           Case{"4", "583000 5283000 3", "583390 5283100 500 1 0 0 0", 583000.0, "pose of the"},
           Case{"8", "1 2 3", "583390 5283100 500 1 0 0 0", 1.0, "pose of the sensor"},
       }) {
    const std::string sizes = std::string(c.size) + " " + c.size + " " + c.size;
    test::writeBytes(folder / "a.pcd", onePoint("x y z", sizes, "F F F", c.values, c.viewpoint));
    const auto reader = PointReader::open(folder / "a.pcd");
    PointChunk p;
    ASSERT_TRUE(reader->read(p));
    EXPECT_EQ(p.x[0], c.x) << c.viewpoint;
    const std::vector<std::string> remarks = reader->remarks();
    const std::string remark = remarks.empty() ? "" : remarks[0];
    EXPECT_EQ(remark.empty(), *c.remark == '\0') << remark;
    EXPECT_NE(remark.find(c.remark), std::string::npos) << remark;
  }
}

/// pcl_voxel_grid averages the bytes of all fields as floats.
TEST(PcdReader, AveragedBytesAreNoTimes) {
  const auto folder = test::scratch("pcd_averages");
  pcl::PCLPointCloud2::Ptr cloud(new pcl::PCLPointCloud2);
  pcl::PCLPointCloud2 thinned;
  Strip<PointLidar> strip = someStrip(3000);
  pcl::toPCLPointCloud2(*strip.cloud, *cloud);
  pcl::VoxelGrid<pcl::PCLPointCloud2> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(20.0F, 20.0F, 20.0F);
  grid.filter(thinned);
  ASSERT_EQ(pcl::io::savePCDFile((folder / "a.pcd").string(), thinned), 0);
  const auto reader = PointReader::open(folder / "a.pcd");
  EXPECT_EQ(reader->info().time_kind, TimeKind::none);
  ASSERT_EQ(reader->remarks().size(), 1U);
  EXPECT_NE(reader->remarks()[0].find("its GPS times are not used, they are averages of bytes"),
            std::string::npos);
  PointChunk p;
  ASSERT_TRUE(reader->read(p));
  EXPECT_EQ(*std::max_element(p.gps_time.begin(), p.gps_time.end()), 0.0);
  EXPECT_EQ((*loadPcd(folder / "a.pcd").cloud)[0].gps_time, 0.0);
}

struct PcdFault {
  const char* name;
  std::string bytes;
  const char* message;
};

const PcdFault kFaults[] = {
    {"Empty", "", "the file is empty"},
    {"NotPcd", "LASF\n\n", "is not a PCD file"},
    {"NoData", "FIELDS x y z\n", "has no DATA line"},
    {"NoFields", "WIDTH 1\nHEIGHT 1\nDATA ascii\n", "no FIELDS line"},
    {"NoCount", "FIELDS x\nSIZE 4\nTYPE F\nDATA ascii\n", "how many points"},
    {"NoZ", replaced(kHead, "y z", "y h") + kPoints, "no field z of type F"},
    {"IntegerX", replaced(kHead, "TYPE F", "TYPE I") + kPoints, "no field x of type F"},
    {"FloatTime", replaced(kHead, "4 4 4 8", "4 4 4 4") + kPoints,
     "gps_time is of 4 bytes, not of 8"},
    {"SizesShort", replaced(kHead, "4 4 4 8", "4 4 4") + kPoints, "SIZE line has 3 entries for 4"},
    {"SizeWord", replaced(kHead, "4 4 4 8", "4 4 4 eight") + kPoints, "'eight' where a count"},
    {"SizeThree", replaced(kHead, "4 4 4 8", "4 4 3 8") + kPoints, "type F of 3 bytes"},
    {"CountZero", replaced(kHead, "COUNT 1", "COUNT 0") + kPoints, "its COUNT is 0"},
    {"CountHuge", replaced(kHead, "COUNT 1", "COUNT 99999999") + kPoints, "COUNT is 99999999"},
    {"Type", replaced(kHead, "TYPE F", "TYPE X") + kPoints, "type X"},
    {"Rotated", replaced(kHead, "1 0 0 0", "0 1 0 0") + kPoints, "VIEWPOINT is rotated"},
    {"Viewpoint", replaced(kHead, "100 200", "nan 200") + kPoints, "not seven numbers"},
    {"Contradiction", replaced(kHead, "POINTS 2", "POINTS 3") + kPoints, "POINTS differ"},
    {"CountLies", replaced(replaced(kHead, "POINTS 2", "POINTS 9"), "WIDTH 2", "WIDTH 9") + kPoints,
     "at most 4 (truncated copy?)"},
    {"WidthHuge",
     replaced(replaced(kHead, "HEIGHT 1", "HEIGHT 18446744073709551615"), "POINTS 2", "POINTS 9"),
     "too large"},
    {"Cut", kHead + "1 2 3 230038.25\n4.5 5 6", "ends at point 1 of 2"},
    {"Text", kHead + replaced(kPoints, "4.5", "abc"), "point 1, field x: 'abc'"},
    {"DataKind", replaced(kHead, "ascii", "base64") + kPoints, "DATA is 'base64'"},
    {"BinaryCut", replaced(kHead, "ascii", "binary") + std::string(30, 'x'), "at most 1"},
    {"CompressedCut", replaced(kHead, "ascii", "binary_compressed") + "abc", "ends before"},
    {"CompressedSize", replaced(kHead, "ascii", "binary_compressed") + std::string(8, '\0'),
     "not of the size"},
    {"CompressedGarbage",
     replaced(kHead, "ascii", "binary_compressed") +
         test::Bytes().u32(6).u32(40).text("\xff\xff\xff\xff", 6).str(),
     "compressed data are corrupt"},
};

class PcdFaulty : public testing::TestWithParam<PcdFault> {};

TEST_P(PcdFaulty, IsAnInputErrorThatNamesFileAndFault) {
  const auto folder = test::scratch("pcd_faulty");
  test::writeBytes(folder / "bad.pcd", GetParam().bytes);
  try {
    loadPcd(folder / "bad.pcd");
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("bad.pcd: "), std::string::npos) << message;
    EXPECT_NE(message.find(GetParam().message), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(Table, PcdFaulty, testing::ValuesIn(kFaults),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(PcdReader, ValuesOutOfRangeAreRefusedByName) {
  const auto folder = test::scratch("pcd_range");
  test::writeBytes(folder / "a.pcd",
                   "FIELDS x y z point_source_id\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\n"
                   "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 70000\n");
  try {
    loadPcd(folder / "a.pcd");
    FAIL() << "was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("field point_source_id holds 70000"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace pcl_als
