// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "plan_sets.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace pcl_als::test {
namespace {

constexpr std::int64_t kFar = std::int64_t{1} << 24;
constexpr double kPi = 3.14159265358979323846;

std::vector<LatticePoint> line(int count, std::int64_t dx, std::int64_t dy) {
  std::vector<LatticePoint> points;
  for (int i = 0; i < count; ++i) points.push_back({i * dx, i * dy});
  return points;
}

/// All integer points on a circle about the origin (times a factor).
std::vector<LatticePoint> onCircle(std::int64_t radius_sq, std::int64_t factor) {
  std::vector<LatticePoint> points;
  for (std::int64_t x = 0; x * x <= radius_sq; ++x) {
    const auto y = static_cast<std::int64_t>(std::llround(std::sqrt(radius_sq - x * x)));
    if (x * x + y * y != radius_sq) continue;
    for (const std::int64_t sx : {-x, x})
      for (const std::int64_t sy : {-y, y}) points.push_back({sx * factor, sy * factor});
  }
  return points;
}

std::vector<LatticePoint> plus(std::vector<LatticePoint> a, const std::vector<LatticePoint>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

std::vector<LatticePoint> shifted(std::vector<LatticePoint> points, std::int64_t x,
                                  std::int64_t y) {
  for (LatticePoint& p : points) p.x += x, p.y += y;
  return points;
}

/// A convex curve so flat that its hull has thousands of corners.
std::vector<LatticePoint> parabola(int count) {
  std::vector<LatticePoint> points;
  for (std::int64_t i = -count / 2; i < count / 2; ++i) points.push_back({i * 8, i * i * 4});
  return points;
}

std::vector<LatticePoint> spiral(int count) {
  std::vector<LatticePoint> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 0.05 * i, radius = 20.0 * i;
    points.push_back(
        {std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
  }
  return points;
}

/// A fan of slivers as thin as the lattice allows: neighbouring columns, full height.
std::vector<LatticePoint> neighbouringColumns(int count) {
  std::vector<LatticePoint> points;
  for (int i = 0; i < count; ++i) {
    points.push_back({i % 2, i * (kFar / count)});
    points.push_back({(i + 1) % 2, i * (kFar / count) + 1});
  }
  return points;
}

}  // namespace

std::vector<LatticePoint> randomPlan(int count, std::int64_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<std::int64_t> coordinate(0, size);
  std::vector<LatticePoint> points(count);
  for (LatticePoint& p : points) p.x = coordinate(random), p.y = coordinate(random);
  return points;
}

std::vector<LatticePoint> scanLines(int lines, int per_line, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> jitter(-4, 4);
  std::vector<LatticePoint> points;
  for (int i = 0; i < lines * per_line; ++i) {
    const double across = std::sin(kPi * i / per_line);
    points.push_back({std::llround(200000.0 * across) + jitter(random),
                      std::llround(1500.0 * i / per_line) + jitter(random)});
  }
  return points;
}

std::vector<LatticePoint> grid(int columns, int rows, std::int64_t spacing) {
  std::vector<LatticePoint> points;
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) points.push_back({c * spacing, r * spacing});
  return points;
}

std::vector<PlanSet> nastyPlanSets() {
  const std::vector<LatticePoint> corners{{0, 0}, {kFar, 0}, {0, kFar}, {kFar, kFar}};
  return {
      {"nothing", {}},
      {"one_point", {{5, 7}}},
      {"two_points", {{5, 7}, {9, -2}}},
      {"one_triangle", {{0, 0}, {3, 0}, {0, 4}}},
      {"one_triangle_clockwise", {{0, 0}, {0, 4}, {3, 0}}},
      {"all_on_one_position", std::vector<LatticePoint>(50, LatticePoint{3, 3})},
      {"two_positions_many_times", plus(std::vector<LatticePoint>(9, LatticePoint{3, 3}),
                                        std::vector<LatticePoint>(9, LatticePoint{4, 3}))},
      {"collinear_row", line(100, 7, 0)},
      {"collinear_column", line(100, 0, 7)},
      {"collinear_diagonal", line(1000, 3, 5)},
      {"collinear_falling_diagonal", line(1000, 4, -4)},
      {"row_and_one_point_above", plus(line(200, 5, 0), {{333, 1}})},
      {"column_and_one_point_beside", plus(line(200, 0, 5), {{-1, 777}})},
      {"diagonal_and_far_corner", plus(line(300, 9, 9), {{kFar, 0}})},
      {"two_parallel_rows", plus(line(150, 4, 0), shifted(line(150, 4, 0), 2, 1))},
      {"square", {{0, 0}, {1, 0}, {0, 1}, {1, 1}}},
      {"grid", grid(40, 40, 500)},
      {"grid_of_powers_of_two", grid(33, 33, 1 << 12)},
      {"grid_of_the_finest_step", grid(45, 31, 1)},
      {"grid_so_large_that_doubles_do_not_do", grid(17, 17, kFar / 16)},
      {"many_on_one_circle", onCircle(5LL * 5 * 13 * 13 * 17 * 17 * 29, 1)},
      {"many_on_one_large_circle", onCircle(5LL * 5 * 13 * 13 * 17 * 17 * 29, 1000)},
      {"circle_with_centre", plus(onCircle(25LL * 169 * 289, 7), {{0, 0}})},
      {"full_extent_corners", corners},
      {"full_extent_random", plus(corners, randomPlan(1500, kFar, 5))},
      {"full_extent_almost_collinear",
       {{0, 0}, {kFar, kFar}, {kFar - 1, kFar - 2}, {1, 2}, {1, 1}}},
      {"neighbouring_columns", neighbouringColumns(500)},
      {"two_far_clusters",
       plus(randomPlan(500, 40, 6), shifted(randomPlan(500, 40, 7), kFar - 40, 9))},
      {"cluster_with_outlier", plus(randomPlan(1000, 100, 8), {{kFar, kFar / 3}})},
      {"more_points_than_positions", randomPlan(3000, 20, 9)},
      {"scan_lines", scanLines(12, 160, 10)},
      {"one_scan_line", scanLines(1, 800, 11)},
      {"parabola", parabola(2000)},
      {"spiral", spiral(1500)},
  };
}

}  // namespace pcl_als::test
