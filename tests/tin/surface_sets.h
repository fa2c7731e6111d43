// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Core>

namespace pcl_als::test {

/// Height of a scene of 60 m x 60 m (repeated outside): rolling ground, gable roofs with eaves 5 m
/// and ridges 8 m above it over [15, 25] x [10, 30] and one flat roof over [35, 50] x [35, 45].
inline double sceneHeight(double x, double y) {
  const double ground = std::sin(x / 9.0) + 0.7 * std::cos(y / 7.0);
  if (x >= 15.0 && x <= 25.0 && y >= 10.0 && y <= 30.0) return 8.0 - 0.6 * std::abs(x - 20.0);
  if (x >= 35.0 && x <= 50.0 && y >= 35.0 && y <= 45.0) return 7.0;
  return ground;
}

/// Random points on it, plan on whole millimetres, heights with Gaussian noise (metres).
inline std::vector<Eigen::Vector3d> scenePoints(int count, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> plan(0.0, 60.0);
  std::normal_distribution<double> error(0.0, noise);
  std::vector<Eigen::Vector3d> points(count);
  for (Eigen::Vector3d& p : points) {
    const double x = std::round(plan(random) * 1000.0) / 1000.0;
    const double y = std::round(plan(random) * 1000.0) / 1000.0;
    p = {x, y, sceneHeight(x, y) + (noise > 0.0 ? error(random) : 0.0)};
  }
  return points;
}

/// A grid of points on a plane: z = a x + b y over [0, size]^2, every \a step metres.
inline std::vector<Eigen::Vector3d> planePoints(double a, double b, double size, double step) {
  std::vector<Eigen::Vector3d> points;
  const int steps = static_cast<int>(std::lround(size / step));
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      points.emplace_back(i * step, j * step, a * i * step + b * j * step);
  return points;
}

}  // namespace pcl_als::test
