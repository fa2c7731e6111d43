// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/survey/strip_assignment.h>

#include "flown_points.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using Names = std::vector<std::string>;

/// Three lines of 8 s that follow each other with gaps; ids as given.
std::vector<SurveyedFile> threeLines(std::uint16_t a, std::uint16_t b, std::uint16_t c) {
  PointChunk chunk;
  test::scan(chunk, a, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 108.0);
  test::scan(chunk, b, test::straight({100.0, 480.0}, 180.0, 200.0), 200.0, 208.0);
  test::scan(chunk, c, test::straight({200.0, 0.0}, 0.0, 300.0), 300.0, 308.0);
  return {test::surveyed("block.las", chunk)};
}

/// Points of each label when every hundredth of a second has one of an id.
std::vector<std::uint64_t> countLabels(const StripAssignment& arrangement, std::uint16_t id,
                                       double from, double to) {
  StripAssignment::Assigner sorter(arrangement, 0);
  std::vector<std::uint64_t> counts(arrangement.labels().size(), 0);
  const auto steps = static_cast<int>(std::lround((to - from) / 0.01));
  for (int i = 0; i < steps; ++i) ++counts[sorter.label(id, from + 0.01 * i)];
  return counts;
}

const Trajectory& flight(double from, double to) {
  static std::map<std::pair<double, double>, Trajectory> kept;
  const auto found = kept.find({from, to});
  if (found != kept.end()) return found->second;
  return kept
      .emplace(std::pair(from, to), test::flown(test::straight({0.0, 0.0}, 0.0, 100.0), from, to))
      .first->second;
}

TEST(StripAssignment, ChoosesStripsByName) {
  const auto files = threeLines(1, 2, 3);
  EXPECT_EQ(StripAssignment(files, {}, {}).names(), (Names{"1", "2", "3"}));
  EXPECT_EQ(StripAssignment(files, {{"3", "1"}, {}}, {}).names(), (Names{"1", "3"}));
  const StripAssignment without(files, {{}, {"2"}}, {});
  EXPECT_EQ(without.names(), (Names{"1", "3"}));
  const auto left = without.excludedPoints(countLabels(without, 2, 200.0, 208.0));
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].strip, "2");
  EXPECT_EQ(left[0].reason, ExclusionReason::excluded);
  EXPECT_EQ(left[0].points, 800U);
}

TEST(StripAssignment, DividesAStripThatIsCertainlySeveralLines) {
  const auto files = threeLines(4, 4, 4);
  EXPECT_EQ(StripAssignment(files, {}, {}).names(), (Names{"4"}));
  StripChoice choice;
  choice.divide_lines = true;
  const StripAssignment arrangement(files, choice, {});
  EXPECT_EQ(arrangement.names(), (Names{"4.1", "4.2", "4.3"}));
  ASSERT_EQ(arrangement.divisions().size(), 1U);
  EXPECT_EQ(arrangement.divisions()[0],
            "strip 4 holds 3 flight lines, which lead back and forth, and is divided into 4.1, "
            "4.2, 4.3");
  // The number names all of its lines, that of a line only this one.
  choice.only = {"4"};
  EXPECT_EQ(StripAssignment(files, choice, {}).names(), (Names{"4.1", "4.2", "4.3"}));
  choice.without = {"4.2"};
  EXPECT_EQ(StripAssignment(files, choice, {}).names(), (Names{"4.1", "4.3"}));
  // Strips with a line each are left as they are.
  choice = {};
  choice.divide_lines = true;
  const auto strips = threeLines(1, 2, 3);
  const StripAssignment single(strips, choice, {});
  EXPECT_EQ(single.names(), (Names{"1", "2", "3"}));
  EXPECT_TRUE(single.divisions().empty());
}

TEST(StripAssignment, StripsOfOnePassHaveTheSameTimes) {
  PointChunk chunk;
  test::scan(chunk, 1, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 120.0);
  test::scan(chunk, 2, test::straight({0.0, 0.0}, 0.0, 100.0), 104.0, 116.0);
  test::scan(chunk, 3, test::straight({0.0, 1500.0}, 180.0, 119.0), 119.0, 140.0);
  const std::vector<SurveyedFile> files{test::surveyed("pass.las", chunk)};
  const StripAssignment arrangement(files, {}, {});
  EXPECT_TRUE(arrangement.areOfOnePass(0, 1));
  EXPECT_TRUE(arrangement.areOfOnePass(1, 0));
  EXPECT_FALSE(arrangement.areOfOnePass(0, 2)) << "one second of twenty";
  EXPECT_FALSE(arrangement.areOfOnePass(1, 2));
}

TEST(StripAssignment, SplitsThroughTheEndOfAWeekAsAtOtherTimes) {
  PointChunk chunk;
  test::scan(chunk, 0, test::straight({0.0, 0.0}, 0.0, 604796.0), 604796.0, 604804.0);
  test::scan(chunk, 0, test::straight({100.0, 480.0}, 180.0, 604896.0), 604896.0, 604904.0);
  for (double& time : chunk.gps_time) time = std::fmod(time, 604800.0);
  const std::vector<SurveyedFile> files{test::surveyed("week.las", chunk)};
  StripChoice choice;
  choice.split = true;
  const StripAssignment arrangement(files, choice, {});
  EXPECT_EQ(arrangement.names(), (Names{"line1", "line2"}));
  StripAssignment::Assigner sorter(arrangement, 0);
  EXPECT_EQ(sorter.label(0, 604797.0), sorter.label(0, 3.0));
  EXPECT_NE(sorter.label(0, 3.0), sorter.label(0, 99.0));
}

TEST(StripAssignment, AnUnknownNameIsRefusedWithThoseThereAre) {
  const auto files = threeLines(1, 2, 3);
  EXPECT_EQ(test::messageOf<UsageError>([&] {
              StripAssignment(files, {{"7"}, {}}, {});
            }),
            "option -strips: there is no strip '7'; there are 1, 2, 3");
  EXPECT_NE(test::messageOf<UsageError>([&] {
              StripAssignment(files, {{}, {"a"}}, {});
            }).find("-without: there is no strip 'a'"),
            std::string::npos);
}

TEST(StripAssignment, PointsOutsideTheTrajectoryAreExcludedAndTheRestIsUsed) {
  const auto files = threeLines(1, 2, 3);
  FlownTimes times;
  times.trajectory = &flight(100.5, 305.0);
  const StripAssignment arrangement(files, {}, times);
  EXPECT_EQ(arrangement.names(), (Names{"1", "2", "3"}));
  const auto first = arrangement.excludedPoints(countLabels(arrangement, 1, 100.0, 108.0));
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].reason, ExclusionReason::before_trajectory);
  EXPECT_EQ(first[0].points, 50U);
  EXPECT_EQ(first[0].of, 800U);
  const auto last = arrangement.excludedPoints(countLabels(arrangement, 3, 300.0, 308.0));
  ASSERT_EQ(last.size(), 1U);
  EXPECT_EQ(last[0].reason, ExclusionReason::after_trajectory);
  EXPECT_NEAR(static_cast<double>(last[0].points), 300.0, 1.0);  // the sample at 305 s itself
}

TEST(StripAssignment, AGapOfTheTrajectoryCostsItsPointsOnly) {
  const auto files = threeLines(1, 2, 3);
  std::vector<TrajectorySample> samples;
  for (int i = 0; i <= 3000; ++i) {
    const double time = 90.0 + 0.1 * i;
    if (time > 203.0 && time < 205.0) continue;
    TrajectorySample sample;
    sample.time = time;
    sample.position = {0.0, 60.0 * time, 1000.0};
    samples.push_back(sample);
  }
  const Trajectory trajectory(std::move(samples));
  ASSERT_EQ(trajectory.gaps().size(), 1U);
  FlownTimes times;
  times.trajectory = &trajectory;
  const StripAssignment arrangement(files, {}, times);
  const auto left = arrangement.excludedPoints(countLabels(arrangement, 2, 200.0, 208.0));
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].reason, ExclusionReason::in_trajectory_gap);
  EXPECT_NEAR(static_cast<double>(left[0].points), 200.0, 12.0);  // between samples of 0.1 s
}

TEST(StripAssignment, AStripThatIsHardlyCoveredIsExcludedByName) {
  const auto files = threeLines(1, 2, 3);
  FlownTimes times;
  times.trajectory = &flight(90.0, 300.3);
  const StripAssignment arrangement(files, {}, times);
  EXPECT_EQ(arrangement.names(), (Names{"1", "2"}));
  const auto left = arrangement.excludedPoints(countLabels(arrangement, 3, 300.0, 308.0));
  ASSERT_EQ(left.size(), 1U);
  EXPECT_EQ(left[0].reason, ExclusionReason::strip_uncovered);
  times.needed = false;
  EXPECT_EQ(StripAssignment(files, {}, times).names(), (Names{"1", "2", "3"}));
}

TEST(StripAssignment, PointsOfTimeZeroAreNoStripAmongOthers) {
  PointChunk chunk;
  test::scan(chunk, 5, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 104.0);
  for (int i = 0; i < 20; ++i) test::addPoint(chunk, 0, 0.0, {10.0, 10.0});
  for (int i = 0; i < 30; ++i) test::addPoint(chunk, 5, 0.0, {10.0, 10.0});
  const std::vector<SurveyedFile> files{test::surveyed("tile.las", chunk)};
  const StripAssignment arrangement(files, {}, {});
  EXPECT_EQ(arrangement.names(), Names{"5"});
  StripAssignment::Assigner sorter(arrangement, 0);
  EXPECT_EQ(arrangement.labels()[sorter.label(0, 0.0)].reason, ExclusionReason::zero_time);
  EXPECT_EQ(arrangement.labels()[sorter.label(5, 0.0)].index, -1);
  EXPECT_EQ(arrangement.labels()[sorter.label(5, 101.0)].index, 0);
}

TEST(StripAssignment, FilesWithoutAnyTimeAreStripsUnlessATrajectoryIsNeeded) {
  PointChunk chunk;
  for (int i = 0; i < 20; ++i) test::addPoint(chunk, 4, 0.0, {10.0, 10.0});
  PointChunk other;
  test::scan(other, 5, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 104.0);
  const std::vector<SurveyedFile> files{test::surveyed("a.las", chunk),
                                        test::surveyed("b.las", other)};
  EXPECT_EQ(StripAssignment(files, {}, {}).names(), (Names{"4", "5"}));
  FlownTimes times;
  times.trajectory = &flight(90.0, 110.0);
  EXPECT_EQ(StripAssignment(files, {}, times).names(), Names{"5"});
}

TEST(StripAssignment, SplitsPointsWithoutSourceIdIntoLines) {
  const auto files = threeLines(0, 0, 0);
  EXPECT_EQ(StripAssignment(files, {}, {}).names(), Names{"block"});
  const StripAssignment arrangement(files, {{}, {}, true}, {});
  EXPECT_EQ(arrangement.names(), (Names{"line1", "line2", "line3"}));
  StripAssignment::Assigner sorter(arrangement, 0);
  EXPECT_EQ(arrangement.labels()[sorter.label(0, 107.9)].index, 0);
  EXPECT_EQ(arrangement.labels()[sorter.label(0, 200.0)].index, 1);
  EXPECT_EQ(arrangement.labels()[sorter.label(0, 104.0)].index, 0);  // out of order
  EXPECT_EQ(StripAssignment(files, {{}, {"line2"}, true}, {}).names(), (Names{"line1", "line3"}));
}

TEST(StripAssignment, SplitPartsASourceIdOnlyWhereItHoldsSeveralLines) {
  EXPECT_EQ(StripAssignment(threeLines(7, 7, 8), {{}, {}, true}, {}).names(),
            (Names{"7.1", "7.2", "8"}));
}

TEST(StripAssignment, SplitDoesNotDependOnFiles) {
  PointChunk all;
  test::scan(all, 0, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 108.0);
  test::scan(all, 0, test::straight({100.0, 480.0}, 180.0, 200.0), 200.0, 208.0);
  PointChunk north, south;
  for (std::size_t i = 0; i < all.size(); ++i)
    test::addPoint(all.y[i] > 240.0 ? north : south, 0, all.gps_time[i], {all.x[i], all.y[i]});
  const std::vector<SurveyedFile> tiles{test::surveyed("n.las", north),
                                        test::surveyed("s.las", south)};
  const StripAssignment arrangement(tiles, {{}, {}, true}, {});
  EXPECT_EQ(arrangement.names(), (Names{"line1", "line2"}));
  EXPECT_EQ(arrangement.expectedPoints(), (std::vector<std::uint64_t>{16000, 16000}));
}

}  // namespace
}  // namespace pcl_als
