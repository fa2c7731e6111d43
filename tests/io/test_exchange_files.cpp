// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// PLY and ASCII XYZ: there and back, files of other programs, damaged files.
#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/exchange_writer.h>
#include <pcl_als/io/point_reader.h>

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

fs::path pathOf(const std::string& name) {
  const fs::path folder = fs::path(PCL_ALS_TEST_SCRATCH) / "exchange";
  fs::create_directories(folder);
  return folder / name;
}

fs::path written(const std::string& name, const std::string& content) {
  const fs::path path = pathOf(name);
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

/// Points with large coordinates in steps of a millimetre, and other values in every column.
PointChunk examplePoints(std::size_t count) {
  PointChunk chunk;
  chunk.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto k = static_cast<double>(i);
    chunk.x[i] = 583390.001 + 0.377 * k, chunk.y[i] = 5283100.123 - 1.001 * k;
    chunk.z[i] = -12.5 + 0.002 * k;
    chunk.gps_time[i] = 269347.28 + 1e-7 * k;
    chunk.intensity[i] = static_cast<float>(i % 4096) + 0.25F;
    chunk.scan_angle[i] = -20.0F + 0.006F * static_cast<float>(i % 6000);
    chunk.point_source_id[i] = static_cast<std::uint16_t>(65535 - i % 3);
    chunk.return_number[i] = static_cast<std::uint8_t>(1 + i % 3), chunk.number_of_returns[i] = 3;
    chunk.classification[i] = static_cast<std::uint8_t>(i % 256);
    chunk.flags[i] = static_cast<std::uint8_t>(i % 200);
    chunk.user_data[i] = static_cast<std::uint8_t>(255 - i % 256);
    chunk.channel[i] = chunk.flags[i] >> 6U;
  }
  return chunk;
}

PointFileInfo exampleInfo(TimeKind kind = TimeKind::week_seconds) {
  PointFileInfo info;
  info.time_kind = kind;
  info.crs = "LOCAL_CS[\"example\",UNIT[\"metre\",1]]";
  info.corrections = "none of ours";
  return info;
}

fs::path writtenPoints(const std::string& name, const PointChunk& chunk, const PointFileInfo& info,
                       bool ascii_ply = false) {
  const fs::path path = pathOf(name);
  ExchangeWriter writer(path, info, {"7", ascii_ply});
  writer.append(chunk, 0, chunk.size() / 3);
  writer.append(chunk, chunk.size() / 3, chunk.size());
  EXPECT_EQ(writer.pointCount(), chunk.size());
  writer.finish();
  return path;
}

PointChunk readPoints(PointReader& reader) {
  PointChunk all, chunk;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  while (reader.read(chunk)) {
    append(all.x, chunk.x), append(all.y, chunk.y), append(all.z, chunk.z);
    append(all.gps_time, chunk.gps_time);
    append(all.intensity, chunk.intensity), append(all.scan_angle, chunk.scan_angle);
    append(all.point_source_id, chunk.point_source_id);
    append(all.return_number, chunk.return_number);
    append(all.number_of_returns, chunk.number_of_returns);
    append(all.classification, chunk.classification), append(all.flags, chunk.flags);
    append(all.user_data, chunk.user_data), append(all.channel, chunk.channel);
  }
  return all;
}

void expectSameAttributes(const PointChunk& one, const PointChunk& other) {
  EXPECT_EQ(one.intensity, other.intensity);
  EXPECT_EQ(one.scan_angle, other.scan_angle);
  EXPECT_EQ(one.point_source_id, other.point_source_id);
  EXPECT_EQ(one.return_number, other.return_number);
  EXPECT_EQ(one.number_of_returns, other.number_of_returns);
  EXPECT_EQ(one.classification, other.classification);
  EXPECT_EQ(one.flags, other.flags);
  EXPECT_EQ(one.user_data, other.user_data);
  EXPECT_EQ(one.channel, other.channel);
}

std::string refusalOfPoints(const fs::path& path, const PointWindow& window = {}) {
  try {
    const auto reader = PointReader::open(path, window);
    readPoints(*reader);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

void expectRefused(const std::string& name, const std::string& content, const std::string& text) {
  const fs::path path = written(name, content);
  const std::string message = refusalOfPoints(path);
  EXPECT_EQ(message.rfind(path.string() + ": ", 0), 0U) << message;
  EXPECT_NE(message.find(text), std::string::npos) << message << "\nlacks " << text;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(Ply, BinaryKeepsEveryBit) {
  const PointChunk points = examplePoints(200000);  // more than a chunk
  const auto reader = PointReader::open(writtenPoints("all.ply", points, exampleInfo()));
  EXPECT_EQ(reader->info().format, "PLY binary_little_endian");
  EXPECT_EQ(reader->info().crs, exampleInfo().crs);
  EXPECT_EQ(reader->info().corrections, "none of ours");
  EXPECT_EQ(reader->info().time_kind, TimeKind::week_seconds);
  EXPECT_EQ(reader->info().point_count, points.size());
  EXPECT_TRUE(reader->remarks().empty());
  const PointChunk read = readPoints(*reader);
  EXPECT_EQ(read.x, points.x);
  EXPECT_EQ(read.y, points.y);
  EXPECT_EQ(read.z, points.z);
  EXPECT_EQ(read.gps_time, points.gps_time);
  expectSameAttributes(read, points);
}

TEST(Exchange, TextKeepsMillimetresAndAllOtherValues) {
  const PointChunk points = examplePoints(5000);
  for (const bool ply : {true, false}) {
    SCOPED_TRACE(ply ? "PLY" : "XYZ");
    const auto reader =
        PointReader::open(writtenPoints(ply ? "text.ply" : "text.xyz", points, exampleInfo(), ply));
    EXPECT_EQ(reader->info().format, ply ? "PLY ascii" : "ASCII XYZ");
    EXPECT_EQ(reader->info().crs, exampleInfo().crs);
    EXPECT_EQ(reader->info().resolution.x() == 0.001, !ply);
    const PointChunk read = readPoints(*reader);
    ASSERT_EQ(read.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      ASSERT_NEAR(read.x[i], points.x[i], 5e-10);
      ASSERT_NEAR(read.y[i], points.y[i], 2e-9);
      ASSERT_NEAR(read.z[i], points.z[i], 1e-12);
    }
    EXPECT_EQ(read.gps_time, points.gps_time);
    expectSameAttributes(read, points);
  }
}

TEST(Exchange, PointsWithoutTimeStayWithoutTime) {
  for (const char* name : {"timeless.ply", "timeless.xyz"}) {
    const auto reader =
        PointReader::open(writtenPoints(name, examplePoints(9), exampleInfo(TimeKind::none)));
    EXPECT_EQ(reader->info().time_kind, TimeKind::none) << name;
    const PointChunk read = readPoints(*reader);
    EXPECT_EQ(read.gps_time, std::vector<double>(9, 0.0)) << name;
    EXPECT_EQ(read.intensity, examplePoints(9).intensity) << name;
  }
}

/// The values of a field of a cloud that PCL has read.
template <typename T>
std::vector<T> fieldOf(const pcl::PCLPointCloud2& cloud, const std::string& name,
                       std::uint8_t type) {
  std::vector<T> values;
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name != name) continue;
    EXPECT_EQ(field.datatype, type) << name;
    for (std::size_t i = 0; i < cloud.width * cloud.height; ++i) {
      T value;
      std::memcpy(&value, &cloud.data[i * cloud.point_step + field.offset], sizeof value);
      values.push_back(value);
    }
  }
  return values;
}

TEST(Ply, PclReadsTheSameValues) {
  const PointChunk points = examplePoints(1000);
  using Field = pcl::PCLPointField;
  for (const bool ascii : {false, true}) {
    SCOPED_TRACE(ascii ? "ascii" : "binary");
    const fs::path path = writtenPoints("pcl.ply", points, exampleInfo(), ascii);
    pcl::PCLPointCloud2 cloud;
    ASSERT_EQ(pcl::PLYReader().read(path.string(), cloud), 0);
    ASSERT_EQ(cloud.width * cloud.height, points.size());
    const auto x = fieldOf<double>(cloud, "x", Field::FLOAT64);
    ASSERT_EQ(x.size(), points.size());
    for (std::size_t i = 0; i < x.size(); ++i) ASSERT_NEAR(x[i], points.x[i], ascii ? 5e-10 : 0.0);
    EXPECT_EQ(fieldOf<double>(cloud, "gps_time", Field::FLOAT64), points.gps_time);
    EXPECT_EQ(fieldOf<float>(cloud, "intensity", Field::FLOAT32), points.intensity);
    EXPECT_EQ(fieldOf<std::uint16_t>(cloud, "point_source_id", Field::UINT16),
              points.point_source_id);
    EXPECT_EQ(fieldOf<std::uint8_t>(cloud, "classification", Field::UINT8), points.classification);
  }
}

TEST(Ply, FilesOfPclAreRead) {
  pcl::PointCloud<pcl::PointXYZI> cloud;
  for (int i = 0; i < 100; ++i) {
    pcl::PointXYZI point;
    point.x = 0.1F * static_cast<float>(i), point.y = -2.0F, point.z = 3.5F;
    point.intensity = 10.0F * static_cast<float>(i);
    cloud.push_back(point);
  }
  const std::string path = pathOf("by_pcl.ply");
  for (const bool binary : {true, false}) {
    ASSERT_EQ(pcl::io::savePLYFile(path, cloud, binary), 0);
    const auto reader = PointReader::open(path);
    EXPECT_EQ(reader->info().time_kind, TimeKind::none);
    const PointChunk read = readPoints(*reader);
    ASSERT_EQ(read.size(), cloud.size());
    for (std::size_t i = 0; i < read.size(); ++i) {
      EXPECT_NEAR(read.x[i], static_cast<double>(cloud[i].x), binary ? 0.0 : 1e-5);
      EXPECT_EQ(read.intensity[i], cloud[i].intensity);
    }
  }
}

const std::string kPly =
    "ply\nformat ascii 1.0\ncomment made elsewhere\nelement vertex 2\nproperty double x\n"
    "property double y\nproperty double z\nproperty float scalar_Intensity\n"
    "property double scalar_GpsTime\nproperty uchar red\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n";

TEST(Ply, NamesOfOtherProgramsAndOtherElements) {
  const auto reader = PointReader::open(
      written("names.ply", kPly + "1 2 3 4.5 230000.5 9\n5 6 7 8 230001 9\n3 0 1 0\n"));
  const PointChunk read = readPoints(*reader);
  EXPECT_EQ(read.x, (std::vector<double>{1.0, 5.0}));
  EXPECT_EQ(read.intensity, (std::vector<float>{4.5F, 8.0F}));
  EXPECT_EQ(read.gps_time, (std::vector<double>{230000.5, 230001.0}));
  EXPECT_EQ(reader->remarks(),
            (std::vector<std::string>{"its field is not used: red",
                                      "only its vertices are read, not its elements face"}));
}

TEST(Ply, ElementsOfFixedSizeMayStandBeforeTheVertices) {
  const std::string header =
      "ply\r\nformat binary_little_endian 1.0\r\nelement camera 2\r\nproperty short a\r\n"
      "property uchar b\r\nelement vertex 1\r\nproperty float x\r\nproperty float y\r\n"
      "property float z\r\nend_header\r\n";
  const float place[] = {1.5F, 2.5F, 3.5F};
  const std::string bytes(reinterpret_cast<const char*>(place), sizeof place);
  const auto reader = PointReader::open(written("camera.ply", header + "abcdef" + bytes));
  EXPECT_EQ(readPoints(*reader).z, std::vector<double>{3.5});
  expectRefused("camera_cut.ply", header + "abcdef" + bytes.substr(1), "at most 0");
}

TEST(Ply, TimesOfSinglePrecisionAreNotUsed) {
  std::string content = kPly + "1 2 3 4.5 230000.5 9\n5 6 7 8 230001 9\n3 0 1 0\n";
  const std::string field = "double scalar_GpsTime";
  content.replace(content.find(field), field.size(), "float scalar_GpsTime");
  const auto reader = PointReader::open(written("float_time.ply", content));
  EXPECT_EQ(reader->info().time_kind, TimeKind::none);
  EXPECT_NE(reader->info().time_fault.find("steps of 0.03 s"), std::string::npos);
}

TEST(Ply, DamagedFilesAreRefusedInOneLine) {
  const auto changed = [](const std::string& from, const std::string& to) {
    std::string text = kPly + "1 2 3 4 5 6\n1 2 3 4 5 6\n";
    return text.replace(text.find(from), from.size(), to);
  };
  expectRefused("empty.ply", "", "the file is empty");
  expectRefused("no.ply", "PCD\n", "is no PLY file");
  expectRefused("open.ply", "ply\nformat ascii 1.0\n", "no line end_header");
  expectRefused("big.ply", changed("ascii", "binary_big_endian"),
                "line 2 of the PLY header: format");
  expectRefused("format.ply", changed("format ascii 1.0\n", ""), "no format line");
  expectRefused("count.ply", changed("vertex 2", "vertex -2"), "line 4 of the PLY header");
  expectRefused("type.ply", changed("uchar red", "colour red"),
                "the type 'colour' of property 'red'");
  expectRefused("key.ply", changed("comment made", "made"), "line 3 of the PLY header: 'made'");
  expectRefused("none.ply", changed("element vertex", "element point"), "no element vertex");
  expectRefused("list.ply", changed("uchar red", "list uchar int red"), "have lists");
  expectRefused("first.ply",
                changed("element vertex", "element face 1\nproperty int a\nelement vertex"),
                "stand before the vertices");
  expectRefused("no_z.ply", changed("double z", "double w"), "the PLY has no field z");
  expectRefused("twice.ply", changed("uchar red", "float Intensity"),
                "are the same by their names");
  expectRefused("short.ply", kPly + "1.000000 2.000000 3 4 5 6\n1 2 3 4", "ends at point 1 of 2");
  expectRefused("word.ply", kPly + "1 2 3 4 5 6\n1 2 x 4 5 6\n", "point 1, field z: 'x'");
  expectRefused("many.ply", changed("vertex 2", "vertex 1000000000000"),
                "the file can hold at most");
}

TEST(Xyz, ColumnsOfAHeaderInAnyForm) {
  for (const char* text :
       {"X Y Z Intensity GpsTime Class\n1 2 3 4.5 230000.5 2\n",
        "//X,Y,Z,Intensity,gps_time,Classification\n"
        "1,2,3,4.5,230000.5,2\n",
        "\xEF\xBB\xBF# an export\n\n\"northing\";\"easting\";\"height\";"
        "\"scalar_Intensity\";\"gps_time\";\"class\"\r\n2;1;3;4.5;230000.5;2\r\n# the end"}) {
    const auto reader = PointReader::open(written("header.xyz", text));
    const PointChunk read = readPoints(*reader);
    ASSERT_EQ(read.size(), 1U) << text;
    EXPECT_EQ(read.x[0], 1.0) << text;
    EXPECT_EQ(read.y[0], 2.0) << text;
    EXPECT_EQ(read.intensity[0], 4.5F) << text;
    EXPECT_EQ(read.gps_time[0], 230000.5) << text;
    EXPECT_EQ(read.classification[0], 2) << text;
    EXPECT_EQ(read.return_number[0], 1) << text;
  }
}

TEST(Xyz, NamesOfColumnsAreGivenOrAssumed) {
  const auto plain = PointReader::open(written("plain.xyz", "1.25 2 3\n\n4 5 6.125"));
  EXPECT_EQ(readPoints(*plain).z, (std::vector<double>{3.0, 6.125}));
  EXPECT_EQ(plain->info().time_kind, TimeKind::none);
  EXPECT_EQ(plain->info().resolution.x(), 0.001);
  EXPECT_EQ(
      plain->remarks(),
      std::vector<std::string>{"it has no header line: its three columns are taken as x, y and z"});
  PointWindow window;
  window.columns = {"z", "skip", "x", "y", "quality"};
  const auto named = PointReader::open(written("named.xyz", "a b c d e\n3 0 1 2 9\n"), window);
  EXPECT_EQ(readPoints(*named).x, std::vector<double>{1.0});
  EXPECT_EQ(named->remarks(), std::vector<std::string>{"its column is not used: quality"});
  window.columns = {"x", "y"};
  EXPECT_NE(refusalOfPoints(written("lack.xyz", "1 2\n"), window).find("none of them is z"),
            std::string::npos);
  window.columns = {"x", "y", "z", "easting"};
  EXPECT_NE(refusalOfPoints(written("two.xyz", "1 2 3 4\n"), window).find("two of them are x"),
            std::string::npos);
}

TEST(Xyz, DamagedFilesAreRefusedWithTheirLine) {
  expectRefused("empty.xyz", "", "no points and no header line");
  expectRefused("four.xyz", "\n1 2 3 4\n", "line 2: there are 4 columns and no header line");
  expectRefused("words.xyz", "some words here\n1 2 3\n", "line 1: 'some words here' does not name");
  expectRefused("few.xyz", "x y z\n1 2 3\n1 2\n", "line 3: has 2 fields for 3 columns");
  expectRefused("more.xyz", "x y z\n1 2 3 4\n", "line 2: has 4 fields for 3 columns");
  expectRefused("word.xyz", "x y z\n\n1 2 3x\n", "line 3: column z: '3x' is no number");
  expectRefused("first.xyz", "x y z\n1 b 3\n4 5 6\n", "line 2: column y: 'b' is no number");
  expectRefused("class.xyz", "x y z class\n1 2 3 256\n",
                "line 2: column class: '256' is no whole number from 0 to 255");
  expectRefused("share.xyz", "x y z return_number\n1 2 3 1.5\n", "'1.5' is no whole number");
  expectRefused("long.xyz", "x y z\n" + std::string(70000, '1'),
                "line 2: is longer than 65536 bytes");
  expectRefused("twice.xyz", "x y z x\n1 2 3 4\n", "two of them are x");
}

TEST(Xyz, PointsWithoutPlaceAreExcludedAndWindowsApply) {
  const fs::path path = written("window.xyz", "x y z\n1 1 0\nnan 1 0\n2 2 0\n3 3 0\n");
  PointWindow window;
  window.bounds.emplace(Eigen::Vector2d(1.5, 1.5), Eigen::Vector2d(3.0, 3.0));
  EXPECT_EQ(readPoints(*PointReader::open(path, window)).x, (std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(PointReader::open(path)->info().point_count, 3U);
  window = {};
  window.channel_field = "user_data";
  EXPECT_EQ(
      readPoints(*PointReader::open(written("channel.xyz", "x y z user_data\n1 1 0 2\n"), window))
          .channel,
      std::vector<std::uint8_t>{2});
}

TEST(Exchange, NoCopyOfPlyAndXyz) {
  EXPECT_THROW(requireCopyable("a.PLY"), InputError);
  EXPECT_THROW(requireCopyable("a.xyz"), InputError);
  EXPECT_NO_THROW(requireCopyable("a.laz"));
  EXPECT_THROW(ExchangeWriter("a.las", exampleInfo(), {}), UsageError);
}

}  // namespace
}  // namespace pcl_als
