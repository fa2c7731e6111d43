// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/las/las_writer.h>

#include "las_bytes.h"
#include "real_data.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::LasBytes;

TEST(PointReader, ReadsChunksInFileOrder) {
  const auto folder = test::scratch("point_reader");
  LasBytes las;
  las.count = 2 * PointReader::kChunk + 1;
  test::writeBytes(folder / "a.LAS", las.str());
  const auto reader = PointReader::open(folder / "a.LAS");
  EXPECT_EQ(reader->info().point_count, las.count);
  EXPECT_EQ(reader->info().format, "LAS 1.4, point format 6");
  PointChunk chunk;
  unsigned next = 0;
  std::vector<std::size_t> sizes;
  while (reader->read(chunk)) {
    sizes.push_back(chunk.size());
    for (std::size_t i = 0; i < chunk.size(); ++i) ASSERT_EQ(chunk.gps_time[i], las.time(next++));
  }
  EXPECT_EQ(sizes, (std::vector<std::size_t>{PointReader::kChunk, PointReader::kChunk, 1}));
  EXPECT_EQ(chunk.size(), 0U);
  EXPECT_FALSE(reader->read(chunk));
}

TEST(PointReader, RefusesOtherExtensions) {
  const auto folder = test::scratch("point_reader_extension");
  test::writeBytes(folder / "a.e57", "1 2 3\n");
  EXPECT_THROW(PointReader::open(folder / "a.e57"), InputError);
  EXPECT_THROW(PointReader::open(folder / "missing.las"), InputError);
  EXPECT_THROW(PointReader::open(folder / "missing.pcd"), InputError);
}

/// Channels in three places: 0 to 3 as scanner channel, 0 to 5 in the user data, 10 to 15 in a
/// field.
std::filesystem::path fileWithChannels(const char* name, double first) {
  PointChunk points;
  points.resize(6);
  LasWriterOptions options;
  LasExtraField field;
  field.name = "beam";
  field.type = LasExtraType::i16;
  options.extra_fields.push_back(field);
  std::vector<double> beam;
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.x[i] = static_cast<double>(i);
    points.return_number[i] = points.number_of_returns[i] = 1;
    points.flags[i] = static_cast<std::uint8_t>((i % 4) << 6U);
    points.user_data[i] = static_cast<std::uint8_t>(5 - i);
    beam.push_back(first + static_cast<double>(i));
  }
  const auto path = test::scratch("point_reader_channels") / name;
  LasWriter writer(path, options);
  writer.append(points, {beam});
  writer.finish();
  return path;
}

std::vector<std::uint8_t> channelsIn(const std::filesystem::path& path, const char* field) {
  PointWindow window;
  window.channel_field = field;
  PointChunk chunk;
  PointReader::open(path, window)->read(chunk);
  return chunk.channel;
}

TEST(PointReader, ChannelsAreThoseOfTheFieldThatIsNamed) {
  using Channels = std::vector<std::uint8_t>;
  for (const char* name : {"a.las", "a.laz"}) {
    const auto path = fileWithChannels(name, 10.0);
    EXPECT_EQ(channelsIn(path, ""), (Channels{0, 1, 2, 3, 0, 1}));
    EXPECT_EQ(channelsIn(path, "scanner_channel"), (Channels{0, 1, 2, 3, 0, 1}));
    EXPECT_EQ(channelsIn(path, "user_data"), (Channels{5, 4, 3, 2, 1, 0}));
    EXPECT_EQ(channelsIn(path, "beam"), (Channels{10, 11, 12, 13, 14, 15}));
  }
  // Of a PCD that was made of the file: what a point has.
  const auto pcd = test::scratch("point_reader_channels_pcd") / "a.pcd";
  savePcd(pcd, loadStrips({fileWithChannels("a.laz", 10.0)}).front());
  EXPECT_EQ(channelsIn(pcd, ""), (Channels{0, 1, 2, 3, 0, 1}));
  EXPECT_EQ(channelsIn(pcd, "user_data"), (Channels{5, 4, 3, 2, 1, 0}));
  EXPECT_THROW(channelsIn(pcd, "beam"), InputError);
}

TEST(PointReader, AFieldWithoutChannelsIsNamed) {
  const auto message = [](const std::filesystem::path& path, const char* field) {
    try {
      channelsIn(path, field);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string missing = message(fileWithChannels("b.las", 10.0), "laser");
  EXPECT_NE(missing.find("'laser'"), std::string::npos) << missing;
  EXPECT_NE(missing.find("user_data, beam"), std::string::npos) << missing;
  const std::string negative = message(fileWithChannels("c.las", -1.0), "beam");
  EXPECT_NE(negative.find("'beam' holds -1"), std::string::npos) << negative;
}

TEST(PointReader, ReadsARealTile) {
  const auto tile = test::unpacked("delft_ahn3/ahn3_cropped_2.las.xz");
  PCL_ALS_REQUIRE_DATA(tile);
  const auto reader = PointReader::open(*tile);
  EXPECT_EQ(reader->info().format, "LAS 1.2, point format 1");
  EXPECT_EQ(reader->info().time_kind, TimeKind::week_seconds);
  PointChunk chunk;
  std::size_t points = 0;
  Eigen::Vector3d low = reader->info().maximum, high = reader->info().minimum;
  while (reader->read(chunk))
    for (std::size_t i = 0; i < chunk.size(); ++i, ++points) {
      const Eigen::Vector3d p(chunk.x[i], chunk.y[i], chunk.z[i]);
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  EXPECT_EQ(points, reader->info().point_count);
  // 1e-9 m: rounding of doubles at 4e5.
  EXPECT_LT((low - reader->info().minimum).norm(), 1e-9);
  EXPECT_LT((high - reader->info().maximum).norm(), 1e-9);
}

}  // namespace
}  // namespace pcl_als
