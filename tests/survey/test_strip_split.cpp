// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/survey/strip_split.h>

#include "flown_points.h"

namespace pcl_als {
namespace {

using test::Path;

SwathTrack trackOf(const PointChunk& chunk) {
  SwathTrack track;
  track.add(chunk, 0, chunk.size());
  return track;
}

/// Metres per second, of a course in degrees.
Eigen::Vector2d velocity(double speed, double course) {
  const double angle = course * 3.14159265358979 / 180.0;
  return speed * Eigen::Vector2d(std::sin(angle), std::cos(angle));
}

/// The path of a velocity, 90 to 400 s.
Path byVelocity(const std::function<Eigen::Vector2d(double)>& velocity) {
  constexpr double kBegins = 90.0, kStep = 0.01;
  std::vector<Eigen::Vector2d> places{{0.0, 0.0}};
  for (double time = kBegins; time < 400.0; time += kStep)
    places.push_back(places.back() + kStep * velocity(time + 0.5 * kStep));
  return [places](double time) {
    const double at = (time - kBegins) / kStep;
    const auto i = static_cast<std::size_t>(at);
    return Eigen::Vector2d(places[i] + (at - static_cast<double>(i)) * (places[i + 1] - places[i]));
  };
}

/// Line north, hovering of 20 s, passage across, hovering of 5 s, line south; a second of braking
/// and starting each. Multiples of 6 m/s.
Path lineHoverLine(double factor) {
  return byVelocity([factor](double t) {
    const auto ramp = [t](double from, double to) {
      return std::clamp(std::min(t - from, to - t), 0.0, 1.0);
    };
    return Eigen::Vector2d(factor * (velocity(6.0 * ramp(90.0, 130.0), 0.0) +
                                     velocity(3.0 * ramp(150.0, 160.0), 90.0) +
                                     velocity(6.0 * ramp(165.0, 200.0), 180.0)));
  });
}

/// Two lines of 20 s, opposite, with a half circle of 30 s (6 degrees per second) between.
Path lineTurnLine() {
  return [](double t) {
    constexpr double kPi = 3.14159265358979, kSpeed = 60.0, kRadius = kSpeed * 30.0 / kPi;
    if (t < 120.0) return Eigen::Vector2d(0.0, kSpeed * (t - 100.0));
    if (t > 150.0) return Eigen::Vector2d(2.0 * kRadius, kSpeed * (20.0 - (t - 150.0)));
    const double angle = kPi * (t - 120.0) / 30.0;
    return Eigen::Vector2d(kRadius * (1.0 - std::cos(angle)),
                           20.0 * kSpeed + kRadius * std::sin(angle));
  };
}

std::vector<TimeStretch> lines(const std::vector<TimeStretch>& stretches) {
  std::vector<TimeStretch> found;
  for (const TimeStretch& stretch : stretches)
    if (stretch.isLine()) found.push_back(stretch);
  return found;
}

TEST(StripSplit, LongGapsPartLines) {
  PointChunk chunk;
  const Path path = test::straight({500000.0, 5200000.0}, 30.0, 100.0);
  test::scan(chunk, 0, path, 100.0, 108.0);
  test::scan(chunk, 0, path, 130.0, 135.0);  // 22 s, more than StripNaming::kLargestGap
  const auto stretches = splitTrack(trackOf(chunk), nullptr);
  ASSERT_EQ(stretches.size(), 2U);
  EXPECT_DOUBLE_EQ(stretches[0].from, 100.0);
  EXPECT_NEAR(stretches[0].to, 108.0, 1e-3);  // a pulse before
  EXPECT_DOUBLE_EQ(stretches[1].from, 130.0);
  EXPECT_TRUE(stretches[0].isLine() && stretches[1].isLine());
}

TEST(StripSplit, AStraightLineWithAHoleStaysOneLine) {
  PointChunk chunk;
  const Path path = test::straight({500000.0, 5200000.0}, 30.0, 100.0);
  test::scan(chunk, 0, path, 100.0, 108.0);
  test::scan(chunk, 0, path, 118.0, 125.0);
  EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 1U);
  const Trajectory flight = test::flown(path, 99.0, 126.0);
  EXPECT_EQ(splitTrack(trackOf(chunk), &flight).size(), 1U);
}

TEST(StripSplit, AShortGapWithAnotherCourseBehindPartsLines) {
  PointChunk chunk;  // as a drone turns: eight seconds, back beside the first line
  test::scan(chunk, 0, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 110.0);
  test::scan(chunk, 0, test::straight({200.0, 600.0}, 180.0, 118.0), 118.0, 128.0);
  EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 2U);
}

TEST(StripSplit, AShortGapWithTheSameCourseBesideTheLinePartsLines) {
  PointChunk chunk;
  test::scan(chunk, 0, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 110.0);
  test::scan(chunk, 0, test::straight({200.0, -300.0}, 0.0, 118.0), 118.0, 128.0);
  EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 2U);
}

TEST(StripSplit, ATurnIsAStretchOfItsOwn) {
  PointChunk chunk;
  test::scan(chunk, 0, lineTurnLine(), 100.0, 170.0);
  const Trajectory flight = test::flown(lineTurnLine(), 99.0, 171.0);
  for (const Trajectory* known : {static_cast<const Trajectory*>(nullptr), &flight}) {
    const auto stretches = splitTrack(trackOf(chunk), known);
    ASSERT_EQ(stretches.size(), 3U);
    EXPECT_EQ(stretches[1].excluded, ExclusionReason::in_turn);
    // Courses are means over 1 s (trajectory) or 4 s (swath), and are compared 4 s apart.
    EXPECT_NEAR(stretches[1].from, 120.0, 4.0);
    EXPECT_NEAR(stretches[1].to, 150.0, 4.0);
  }
}

TEST(StripSplit, ABendOfTheTrajectoryIsNoTurn) {
  const Path bend = byVelocity(  // 45 degrees in 10 s
      [](double t) { return velocity(60.0, 4.5 * std::clamp(t - 110.0, 0.0, 10.0)); });
  PointChunk chunk;
  test::scan(chunk, 0, bend, 100.0, 130.0);
  const Trajectory flight = test::flown(bend, 99.0, 131.0);
  EXPECT_EQ(splitTrack(trackOf(chunk), &flight).size(), 1U);
  EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 1U);
}

TEST(StripSplit, HoveringAndPassagesAreExcluded) {
  for (const double factor : {0.1, 1.0, 4.0}) {  // 0.6 m/s to 24 m/s
    PointChunk chunk;
    const Path path = lineHoverLine(factor);
    test::scan(chunk, 0, path, 100.0, 195.0);
    const Trajectory flight = test::flown(path, 99.0, 196.0);
    for (const Trajectory* known : {static_cast<const Trajectory*>(nullptr), &flight}) {
      if (known == nullptr && factor < 1.0) continue;  // the centre of the swath is too uncertain
      const auto stretches = splitTrack(trackOf(chunk), known);
      const auto found = lines(stretches);
      ASSERT_EQ(found.size(), 2U);
      const double certain = known == nullptr ? 4.0 : 1.0;
      EXPECT_NEAR(found[0].to, 129.5, certain);
      EXPECT_NEAR(found[1].from, 165.5, certain);
      EXPECT_EQ(stretches[1].excluded, ExclusionReason::hovering);
      EXPECT_EQ(stretches[2].excluded, ExclusionReason::in_turn) << "passage";
    }
  }
}

TEST(StripSplit, SlowAndUnevenFlightIsNoHovering) {
  const Path constant = byVelocity([](double) { return velocity(0.4, 70.0); });
  const Path uneven = byVelocity([](double t) {  // of a helicopter: 8 to 24 m/s
    return velocity(16.0 + 8.0 * std::sin(0.2 * t), 30.0);
  });
  const Path slower = byVelocity([](double t) { return velocity(t < 200.0 ? 60.0 : 10.0, 30.0); });
  for (const Path& path : {constant, uneven, slower}) {
    PointChunk chunk;
    test::scan(chunk, 0, path, 100.0, 300.0);
    const Trajectory flight = test::flown(path, 99.0, 301.0);
    EXPECT_EQ(splitTrack(trackOf(chunk), &flight).size(), 1U);
    EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 1U);
  }
}

TEST(StripSplit, AWindingCorridorStaysOneLine) {
  // Bends of 50 degrees in 30 s to either side, at 20 m/s; up to 2.6 degrees per second.
  const Path path =
      byVelocity([](double t) { return velocity(20.0, 40.0 + 25.0 * std::sin(t / 9.55)); });
  PointChunk chunk;
  test::scan(chunk, 0, path, 100.0, 300.0);
  const Trajectory flight = test::flown(path, 99.0, 301.0);
  EXPECT_EQ(splitTrack(trackOf(chunk), &flight).size(), 1U);
  EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 1U);
}

TEST(StripSplit, WholeSecondsAreNoGaps) {
  PointChunk chunk;
  for (int second = 0; second < 20; ++second)
    for (int i = 0; i < 10; ++i)
      test::addPoint(chunk, 0, 1000.0 + second, {5.0 * second, static_cast<double>(i)});
  EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 1U);
}

TEST(StripSplit, OrderAndFilesChangeNothing) {
  PointChunk chunk;
  test::scan(chunk, 0, lineTurnLine(), 100.0, 170.0);
  std::vector<std::size_t> order(chunk.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  SwathTrack one, other;
  for (const std::size_t i : order) (i % 3 == 0 ? one : other).add(chunk, i, i + 1);
  other.merge(one);
  const auto expected = splitTrack(trackOf(chunk), nullptr), found = splitTrack(other, nullptr);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].from, expected[i].from);
    EXPECT_EQ(found[i].to, expected[i].to);
  }
}

bool leadsBack(const PointChunk& chunk) {
  const SwathTrack track = trackOf(chunk);
  return leadBack(track, splitTrack(track, nullptr));
}

TEST(LeadBack, LinesFlownBackAndForthAre) {
  PointChunk chunk;
  test::scan(chunk, 5, lineTurnLine(), 100.0, 170.0);
  EXPECT_TRUE(leadsBack(chunk));
  PointChunk apart;  // two lines without the turn between
  test::scan(apart, 5, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 120.0);
  test::scan(apart, 5, test::straight({200.0, 1200.0}, 180.0, 300.0), 300.0, 320.0);
  EXPECT_TRUE(leadsBack(apart));
}

TEST(LeadBack, TheSameLineFlownTwiceIs) {
  PointChunk chunk;
  test::scan(chunk, 5, test::straight({0.0, 0.0}, 30.0, 100.0), 100.0, 115.0);
  test::scan(chunk, 5, test::straight({0.0, 0.0}, 30.0, 600.0), 600.0, 615.0);
  EXPECT_TRUE(leadsBack(chunk));
}

TEST(LeadBack, ALineThatContinuesIsNot) {
  PointChunk lake;  // 40 s without points
  test::scan(lake, 5, test::straight({0.0, 0.0}, 0.0, 100.0), 100.0, 115.0);
  test::scan(lake, 5, test::straight({0.0, 3300.0}, 5.0, 155.0), 155.0, 170.0);
  EXPECT_FALSE(leadsBack(lake));
  PointChunk bend;  // a turn of 100 degrees in 20 s
  test::scan(bend, 5, byVelocity([](double t) {
               return velocity(40.0, 5.0 * std::clamp(t - 130.0, 0.0, 20.0));
             }),
             100.0, 190.0);
  EXPECT_FALSE(leadsBack(bend));
}

// A conical scanner measures a small area ahead of the sensor and, 1.2 s later, again behind it: no
// platform turns back at 60 m/s in that time, nor in the 9.4 s of a half circle at 20 m/s^2.
TEST(LeadBack, TwoLooksAtASmallAreaAreNot) {
  for (const double gap : {1.2, 9.0, 9.8}) {
    PointChunk chunk;
    const double again = 101.5 + gap;
    test::scan(chunk, 5, test::straight({0.0, 0.0}, 30.0, 100.0), 100.0, 101.5);
    test::scan(chunk, 5, test::straight({0.0, 0.0}, 30.0, again), again, again + 1.5);
    std::vector<TimeStretch> stretches{{100.0, 101.5, {}}, {again, again + 1.5, {}}};
    EXPECT_EQ(leadBack(trackOf(chunk), stretches), gap > 9.5) << gap;
    if (gap < 2.0) {
      EXPECT_EQ(splitTrack(trackOf(chunk), nullptr).size(), 2U);
    }
  }
}

TEST(LeadBack, APlatformThatMostlyHoversHasNoCertainLines) {
  PointChunk chunk;
  test::scan(chunk, 5, byVelocity([](double t) {
               const bool out = t > 160.0 && t<168.0, back = t> 240.0 && t < 248.0;
               return velocity(out || back ? 6.0 : 0.0, back ? 180.0 : 0.0);
             }),
             100.0, 320.0);
  EXPECT_FALSE(leadsBack(chunk));
}

TEST(SwathTrack, MemoryIsBounded) {
  SwathTrack track;
  PointChunk chunk;
  chunk.resize(3 * SwathTrack::kMostBins);
  for (std::size_t i = 0; i < chunk.size(); ++i)
    chunk.gps_time[i] = 0.15 * static_cast<double>(i + 1);
  track.add(chunk, 0, chunk.size());
  EXPECT_LE(track.bins().size(), SwathTrack::kMostBins);
  EXPECT_EQ(track.pointCount(), chunk.size());
}

}  // namespace
}  // namespace pcl_als
