// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_writer.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

PointChunk somePoints(std::size_t count) {
  PointChunk p;
  p.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double k = static_cast<double>(i);
    p.x[i] = 583394.0 + 0.25 * k;
    p.y[i] = 5283100.0 - 0.5 * k;
    p.z[i] = 498.0 + 0.001 * k;
    p.gps_time[i] = 3e8 + 1e-6 * k;
    p.intensity[i] = static_cast<float>(i % 65536);
    p.scan_angle[i] = -30.0F + 0.006F * static_cast<float>(i % 1000);
    p.point_source_id[i] = static_cast<std::uint16_t>(i % 7);
    p.return_number[i] = static_cast<std::uint8_t>(i % 5 + 1);
    p.number_of_returns[i] = 5;
    p.classification[i] = static_cast<std::uint8_t>(i % 20);
    p.flags[i] = static_cast<std::uint8_t>(i % 2 == 0 ? kScanDirection : kSynthetic);
  }
  return p;
}

LasWriterOptions around(int minor, int format) {
  LasWriterOptions options;
  options.version_minor = minor;
  options.point_format = format;
  options.offset = {583000.0, 5283000.0, 0.0};
  return options;
}

PointChunk readBack(const LasFile& file, std::vector<std::byte>& records) {
  const LasHeader& h = file.header();
  records.resize(h.point_count * h.record_length);
  file.readRecords(0, h.point_count, records.data());
  PointChunk chunk;
  decodeLasRecords(records.data(), h.point_count, h.record_length, file.layout(), h.scale, h.offset,
                   chunk);
  return chunk;
}

class LasWriterMatrix : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(LasWriterMatrix, ReadsBackWhatWasWritten) {
  const auto [minor, format] = GetParam();
  const auto folder = test::scratch("las_writer_matrix");
  const PointChunk p = somePoints(1000);
  LasWriter writer(folder / "out.las", around(minor, format));
  writer.append(p);
  writer.append(p);
  writer.finish();
  const LasFile file(folder / "out.las");
  EXPECT_EQ(file.header().version_minor, minor);
  EXPECT_EQ(file.header().point_count, 2000U);
  for (int r = 0; r < 5; ++r) EXPECT_EQ(file.header().points_by_return[r], 400U);
  std::vector<std::byte> records;
  const PointChunk q = readBack(file, records);
  for (std::size_t i = 0; i < p.size(); ++i) {
    // Half a unit of the file's scale, and rounding of doubles at 5e6.
    ASSERT_NEAR(q.x[i], p.x[i], 0.0005 + 1e-9);
    ASSERT_NEAR(q.y[i], p.y[i], 0.0005 + 1e-9);
    ASSERT_NEAR(q.z[i], p.z[i], 0.0005 + 1e-9);
    ASSERT_EQ(q.gps_time[i], file.layout().gps_time >= 0 ? p.gps_time[i] : 0.0);
    ASSERT_EQ(q.intensity[i], p.intensity[i]);
    ASSERT_NEAR(q.scan_angle[i], p.scan_angle[i], file.layout().extended ? 0.0031 : 0.51);
    ASSERT_EQ(q.point_source_id[i], p.point_source_id[i]);
    ASSERT_EQ(q.return_number[i], p.return_number[i]);
    ASSERT_EQ(q.number_of_returns[i], p.number_of_returns[i]);
    ASSERT_EQ(q.classification[i], p.classification[i]);
    ASSERT_EQ(q.flags[i], p.flags[i]);
  }
}

TEST(LasWriter, ScannerChannelAndUserDataAreFieldsOfTheirOwn) {
  const auto folder = test::scratch("las_writer_channel");
  PointChunk p = somePoints(8);
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.user_data[i] = static_cast<std::uint8_t>(4 * i);
    p.flags[i] = static_cast<std::uint8_t>((i % 4) << 6U);
  }
  LasWriter writer(folder / "out.las", around(4, 6));
  writer.append(p);
  writer.finish();
  const LasFile file(folder / "out.las");
  std::vector<std::byte> records;
  const PointChunk q = readBack(file, records);
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_EQ(q.channel[i], i % 4) << "the scanner channel, which has two bits";
    const std::byte* record = &records[i * file.header().record_length];
    EXPECT_EQ(std::to_integer<std::size_t>(record[17]), 4 * i) << "user data";
    EXPECT_EQ(q.user_data[i], 4 * i);
  }
}

std::vector<std::pair<int, int>> specifiedFormats() {
  std::vector<std::pair<int, int>> formats;
  for (int format = 0; format <= 3; ++format) formats.emplace_back(2, format);
  for (int format = 0; format <= 5; ++format) formats.emplace_back(3, format);
  for (int format = 0; format <= 10; ++format) formats.emplace_back(4, format);
  for (int format = 6; format <= 10; ++format) formats.emplace_back(5, format);
  return formats;
}
INSTANTIATE_TEST_SUITE_P(SpecifiedFormats, LasWriterMatrix, testing::ValuesIn(specifiedFormats()));

TEST(LasWriter, StoresTheBoxOfTheStoredCoordinates) {
  const auto folder = test::scratch("las_writer_box");
  LasWriter writer(folder / "out.las", around(4, 6));
  writer.append(somePoints(11));
  writer.finish();
  const LasHeader header = LasFile(folder / "out.las").header();
  EXPECT_EQ(header.minimum.x(), 583394.0);
  EXPECT_EQ(header.maximum.x(), 583396.5);
  EXPECT_EQ(header.minimum.y(), 5283095.0);
  EXPECT_EQ(header.maximum.y(), 5283100.0);
  EXPECT_EQ(header.legacy_point_count, 0U);  // as formats 6-10 demand
}

TEST(LasWriter, AFileWithoutPointsIsWhole) {
  const auto folder = test::scratch("las_writer_none");
  LasWriter writer(folder / "out.las", around(4, 6));
  writer.finish();
  const LasFile file(folder / "out.las");
  EXPECT_EQ(file.header().point_count, 0U);
  EXPECT_EQ(file.header().minimum, Eigen::Vector3d::Zero());
}

TEST(LasWriter, WritesExtraFields) {
  const auto folder = test::scratch("las_writer_extra");
  LasWriterOptions options = around(4, 6);
  options.extra_fields.resize(3);
  options.extra_fields[0].name = "reflectance";
  options.extra_fields[0].description = "0 to 1";
  options.extra_fields[1].name = "incidence";
  options.extra_fields[1].type = LasExtraType::i16;
  options.extra_fields[1].scale = 0.01;
  options.extra_fields[1].offset = 5.0;
  options.extra_fields[2].name = "shot";
  options.extra_fields[2].type = LasExtraType::u64;
  LasWriter writer(folder / "out.las", options);
  writer.append(somePoints(3), {{0.25, 0.5, 0.75}, {5.0, 4.99, 300.0}, {0, 1, 4294967296.0}});
  writer.finish();

  const LasFile file(folder / "out.las");
  EXPECT_EQ(file.header().record_length, 30 + 4 + 2 + 8);
  ASSERT_EQ(file.extraFields().size(), 3U);
  EXPECT_EQ(file.extraFields()[0].description, "0 to 1");
  EXPECT_EQ(file.extraFields()[2].position, 36U);
  std::vector<std::byte> records;
  EXPECT_EQ(readBack(file, records).size(), 3U);
  std::vector<double> values;
  decodeLasExtraField(records.data(), 3, 44, file.extraFields()[0], values);
  EXPECT_EQ(values, (std::vector<double>{0.25, 0.5, 0.75}));
  decodeLasExtraField(records.data(), 3, 44, file.extraFields()[1], values);
  EXPECT_NEAR(values[1], 4.99, 1e-12);  // rounding of a double
  EXPECT_NEAR(values[2], 300.0, 1e-12);
  decodeLasExtraField(records.data(), 3, 44, file.extraFields()[2], values);
  EXPECT_EQ(values[2], 4294967296.0);
}

// 2026-11-21, found by fuzz_las: a file without points gave the decoder a null pointer to add to.
TEST(LasWriter, ExtraFieldsOfNoPointsTouchNoMemory) {
  LasExtraField field;
  field.position = 30;
  std::vector<double> values(3);
  decodeLasExtraField(nullptr, 0, 34, field, values);
  EXPECT_TRUE(values.empty());
  encodeLasExtraField(values, 34, field, "", nullptr);
  encodeLasRecords({}, 34, LasRecordLayout::of(6), {1, 1, 1}, {0, 0, 0}, 0, "", nullptr);
}

TEST(LasWriter, KeepsRawRecordsAndFurtherVlrs) {
  const auto folder = test::scratch("las_writer_raw");
  test::LasBytes las;
  las.extra = 2;
  std::string bytes;
  for (unsigned i = 0; i < las.count; ++i) bytes += las.record(i);
  LasWriterOptions options = around(4, 6);
  options.extra_fields.resize(1);
  options.extra_fields[0].type = LasExtraType::u16;
  options.vlrs = {{"someone", 9, "text", {std::byte{1}, std::byte{2}}}};
  LasWriter writer(folder / "out.las", options);
  writer.appendRecords(reinterpret_cast<const std::byte*>(bytes.data()), las.count);
  writer.finish();
  EXPECT_NE(test::readBytes(folder / "out.las").find(bytes), std::string::npos);
  const LasFile file(folder / "out.las");
  EXPECT_EQ(file.vlrs().back().user_id, "someone");
  EXPECT_EQ(file.vlrs().back().length, 2U);
}

TEST(LasWriter, StoresTheCrs) {
  const auto folder = test::scratch("las_writer_crs");
  LasWriterOptions options = around(4, 6);
  options.crs = "LOCAL_CS[\"metres\"]";
  LasWriter(folder / "wkt.las", options).finish();
  EXPECT_EQ(LasFile(folder / "wkt.las").crs(), options.crs);
  options = around(2, 1);
  options.crs = "EPSG:28992";
  LasWriter(folder / "code.las", options).finish();
  EXPECT_EQ(LasFile(folder / "code.las").crs(), "EPSG:28992");
}

TEST(LasWriter, StoresFeetWhereTheCrsCountsInFeet) {
  const auto folder = test::scratch("las_writer_feet");
  for (const int format : {1, 6}) {  // GeoTIFF keys and WKT
    LasWriterOptions options = around(4, format);
    options.crs = "EPSG:2227";
    options.offset = {6000000.0, 2000000.0, 0.0};  // feet
    LasWriter writer(folder / "feet.las", options);
    PointChunk points = somePoints(1);
    points.x[0] = 6000100.0 * writer.units().horizontal.metres;
    points.y[0] = 2000100.0 * writer.units().horizontal.metres;
    points.z[0] = 30.48;
    writer.append(points);
    writer.finish();
    const LasFile file(folder / "feet.las");
    EXPECT_EQ(file.units().horizontal.name, "US survey foot");
    EXPECT_NEAR(file.header().minimum.x(), 6000100.0, 1e-6);
    // 100 international feet are 99.9998 US survey feet; steps are 0.001.
    EXPECT_NEAR(file.header().minimum.z(), 99.9998, 0.000501);
    EXPECT_NEAR(file.info().minimum.x(), points.x[0], 1e-6);
    EXPECT_EQ(file.units().verticalKnown(), format == 1);
  }
}

TEST(LasWriter, StoresTheKindOfTime) {
  const auto folder = test::scratch("las_writer_time");
  LasWriterOptions options = around(4, 6);
  LasWriter(folder / "standard.las", options).finish();
  EXPECT_EQ(LasFile(folder / "standard.las").info().time_kind, TimeKind::adjusted_standard);
  options.time_kind = TimeKind::week_seconds;
  LasWriter(folder / "week.las", options).finish();
  EXPECT_EQ(LasFile(folder / "week.las").info().time_kind, TimeKind::week_seconds);
}

TEST(LasWriter, WithoutFinishNoFileAppears) {
  const auto folder = test::scratch("las_writer_unfinished");
  { LasWriter(folder / "out.las", around(4, 6)).append(somePoints(3)); }
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(LasWriter, RefusesByNameWhatTheFormatCannotCarry) {
  const auto folder = test::scratch("las_writer_refuses");
  const auto appending = [&](int minor, int format, const std::function<void(PointChunk&)>& spoil) {
    PointChunk p = somePoints(3);
    spoil(p);
    return test::messageOf<Error>(
        [&] { LasWriter(folder / "out.las", around(minor, format)).append(p); });
  };
  const auto has = [](const std::string& message, const char* part) {
    return message.find("out.las: point 2: ") != std::string::npos &&
           message.find(part) != std::string::npos;
  };
  std::string message = appending(4, 6, [](PointChunk& p) { p.x[2] = 3e6; });
  EXPECT_TRUE(has(message, "x = 3000000 does not fit offset 583000")) << message;
  message = appending(4, 6, [](PointChunk& p) { p.z[2] = NAN; });
  EXPECT_TRUE(has(message, "z = nan")) << message;
  message = appending(2, 1, [](PointChunk& p) { p.return_number[2] = 9; });
  EXPECT_TRUE(has(message, "return number 9 cannot be kept in point format 1")) << message;
  message = appending(2, 1, [](PointChunk& p) { p.classification[2] = 64; });
  EXPECT_TRUE(has(message, "class 64")) << message;
  message = appending(2, 1, [](PointChunk& p) { p.flags[2] = kOverlap; });
  EXPECT_TRUE(has(message, "overlap flag")) << message;
  message = appending(2, 1, [](PointChunk& p) { p.flags[2] = 0x80; });
  EXPECT_TRUE(has(message, "scanner channel 2")) << message;
  message = appending(4, 6, [](PointChunk& p) { p.intensity[2] = 70000.0F; });
  EXPECT_TRUE(has(message, "intensity 70000")) << message;
  message = appending(4, 6, [](PointChunk& p) { p.scan_angle[2] = 200.0F; });
  EXPECT_TRUE(has(message, "scan angle")) << message;
}

TEST(LasWriter, RefusesWrongOptions) {
  const auto folder = test::scratch("las_writer_options");
  EXPECT_THROW(LasWriter(folder / "a.las", around(2, 4)), UsageError);
  EXPECT_THROW(LasWriter(folder / "a.las", around(3, 6)), UsageError);
  EXPECT_THROW(LasWriter(folder / "a.las", around(6, 6)), UsageError);
  LasWriterOptions options = around(4, 6);
  options.scale.y() = 0.0;
  EXPECT_THROW(LasWriter(folder / "a.las", options), UsageError);
  EXPECT_THROW(LasWriter(folder / "none" / "a.las", around(4, 6)), InputError);
  LasWriter writer(folder / "a.las", around(4, 6));
  EXPECT_THROW(writer.append(somePoints(1), {{1.0}}), UsageError);
}

}  // namespace
}  // namespace pcl_als
