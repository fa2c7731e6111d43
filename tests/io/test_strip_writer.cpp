// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/strip_writer.h>
#include <pcl_als/las/las_file.h>

#include "test_files.h"

namespace pcl_als {
namespace {

StripLoading withColumns() {
  StripLoading loading;
  loading.all_columns = true;
  return loading;
}

PointColumn columnOf(const std::string& name, LasExtraType type, std::vector<double> values) {
  PointColumn column;
  column.field.name = name;
  column.field.type = type;
  column.field.size = lasExtraSize(column.field);
  column.values = std::move(values);
  return column;
}

/// Three points with every field at UTM coordinates.
StripWithColumns makeStrip(const std::string& id = "12") {
  StripWithColumns strip;
  strip.id = id;
  strip.frame = LocalFrame::around({583000.0, 5283100.0, 500.0}, "EPSG:25832");
  for (int i = 0; i < 3; ++i) {
    PointLidar point(10.25F * static_cast<float>(i), -3.5F, 2.125F);
    point.gps_time = 1000.0 + i;
    point.intensity = 100.0F + static_cast<float>(i);
    point.scan_angle = 1.2F;
    point.return_number = static_cast<std::uint8_t>(i + 1);
    point.number_of_returns = 3;
    point.classification = 65;
    point.flags = kOverlap | (2U << 6U);
    strip.cloud->push_back(point);
  }
  return strip;
}

double columnValue(const StripWithColumns& strip, const std::string& name, std::size_t point) {
  for (const PointColumn& column : strip.columns)
    if (column.field.name == name) return column.values.at(point);
  ADD_FAILURE() << "no column " << name;
  return std::nan("");
}

void expectSamePoints(const StripWithColumns& got, const StripWithColumns& expected) {
  ASSERT_EQ(got.cloud->size(), expected.cloud->size());
  for (std::size_t i = 0; i < got.cloud->size(); ++i) {
    const PointLidar &a = (*got.cloud)[i], &b = (*expected.cloud)[i];
    const Eigen::Vector3d difference =
        got.frame.toGround(a.getVector3fMap()) - expected.frame.toGround(b.getVector3fMap());
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 0.00075);  // half a step, and the floats
    EXPECT_EQ(a.gps_time, b.gps_time);
    EXPECT_EQ(a.intensity, b.intensity);
    EXPECT_NEAR(a.scan_angle, b.scan_angle, 0.003);
    EXPECT_EQ(a.return_number, b.return_number);
    EXPECT_EQ(a.number_of_returns, b.number_of_returns);
    EXPECT_EQ(a.classification, b.classification);
    EXPECT_EQ(a.flags, b.flags);
  }
}

class StripWriter : public testing::TestWithParam<const char*> {};

TEST_P(StripWriter, KeepsEveryField) {
  const auto path = test::scratch("strip_writer_fields") / (std::string("a") + GetParam());
  StripWithColumns strip = makeStrip();
  strip.columns.push_back(columnOf("red", LasExtraType::u16, {1, 2, 65535}));
  strip.columns.push_back(columnOf("nir", LasExtraType::u16, {7, 8, 9}));
  (*strip.cloud)[1].user_data = 5;
  strip.columns.push_back(columnOf("reflectance", LasExtraType::f32, {0.5, std::nan(""), -1.25}));
  PointColumn scaled = columnOf("height above ground", LasExtraType::i16, {1.23, 0.0, 3.21});
  scaled.field.scale = 0.01;
  scaled.field.description = "of the terrain";
  strip.columns.push_back(scaled);
  saveStrips(path, {strip});

  const LasFile file(path);
  EXPECT_EQ(file.header().point_format, 8);
  EXPECT_EQ(file.header().file_source_id, 12);
  EXPECT_EQ(file.header().global_encoding & kLasAdjustedStandardTime, 0);
  ASSERT_EQ(file.extraFields().size(), 2U);
  EXPECT_EQ(file.extraFields()[1].description, "of the terrain");
  const auto loaded = loadStrips({path}, withColumns());
  ASSERT_EQ(loaded.size(), 1U);
  EXPECT_EQ(loaded[0].id, "12");
  expectSamePoints(loaded[0], strip);
  EXPECT_EQ((*loaded[0].cloud)[2].point_source_id, 12);
  EXPECT_EQ(columnValue(loaded[0], "red", 2), 65535);
  EXPECT_EQ(columnValue(loaded[0], "green", 2), 0);
  EXPECT_EQ(columnValue(loaded[0], "nir", 1), 8);
  EXPECT_EQ((*loaded[0].cloud)[1].user_data, 5);
  EXPECT_TRUE(std::isnan(columnValue(loaded[0], "reflectance", 1)));
  EXPECT_EQ(columnValue(loaded[0], "reflectance", 2), -1.25);
  EXPECT_NEAR(columnValue(loaded[0], "height above ground", 0), 1.23, 1e-9);
}

TEST_P(StripWriter, ChoosesThePointFormatFromTheColumns) {
  const auto path = test::scratch("strip_writer_format") / (std::string("a") + GetParam());
  StripWithColumns strip = makeStrip();
  saveStrips(path, {strip});
  EXPECT_EQ(LasFile(path).header().point_format, 6);
  strip.columns = {columnOf("blue", LasExtraType::u16, {1, 2, 3})};
  saveStrips(path, {strip});
  EXPECT_EQ(LasFile(path).header().point_format, 7);
  // A near infrared that is no 16-bit number is an extra field of that name.
  strip.columns = {columnOf("nir", LasExtraType::f32, {0.1, 0.2, 0.3})};
  saveStrips(path, {strip});
  EXPECT_EQ(LasFile(path).header().point_format, 6);
  EXPECT_EQ(LasFile(path).extraFields().size(), 1U);
}

INSTANTIATE_TEST_SUITE_P(LasAndLaz, StripWriter, testing::Values(".las", ".laz"));

TEST(StripWriterFiles, ManyPointsOfSeveralStrips) {
  const auto path = test::scratch("strip_writer_many") / "a.laz";
  StripWithColumns first = makeStrip("1"), second = makeStrip("2");
  for (int i = 0; i < 200000; ++i) second.cloud->push_back((*second.cloud)[0]);
  second.columns = {columnOf("amplitude", LasExtraType::u32, {})};
  for (std::size_t i = 0; i < second.cloud->size(); ++i)
    second.columns[0].values.push_back(static_cast<double>(i));
  saveStrips(path, {first, second});
  const auto loaded = loadStrips({path}, withColumns());
  ASSERT_EQ(loaded.size(), 2U);
  expectSamePoints(loaded[0], first);
  expectSamePoints(loaded[1], second);
  EXPECT_EQ(columnValue(loaded[0], "amplitude", 1), 0);
  EXPECT_EQ(columnValue(loaded[1], "amplitude", 200002), 200002);
}

TEST(StripWriterFiles, AdjustedTimes) {
  const auto path = test::scratch("strip_writer_times") / "a.las";
  StripWithColumns strip = makeStrip();
  for (PointLidar& point : *strip.cloud) point.gps_time += 2.4e8;
  saveStrips(path, {strip});
  EXPECT_EQ(LasFile(path).info().time_kind, TimeKind::adjusted_standard);
}

TEST(StripWriterFiles, PcdHasColumns) {
  const auto path = test::scratch("strip_writer_pcd") / "a.pcd";
  StripWithColumns strip = makeStrip();
  strip.columns = {columnOf("red", LasExtraType::u16, {1, 2, 3}),
                   columnOf("pulse width", LasExtraType::f32, {0.5, 1.5, 2.5})};
  saveStrips(path, {strip});
  expectSamePoints(loadStrips({path}, StripLoading())[0], strip);
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(text.find(" red pulse_width\n"), std::string::npos);
  strip.columns = {columnOf("id", LasExtraType::u32, {1, 2, 16777217})};
  EXPECT_THROW(saveStrips(path, {strip}), UsageError);
}

TEST(StripWriterFiles, RefusesWhatWouldBeLost) {
  const auto folder = test::scratch("strip_writer_refused");
  const StripWithColumns strip = makeStrip();
  EXPECT_THROW(saveStrips(folder / "a.txt", {strip}), UsageError);
  EXPECT_THROW(saveStrips(folder / "a.copc.laz", {strip}), UsageError);
  EXPECT_THROW(saveStrips(folder / "a.las", {}), UsageError);
  EXPECT_THROW(saveStrips(folder / "a.las", {StripWithColumns()}), UsageError);
  EXPECT_THROW(saveStrips(folder / "a.pcd", {strip, strip}), UsageError);
  EXPECT_THROW(saveStrips(folder / "a.las", {makeStrip("north"), makeStrip("south")}), UsageError);
  StripWithColumns elsewhere = strip;
  elsewhere.frame.crs = "EPSG:25833";
  EXPECT_THROW(saveStrips(folder / "a.las", {strip, elsewhere}), UsageError);
  StripWithColumns wrong = strip;
  wrong.columns = {columnOf("red", LasExtraType::u16, {1, 2})};
  EXPECT_THROW(saveStrips(folder / "a.las", {wrong}), UsageError);
  wrong.columns = {columnOf("red", LasExtraType::u16, {1, 2, 65536})};
  EXPECT_THROW(saveStrips(folder / "a.las", {wrong}), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST(StripLoading, ColumnsByNameAndWindow) {
  const auto folder = test::scratch("strip_loading");
  StripWithColumns one = makeStrip("1"), other = makeStrip("1");
  one.columns = {columnOf("amplitude", LasExtraType::f64, {1, 2, 3}),
                 columnOf("echo", LasExtraType::u8, {1, 1, 2})};
  saveStrips(folder / "a.las", {one});
  saveStrips(folder / "b.las", {other});
  StripLoading loading;
  loading.columns = {"amplitude"};
  const auto strips = loadStrips({folder / "a.las", folder / "b.las"}, loading);
  ASSERT_EQ(strips.size(), 1U);
  ASSERT_EQ(strips[0].columns.size(), 1U);
  EXPECT_EQ(columnValue(strips[0], "amplitude", 2), 3);
  EXPECT_TRUE(std::isnan(columnValue(strips[0], "amplitude", 5)));  // b.las has no such field

  loading.columns = {"width"};
  EXPECT_THROW(loadStrips({folder / "a.las"}, loading), InputError);
  loading.columns.clear();
  loading.window.bounds.emplace(Eigen::Vector2d(583005.0, 5283000.0),
                                Eigen::Vector2d(583015.0, 5283200.0));
  ASSERT_EQ(loadStrips({folder / "a.las"}, loading)[0].cloud->size(), 1U);
  loading.window.bounds.emplace(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 1.0));
  EXPECT_THROW(loadStrips({folder / "a.las"}, loading), InputError);
  EXPECT_THROW(loadStrips({}), UsageError);
}

}  // namespace
}  // namespace pcl_als
