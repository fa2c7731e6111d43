// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <random>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/photogrammetry/roof_lines.h>
#include <pcl_als/simulation/image_flight.h>
#include <pcl_als/simulation/simulator.h>

namespace pcl_als {
namespace {

using Eigen::Vector3d;

/// A gable roof over level ground: ridge along y at x = 0, height 10 m, from y = -8 to 8.
std::vector<Vector3d> gable(double noise, double spacing, unsigned seed, bool valley = false) {
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, noise);
  std::uniform_real_distribution<double> place(-20.0, 20.0);
  const auto count = static_cast<int>(1600.0 / (spacing * spacing));
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    Vector3d p(place(random), place(random), 0.0);
    const bool roof = std::abs(p.x()) < 5.0 && std::abs(p.y()) < 8.0;
    if (roof) p.z() = valley ? 7.0 + 0.6 * std::abs(p.x()) : 10.0 - 0.6 * std::abs(p.x());
    p.z() += noise > 0.0 ? error(random) : 0.0;
    points.push_back(p);
  }
  return points;
}

TEST(RoofLines, ExactPlanesGiveTheExactRidge) {
  const auto lines = findRoofLines(gable(0.0, 0.5, 1));
  ASSERT_EQ(lines.size(), 1U);
  const ObjectLine& ridge = lines.front().line;
  EXPECT_EQ(ridge.kind, ObjectLine::Kind::ridge);
  for (const Vector3d& end : {ridge.start, ridge.end}) {
    // Points up to 3 cm below the other plane, at the ridge, may belong to either face.
    EXPECT_NEAR(end.x(), 0.0, 1e-3);
    EXPECT_NEAR(end.z(), 10.0, 1e-3);
    EXPECT_NEAR(std::abs(end.y()), 8.0, 1.0);  // two point spacings
  }
  EXPECT_NEAR(lines.front().angle, 2.0 * std::atan(0.6), 1e-3);
}

TEST(RoofLines, AValleyIsOne) {
  const auto lines = findRoofLines(gable(0.01, 0.5, 2, true));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines.front().line.kind, ObjectLine::Kind::valley);
}

TEST(RoofLines, OffsetsOfManyRoofsHaveTheirCovariance) {
  Eigen::Vector4d squares = Eigen::Vector4d::Zero();
  double whole = 0.0, count = 0.0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const auto lines = findRoofLines(gable(0.02, 0.6, seed));
    ASSERT_EQ(lines.size(), 1U) << seed;
    const ObjectLine& line = lines.front().line;
    Eigen::Vector4d offsets;
    const Eigen::Matrix<double, 3, 2> across = acrossLine(line.end - line.start);
    offsets << across.transpose() * Vector3d(line.start.x(), 0.0, line.start.z() - 10.0),
        across.transpose() * Vector3d(line.end.x(), 0.0, line.end.z() - 10.0);
    squares += offsets.cwiseAbs2().cwiseQuotient(line.covariance.diagonal());
    whole += offsets.dot(line.covariance.ldlt().solve(offsets));
    count += 1.0;
  }
  // 150 values: the RMS has a standard deviation of 0.06.
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(std::sqrt(squares[i] / count), 1.0, 0.2) << i;
  EXPECT_NEAR(std::sqrt(whole / (4.0 * count)), 1.0, 0.15);
}

TEST(RoofLines, FlatRoofsAndTerrainHaveNone) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 60.0);
  std::vector<Vector3d> points;
  for (int i = 0; i < 12000; ++i) {
    Vector3d p(place(random), place(random), 0.0);
    p.z() = 3.0 * std::sin(p.x() / 15.0) + 0.2 * p.y();
    if (std::abs(p.x() - 30.0) < 7.0 && std::abs(p.y() - 30.0) < 9.0) p.z() = 18.0;
    points.push_back(p);
  }
  EXPECT_TRUE(findRoofLines(points).empty());
  EXPECT_TRUE(findRoofLines({}).empty());
}

TEST(RoofLines, ThreadsDoNotChangeTheResult) {
  RoofLineSettings one, four;
  one.threads = 1;
  four.threads = 4;
  one.tile = four.tile = 60.0;
  const auto points = gable(0.02, 0.5, 5);
  const auto a = findRoofLines(points, one), b = findRoofLines(points, four);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].line.start, b[i].line.start);
}

TEST(RoofLines, ImpossibleSettingsAreRefused) {
  RoofLineSettings settings;
  settings.least_area = 0.0;
  EXPECT_THROW(findRoofLines({}, settings), UsageError);
}

TEST(CombineLines, StripErrorsAreEstimatedAndReduced) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  std::vector<std::vector<StripLine>> strips(3);
  constexpr double kPlan = 0.05, kHeight = 0.03, kPlanes = 0.01;
  for (int i = 0; i < 120; ++i) {
    const double azimuth = 0.05 * i;
    const Vector3d along(8.0 * std::cos(azimuth), 8.0 * std::sin(azimuth), 0.0);
    const Vector3d middle(40.0 * i, 0.0, 10.0);
    for (auto& strip : strips) {
      StripLine line;
      line.line.kind = ObjectLine::Kind::ridge;
      const Eigen::Matrix<double, 3, 2> across = acrossLine(along);
      const Vector3d common =
          across * Eigen::Vector2d(kPlan * normal(random), kHeight * normal(random));
      const auto own = [&] {
        return Vector3d(across *
                        Eigen::Vector2d(kPlanes * normal(random), kPlanes * normal(random)));
      };
      line.line.start = middle - along + common + own();
      line.line.end = middle + along + common + own();
      line.line.covariance = kPlanes * kPlanes * Eigen::Matrix4d::Identity();
      strip.push_back(line);
    }
  }
  LineErrors found;
  const auto lines = combineLines(strips, {"1", "2", "3"}, 1.0, {0.0, 0.0, 0}, &found);
  ASSERT_EQ(lines.size(), 120U);
  EXPECT_EQ(lines.front().strips.size(), 3U);
  EXPECT_NEAR(found.plan, kPlan, 0.012);  // of 240 differences, half of them independent
  EXPECT_NEAR(found.height, kHeight, 0.008);
  double squares = 0.0;
  for (const ObjectLine& line : lines) {
    const Vector3d middle = 0.5 * (line.start + line.end);
    squares += std::pow(middle.z() - 10.0, 2) / line.covariance(1, 1);
  }
  EXPECT_NEAR(std::sqrt(squares / 120.0), 1.0, 0.25);
}

/// Surface points of a strip as a tool reads them.
std::vector<Vector3d> surfaceOf(const simulation::Simulator& simulator, std::size_t strip,
                                const Vector3d& origin, bool unbiased) {
  std::vector<Vector3d> points;
  simulator.simulateStrip(strip, 2, [&](const std::vector<simulation::SimulatedPoint>& part) {
    for (const simulation::SimulatedPoint& p : part)
      if (p.return_number >= p.number_of_returns && p.classification != 5)
        points.push_back((unbiased ? p.unbiased : p.position) - origin);
  });
  return points;
}

TEST(RoofLines, OfASimulatedSuburbAgreeWithItsRidges) {
  // Position of the middle and change along the line, left and up, from the offsets of the ends.
  Eigen::Matrix4d parts;
  parts << 0.5, 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 0.5, -1.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 1.0;
  Eigen::Vector4d part_squares = Eigen::Vector4d::Zero();
  double squares = 0.0, count = 0.0, missing = 0.0, false_lines = 0.0, ridges_seen = 0.0;
  for (const std::uint64_t seed : {1, 2}) {
    auto options = simulation::SimulationOptions::preset("small", 1.0, 3.0);
    options.noise = simulation::NoiseOptions::named("range");
    options.seed = seed;
    const simulation::Simulator simulator(options);
    const auto truth = simulation::ridgesOf(simulator.scene(), options.origin);
    for (const std::size_t strip : {2U, 3U}) {
      const auto lines = findRoofLines(surfaceOf(simulator, strip, options.origin, true));
      std::vector<bool> seen(truth.size(), false);
      for (const StripLine& found : lines) {
        const ObjectLine& line = found.line;
        const Vector3d middle = options.origin + 0.5 * (line.start + line.end);
        bool good = false;
        for (std::size_t i = 0; i < truth.size(); ++i) {
          const Vector3d along = (truth[i].end - truth[i].start).normalized();
          const Vector3d from = middle - truth[i].start;
          const Vector3d off = from - along.dot(from) * along;
          if (off.norm() > 0.5 || along.dot(from) < -1.0 ||
              along.dot(from) > truth[i].length() + 1.0)
            continue;
          good = seen[i] = true;
          const Eigen::Matrix<double, 3, 2> across = acrossLine(line.end - line.start);
          Eigen::Vector4d offsets;
          for (int end = 0; end < 2; ++end) {
            const Vector3d at =
                options.origin + (end == 0 ? line.start : line.end) - truth[i].start;
            offsets.segment<2>(2 * end) = across.transpose() * (at - along.dot(at) * along);
          }
          squares += offsets.dot(line.covariance.ldlt().solve(offsets)) / 4.0;
          part_squares +=
              (parts * offsets)
                  .cwiseAbs2()
                  .cwiseQuotient((parts * line.covariance * parts.transpose()).diagonal());
          count += 1.0;
        }
        if (!good) false_lines += 1.0;
      }
      for (std::size_t i = 0; i < truth.size(); ++i) {
        const Vector3d middle = 0.5 * (truth[i].start + truth[i].end) - options.origin;
        const auto& plan = options.lines[strip];
        // Lines from west to east: the part of the swath that is surely covered.
        if (std::abs(middle.y() - plan.start.y()) > 170.0 ||
            std::abs(middle.x()) > 0.5 * std::abs(plan.end.x() - plan.start.x()) - 30.0)
          continue;
        ridges_seen += 1.0;
        if (!seen[i]) missing += 1.0;
      }
    }
  }
  std::printf(
      "%.0f lines, RMS of normalised errors %.3f, %.0f of %.0f ridges missing, %.0f false\n", count,
      std::sqrt(squares / count), missing, ridges_seen, false_lines);
  ASSERT_GT(count, 60.0);
  // Left, up, azimuth, inclination: some 200 values each, whose RMS has a standard deviation of 5
  // %.
  for (int i = 0; i < 4; ++i) {
    EXPECT_GT(std::sqrt(part_squares[i] / count), 0.8) << i;
    EXPECT_LT(std::sqrt(part_squares[i] / count), 1.25) << i;
  }
  EXPECT_GT(std::sqrt(squares / count), 0.8);
  EXPECT_LT(std::sqrt(squares / count), 1.25);
  EXPECT_LT(missing / ridges_seen, 0.15);
  EXPECT_LT(false_lines / count, 0.03);
}

}  // namespace
}  // namespace pcl_als
