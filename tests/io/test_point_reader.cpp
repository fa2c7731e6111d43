// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reader.h>

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
  test::writeBytes(folder / "a.xyz", "1 2 3\n");
  EXPECT_THROW(PointReader::open(folder / "a.xyz"), InputError);
  EXPECT_THROW(PointReader::open(folder / "missing.las"), InputError);
  EXPECT_THROW(PointReader::open(folder / "missing.pcd"), InputError);
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
