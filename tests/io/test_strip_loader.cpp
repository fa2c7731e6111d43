// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <map>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/las/las_writer.h>

#include "real_data.h"
#include "test_files.h"

namespace pcl_als {
namespace {

/// A file of points along x, `step` metres apart, all of one source id.
void writeLine(const std::filesystem::path& path, std::uint16_t id, double first_x, double step,
               std::size_t count, LasWriterOptions options = {}) {
  options.offset = {500000.0, 5000000.0, 0.0};
  PointChunk p;
  p.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    p.x[i] = first_x + step * static_cast<double>(i);
    p.y[i] = 5283100.0;
    p.z[i] = 498.125;
    p.gps_time[i] = first_x + static_cast<double>(i);
    p.point_source_id[i] = id;
    p.return_number[i] = p.number_of_returns[i] = 1;
  }
  LasWriter writer(path, options);
  writer.append(p);
  writer.finish();
}

TEST(StripLoader, JoinsTilesInFileOrder) {
  const auto folder = test::scratch("strip_loader_join");
  writeLine(folder / "a.las", 7, 583000.0, 1.0, 10);
  writeLine(folder / "b.las", 7, 583010.0, 1.0, 10);
  writeLine(folder / "c.las", 8, 583000.0, 1.0, 5);
  const auto strips = loadStrips({folder / "a.las", folder / "b.las", folder / "c.las"});
  ASSERT_EQ(strips.size(), 2U);
  EXPECT_EQ(strips[0].id, "7");
  EXPECT_EQ(strips[1].id, "8");
  ASSERT_EQ(strips[0].cloud->size(), 20U);
  for (std::size_t i = 0; i < 20; ++i) {
    const PointLidar& p = (*strips[0].cloud)[i];
    // 0.25 mm: a float's step within LocalFrame::kMaximumExtent.
    EXPECT_NEAR(strips[0].frame.toGround(p.getVector3fMap()).x(), 583000.0 + i, 2.5e-4);
    EXPECT_EQ(p.gps_time, 583000.0 + static_cast<double>(i));
  }
}

TEST(StripLoader, CutsALongStripIntoParts) {
  const auto folder = test::scratch("strip_loader_parts");
  writeLine(folder / "a.las", 7, 500000.0, 10.0, 10001);  // 100 km
  const auto strips = loadStrips({folder / "a.las"});
  EXPECT_EQ(strips.size(), 21U);  // squares of 5 km; the last one holds the end point
  std::size_t points = 0;
  for (const auto& strip : strips) {
    EXPECT_EQ(strip.id, "7");
    for (const PointLidar& p : *strip.cloud) {
      ASSERT_LT(std::hypot(p.x, p.y), LocalFrame::kMaximumExtent);
      const double x = strip.frame.toGround(p.getVector3fMap()).x();
      ASSERT_NEAR(x, p.gps_time * 10.0 - 4500000.0, 2.5e-4);
      ++points;
    }
  }
  EXPECT_EQ(points, 10001U);
}

TEST(StripLoader, RefusesFilesThatDoNotBelongTogether) {
  const auto folder = test::scratch("strip_loader_mixed");
  LasWriterOptions week, code;
  week.time_kind = TimeKind::week_seconds;
  code.version_minor = 2;
  code.point_format = 1;
  writeLine(folder / "standard.las", 7, 583000.0, 1.0, 3);
  writeLine(folder / "week.las", 7, 583000.0, 1.0, 3, week);
  EXPECT_THROW(loadStrips({folder / "standard.las", folder / "week.las"}), InputError);
  code.crs = "EPSG:25832";
  writeLine(folder / "zone32.las", 7, 583000.0, 1.0, 3, code);
  code.crs = "EPSG:25833";
  writeLine(folder / "zone33.las", 7, 583000.0, 1.0, 3, code);
  EXPECT_THROW(loadStrips({folder / "zone32.las", folder / "zone33.las"}), InputError);
  EXPECT_EQ(loadStrips({folder / "zone32.las"})[0].frame.crs, "EPSG:25832");
}

TEST(StripLoader, SplitsTheRealTiles) {
  const auto one = test::unpacked("delft_ahn3/ahn3_cropped_1.las.xz");
  const auto two = test::unpacked("delft_ahn3/ahn3_cropped_2.las.xz");
  PCL_ALS_REQUIRE_DATA(one);
  PCL_ALS_REQUIRE_DATA(two);
  std::map<std::string, std::size_t> points;
  for (const auto& strip : loadStrips({*one, *two})) points[strip.id] = strip.cloud->size();
  // The counts that come with the data.
  const std::map<std::string, std::size_t> expected = {
      {"44266", 109796}, {"57138", 145628}, {"57139", 593468}, {"57140", 50}};
  EXPECT_EQ(points, expected);
}

}  // namespace
}  // namespace pcl_als
