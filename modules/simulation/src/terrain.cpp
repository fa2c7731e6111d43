// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/simulation/terrain.h>

#include "random.h"

namespace pcl_als::simulation {

namespace {

constexpr double kNode = 10.0;       ///< metres between the nodes of the spline
constexpr double kHillCell = 400.0;  ///< metres: one hill in each
constexpr long kHillReach = 2;       ///< cells: a hill ends 5.5 radii from its top

struct Ridge {
  double height, kx, ky, phase;
};
struct Hill {
  double height, x, y, radius;

  double at(double px, double py) const {
    const double distance_sq = ((px - x) * (px - x) + (py - y) * (py - y)) / (radius * radius);
    return distance_sq < 30.0 ? height * std::exp(-0.5 * distance_sq) : 0.0;
  }
};

/// Long ridges of falling height and length, and a hill or hollow in every cell of 400 m.
struct Relief {
  std::vector<Ridge> ridges;
  std::vector<Hill> hills;  ///< cell after cell
  Eigen::Vector2d first_cell{0, 0};
  long columns = 0, rows = 0;

  Relief(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, double factor,
         double mountains, std::uint64_t seed) {
    constexpr std::array<std::array<double, 2>, 5> kRidges = {
        {{14.0, 1130.0}, {9.0, 640.0}, {6.0, 390.0}, {3.0, 240.0}, {0.8, 110.0}}};
    Random random(keyOf({seed, 0x7E}));
    const double first_azimuth = random.uniform(0.0, kPi);
    for (std::size_t i = 0; i < kRidges.size(); ++i) {
      const double azimuth = first_azimuth + 1.1 * static_cast<double>(i);
      const double wave = 2.0 * kPi / kRidges[i][1];
      ridges.push_back({factor * kRidges[i][0], wave * std::cos(azimuth), wave * std::sin(azimuth),
                        random.uniform(0.0, 2.0 * kPi)});
    }
    addMountains(mountains, seed);
    first_cell = (minimum / kHillCell).array().floor() - kHillReach;
    const Eigen::Vector2d last = (maximum / kHillCell).array().floor() + kHillReach;
    columns = std::lround(last.x() - first_cell.x()) + 1;
    rows = std::lround(last.y() - first_cell.y()) + 1;
    for (long row = 0; row < rows; ++row)
      for (long column = 0; column < columns; ++column) {
        hills.push_back(hillOf(first_cell.x() + static_cast<double>(column),
                               first_cell.y() + static_cast<double>(row), seed));
        hills.back().height *= factor;
      }
  }

  void addMountains(double amplitude, std::uint64_t seed) {
    constexpr std::array<std::array<double, 2>, 2> kShares = {{{0.65, 3400.0}, {0.35, 1700.0}}};
    Random random(keyOf({seed, 0x3017}));
    const double first_azimuth = random.uniform(0.0, kPi);
    for (std::size_t i = 0; i < kShares.size() && amplitude > 0.0; ++i) {
      const double azimuth = first_azimuth + 0.9 * static_cast<double>(i);
      const double wave = 2.0 * kPi / kShares[i][1];
      ridges.push_back({amplitude * kShares[i][0], wave * std::cos(azimuth),
                        wave * std::sin(azimuth), random.uniform(0.0, 2.0 * kPi)});
    }
  }

  /// The hill of a cell depends on the cell only: a wider scene keeps the hills of a smaller one.
  static Hill hillOf(double column, double row, std::uint64_t seed) {
    Random random(keyOf({seed, 0x811, static_cast<std::uint64_t>(std::lround(column)),
                         static_cast<std::uint64_t>(std::lround(row))}));
    const double radius = random.uniform(50.0, 90.0);
    const double height = radius * random.uniform(0.18, 0.44);
    const double x = kHillCell * (column + random.uniform());
    const double y = kHillCell * (row + random.uniform());
    return {random.chance(0.3) ? -height : height, x, y, radius};
  }

  double at(double x, double y) const {
    double z = 0.0;
    for (const Ridge& r : ridges) z += r.height * std::sin(r.kx * x + r.ky * y + r.phase);
    const long column = std::lround(std::floor(x / kHillCell) - first_cell.x());
    const long row = std::lround(std::floor(y / kHillCell) - first_cell.y());
    for (long j = std::max(0L, row - kHillReach); j <= std::min(rows - 1, row + kHillReach); ++j)
      for (long i = std::max(0L, column - kHillReach);
           i <= std::min(columns - 1, column + kHillReach); ++i)
        z += hills[static_cast<std::size_t>(j * columns + i)].at(x, y);
    return z;
  }
};

using Weights = std::array<double, 4>;

/// Uniform cubic B-spline basis at u in [0, 1].
Weights basis(double u) {
  const double v = 1.0 - u, u2 = u * u, u3 = u2 * u;
  return {v * v * v / 6.0, (3.0 * u3 - 6.0 * u2 + 4.0) / 6.0,
          (-3.0 * u3 + 3.0 * u2 + 3.0 * u + 1.0) / 6.0, u3 / 6.0};
}

/// Its derivative by u.
Weights basisSlope(double u) {
  const double v = 1.0 - u, u2 = u * u;
  return {-0.5 * v * v, 1.5 * u2 - 2.0 * u, -1.5 * u2 + u + 0.5, 0.5 * u2};
}

/// Cell and place in it; beyond the border the border's value holds.
std::pair<std::ptrdiff_t, double> locate(double value, double minimum, std::ptrdiff_t nodes) {
  const double place = std::clamp((value - minimum) / kNode, 1.0, static_cast<double>(nodes) - 2.0);
  const std::ptrdiff_t cell = std::min(static_cast<std::ptrdiff_t>(place), nodes - 3);
  return {cell, place - static_cast<double>(cell)};
}

}  // namespace

Terrain::Terrain(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, double relief,
                 std::uint64_t seed, double mountains)
    // Whole nodes: a wider scene of the same seed has the same terrain, but for a shift in height.
    : minimum_((minimum / kNode).array().floor() * kNode - 2.0 * kNode) {
  const Eigen::Vector2d size = (maximum - minimum_) / kNode;
  columns_ = static_cast<std::ptrdiff_t>(std::ceil(size.x())) + 3;
  rows_ = static_cast<std::ptrdiff_t>(std::ceil(size.y())) + 3;
  coefficients_.reserve(static_cast<std::size_t>(columns_ * rows_));
  const Relief shape(minimum, maximum, relief, mountains, seed);
  double sum = 0.0;
  for (std::ptrdiff_t row = 0; row < rows_; ++row)
    for (std::ptrdiff_t column = 0; column < columns_; ++column) {
      coefficients_.push_back(shape.at(minimum_.x() + kNode * static_cast<double>(column),
                                       minimum_.y() + kNode * static_cast<double>(row)));
      sum += coefficients_.back();
    }
  const double mean = sum / static_cast<double>(coefficients_.size());
  for (double& c : coefficients_) c -= mean;
  const auto [lowest, highest] = std::minmax_element(coefficients_.begin(), coefficients_.end());
  lowest_ = *lowest;
  highest_ = *highest;
  // A B-spline's derivatives are averages of its coefficients' differences.
  double east = 0.0, north = 0.0;
  for (std::ptrdiff_t i = 0; i + columns_ < columns_ * rows_; ++i) {
    east = std::max(east, std::abs(coefficients_[i + 1] - coefficients_[i]) *
                              ((i + 1) % columns_ == 0 ? 0.0 : 1.0));
    north = std::max(north, std::abs(coefficients_[i + columns_] - coefficients_[i]));
  }
  maximum_slope_ = std::hypot(east, north) / kNode;
}

double Terrain::height(double x, double y) const {
  Eigen::Vector2d gradient;
  return height(x, y, gradient);
}

double Terrain::height(double x, double y, Eigen::Vector2d& gradient) const {
  const auto [column, u] = locate(x, minimum_.x(), columns_);
  const auto [row, v] = locate(y, minimum_.y(), rows_);
  const Weights wx = basis(u), wy = basis(v), dx = basisSlope(u), dy = basisSlope(v);
  double z = 0.0, east = 0.0, north = 0.0;
  const double* c = coefficients_.data() + (row - 1) * columns_ + column - 1;
  for (int j = 0; j < 4; ++j, c += columns_) {
    const double value = wx[0] * c[0] + wx[1] * c[1] + wx[2] * c[2] + wx[3] * c[3];
    const double slope = dx[0] * c[0] + dx[1] * c[1] + dx[2] * c[2] + dx[3] * c[3];
    z += wy[j] * value;
    east += wy[j] * slope;
    north += dy[j] * value;
  }
  gradient = Eigen::Vector2d(east, north) / kNode;
  return z;
}

Eigen::Vector3d Terrain::normal(double x, double y) const {
  Eigen::Vector2d gradient;
  height(x, y, gradient);
  return Eigen::Vector3d(-gradient.x(), -gradient.y(), 1.0).normalized();
}

double Terrain::intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  const double down = -direction.z();
  double low = (origin.z() - highest_) / down, high = (origin.z() - lowest_) / down;
  double range = 0.5 * (low + high);
  Eigen::Vector2d gradient;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double above =
        origin.z() - range * down -
        height(origin.x() + range * direction.x(), origin.y() + range * direction.y(), gradient);
    if (std::abs(above) < 1e-10) return range;
    (above > 0.0 ? low : high) = range;
    range += above / (down + gradient.x() * direction.x() + gradient.y() * direction.y());
    if (!(range >= low && range <= high)) range = 0.5 * (low + high);
  }
  return range;
}

}  // namespace pcl_als::simulation
