// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/strip_naming.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using Names = std::vector<std::string>;

PointFileSources fileOfSources(const std::string& path, const std::vector<std::uint16_t>& ids,
                               double first = 0.0, double last = 0.0) {
  PointFileSources sources;
  sources.info.path = path;
  for (const std::uint16_t id : ids) {
    PointSource source;
    source.id = id;
    source.points = 10;
    source.first_time = first;
    source.last_time = last;
    sources.sources.push_back(source);
  }
  return sources;
}

TEST(StripNaming, IdsAreNumbersAndJoinTiles) {
  const StripNaming naming(
      {fileOfSources("west.las", {44266, 57138}), fileOfSources("east.las", {57138, 57139})});
  EXPECT_EQ(naming.names(), (Names{"44266", "57138", "57139"}));
  EXPECT_EQ(naming.nameOf(0, 57138), "57138");
  EXPECT_EQ(naming.nameOf(1, 57138), "57138");
  EXPECT_THROW(naming.nameOf(1, 44266), UsageError);
}

TEST(StripNaming, IdZeroIsNamedByTheFile) {
  EXPECT_EQ(StripNaming({fileOfSources("a/line1.las", {0})}).names(), Names{"line1"});
  EXPECT_EQ(StripNaming({fileOfSources("line1.las", {0}), fileOfSources("line2.las", {0})}).names(),
            (Names{"line1", "line2"}));
  EXPECT_EQ(
      StripNaming({fileOfSources("line1.las", {0, 5}), fileOfSources("line2.las", {5})}).names(),
      (Names{"line1", "5"}));
}

TEST(StripNaming, OneConstantIdInFilesFarApartInTimeMeansOneFilePerLine) {
  const StripNaming naming(
      {fileOfSources("l1.las", {1}, 100, 140), fileOfSources("l2.las", {1}, 300, 340)});
  EXPECT_EQ(naming.names(), (Names{"l1", "l2"}));
  EXPECT_EQ(naming.nameOf(1, 1), "l2");
}

TEST(StripNaming, OneConstantIdInFilesThatFollowInTimeMeansTiles) {
  EXPECT_EQ(
      StripNaming({fileOfSources("t2.las", {7}, 141, 160), fileOfSources("t1.las", {7}, 100, 140)})
          .names(),
      Names{"7"});
  EXPECT_EQ(
      StripNaming({fileOfSources("t1.las", {7}, 100, 140), fileOfSources("t2.las", {7}, 110, 120)})
          .names(),
      Names{"7"});
}

TEST(StripNaming, OneConstantIdWithoutTimesMeansOneFilePerLine) {
  EXPECT_EQ(StripNaming({fileOfSources("l1.las", {1}), fileOfSources("l2.las", {1})}).names(),
            (Names{"l1", "l2"}));
}

TEST(StripNaming, DifferentSingleIdsAreNumbers) {
  EXPECT_EQ(
      StripNaming({fileOfSources("strip1.las", {1}), fileOfSources("strip2.las", {2})}).names(),
      (Names{"1", "2"}));
}

TEST(StripNaming, ATakenStemIsReplaced) {
  EXPECT_EQ(StripNaming({fileOfSources("5.las", {0}), fileOfSources("b.las", {5})}).names(),
            (Names{"5.las", "5"}));
  EXPECT_EQ(StripNaming({fileOfSources("a/s.las", {0}), fileOfSources("b/s.las", {0}),
                         fileOfSources("c/s.las", {0})})
                .names(),
            (Names{"s", "s.las", "c/s.las"}));
  EXPECT_EQ(StripNaming({fileOfSources("s.las", {0}), fileOfSources("s.las", {0}),
                         fileOfSources("s.las", {0})})
                .names(),
            (Names{"s", "s.las", "s.las#2"}));
}

TEST(SurveySources, TellsIdsTimesAndBoxes) {
  const auto folder = test::scratch("survey_sources");
  test::LasBytes las;
  las.count = 1001;
  test::writeBytes(folder / "a.las", las.str());
  const PointFileSources sources = surveySources(folder / "a.las");
  EXPECT_EQ(sources.info.point_count, 1001U);
  ASSERT_EQ(sources.sources.size(), 2U);
  EXPECT_EQ(sources.sources[0].id, 57138);
  EXPECT_EQ(sources.sources[0].points, 501U);
  EXPECT_EQ(sources.sources[1].first_time, las.time(1));
  EXPECT_EQ(sources.sources[1].last_time, las.time(999));
  EXPECT_EQ(sources.sources[0].minimum.x(), las.X(0) * las.scale + las.offset_x);
  EXPECT_EQ(sources.sources[0].maximum.z(), las.Z(1000) * las.scale + las.offset_z);
}

}  // namespace
}  // namespace pcl_als
