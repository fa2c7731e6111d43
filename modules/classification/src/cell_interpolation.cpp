// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "cell_interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/tin/tin.h>

namespace pcl_als::detail {
namespace {

constexpr int kNeighbours = 8;
// The TIN's integers reach 2^24 resolutions; half of it is on the safe side of rounding.
constexpr double kFinestSteps = 1 << 23;

FilledCells withSamples(const RasterGrid& grid, const CellSamples& samples) {
  FilledCells filled;
  filled.source.assign(grid.cells(), CellSource::empty);
  for (const std::vector<float>& values : samples.values) {
    filled.bands.emplace_back(grid.cells(), RasterBand::kNoValue);
    for (std::size_t i = 0; i < samples.cell.size(); ++i)
      filled.bands.back()[samples.cell[i]] = values[i];
  }
  for (const std::size_t cell : samples.cell) filled.source[cell] = CellSource::measured;
  return filled;
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Squared radius of the circle through three places.
double circleRadiusSq(const std::array<Eigen::Vector2d, 3>& p) {
  const double twice_area = cross(p[1] - p[0], p[2] - p[0]);
  if (twice_area == 0.0) return HUGE_VAL;
  return (p[1] - p[0]).squaredNorm() * (p[2] - p[1]).squaredNorm() * (p[0] - p[2]).squaredNorm() /
         (4.0 * twice_area * twice_area);
}

/// Fills the empty cells whose centre is in a triangle.
class TriangleFill {
 public:
  TriangleFill(const RasterGrid& grid, const CellSamples& samples, FilledCells& filled)
      : grid_(grid), samples_(samples), filled_(filled) {}

  void fill(const Tin::Triangle& triangle, double largest_radius_sq) {
    std::array<Eigen::Vector2d, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = samples_.place[static_cast<std::size_t>(triangle.vertex[k])];
    if (circleRadiusSq(p) > largest_radius_sq) return;
    const Eigen::Vector2d low = p[0].cwiseMin(p[1]).cwiseMin(p[2]),
                          high = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
    const int first_column = std::max(0, firstCentre(low.x())),
              last_column = std::min(grid_.columns - 1, lastCentre(high.x()));
    const int first_row = std::max(0, firstCentre(-high.y())),
              last_row = std::min(grid_.rows - 1, lastCentre(-low.y()));
    for (int row = first_row; row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column)
        fillCell(column, row, p, triangle);
  }

 private:
  int firstCentre(double along) const {
    return static_cast<int>(std::ceil(along / grid_.cell - 0.5));
  }
  int lastCentre(double along) const {
    return static_cast<int>(std::floor(along / grid_.cell - 0.5));
  }

  void fillCell(int column, int row, const std::array<Eigen::Vector2d, 3>& p,
                const Tin::Triangle& triangle) {
    const std::size_t cell = grid_.index(column, row);
    if (filled_.source[cell] != CellSource::empty) return;
    const Eigen::Vector2d centre((column + 0.5) * grid_.cell, -(row + 0.5) * grid_.cell);
    const double w0 = cross(p[1] - centre, p[2] - centre), w1 = cross(p[2] - centre, p[0] - centre),
                 w2 = cross(p[0] - centre, p[1] - centre);
    if (w0 < 0.0 || w1 < 0.0 || w2 < 0.0) return;
    const double whole = w0 + w1 + w2;
    const auto a = static_cast<std::size_t>(triangle.vertex[0]),
               b = static_cast<std::size_t>(triangle.vertex[1]),
               c = static_cast<std::size_t>(triangle.vertex[2]);
    for (std::size_t band = 0; band < filled_.bands.size(); ++band) {
      const std::vector<float>& v = samples_.values[band];
      filled_.bands[band][cell] = static_cast<float>((w0 * v[a] + w1 * v[b] + w2 * v[c]) / whole);
    }
    filled_.source[cell] = CellSource::interpolated;
  }

  const RasterGrid& grid_;
  const CellSamples& samples_;
  FilledCells& filled_;
};

/// Collects measured cells around one, ring by ring.
class RingSearch {
 public:
  RingSearch(const RasterGrid& grid, const CellSamples& samples, double radius)
      : grid_(grid),
        samples_(samples),
        reach_(static_cast<int>(std::ceil(radius / grid.cell))),
        radius_sq_(radius * radius),
        sample_of_(grid.cells(), kNoSample) {
    for (std::size_t i = 0; i < samples.cell.size(); ++i)
      sample_of_[samples.cell[i]] = static_cast<std::uint32_t>(i);
  }

  /// Weights of samples for the centre of a cell; empty when none is within reach.
  const std::vector<std::pair<std::uint32_t, double>>& around(int column, int row) {
    found_.clear();
    centre_ = {(column + 0.5) * grid_.cell, -(row + 0.5) * grid_.cell};
    for (int ring = 1; ring <= reach_ && found_.size() < kNeighbours; ++ring) {
      for (int c = column - ring; c <= column + ring; ++c)
        visit(c, row - ring), visit(c, row + ring);
      for (int r = row - ring + 1; r < row + ring; ++r)
        visit(column - ring, r), visit(column + ring, r);
    }
    return found_;
  }

 private:
  static constexpr std::uint32_t kNoSample = 0xFFFFFFFF;

  void visit(int column, int row) {
    if (!grid_.holds(column, row)) return;
    const std::uint32_t sample = sample_of_[grid_.index(column, row)];
    if (sample == kNoSample) return;
    const double distance_sq = (samples_.place[sample] - centre_).squaredNorm();
    if (distance_sq <= radius_sq_) found_.emplace_back(sample, 1.0 / distance_sq);
  }

  const RasterGrid& grid_;
  const CellSamples& samples_;
  int reach_;
  double radius_sq_;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  std::vector<std::uint32_t> sample_of_;
  std::vector<std::pair<std::uint32_t, double>> found_;
};

}  // namespace

FilledCells fillByTin(const RasterGrid& grid, const CellSamples& samples, double radius) {
  FilledCells filled = withSamples(grid, samples);
  if (samples.cell.size() < 3) return filled;
  std::vector<Eigen::Vector3d> points;
  points.reserve(samples.place.size());
  for (const Eigen::Vector2d& place : samples.place) points.emplace_back(place.x(), place.y(), 0.0);
  const double extent = std::max(grid.columns, grid.rows) * grid.cell;
  const Tin tin(std::move(points), std::max(0.001, extent / kFinestSteps));
  TriangleFill fill(grid, samples, filled);
  for (const Tin::Triangle& triangle : tin.triangles()) fill.fill(triangle, radius * radius);
  return filled;
}

FilledCells fillByDistance(const RasterGrid& grid, const CellSamples& samples, double radius) {
  FilledCells filled = withSamples(grid, samples);
  RingSearch search(grid, samples, radius);
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const std::size_t cell = grid.index(column, row);
      if (filled.source[cell] == CellSource::measured) continue;
      const auto& found = search.around(column, row);
      if (found.empty()) continue;
      double weights = 0.0;
      for (const auto& [sample, weight] : found) weights += weight;
      for (std::size_t band = 0; band < filled.bands.size(); ++band) {
        double sum = 0.0;
        for (const auto& [sample, weight] : found) sum += weight * samples.values[band][sample];
        filled.bands[band][cell] = static_cast<float>(sum / weights);
      }
      filled.source[cell] = CellSource::interpolated;
    }
  }
  return filled;
}

}  // namespace pcl_als::detail
