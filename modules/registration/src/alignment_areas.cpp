// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "alignment_areas.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als::registration {
namespace {

constexpr double kPointsPerArea = 12'000.0;
constexpr double kSmallestArea = 12.0, kLargestArea = 250.0;  // metres
constexpr std::size_t kFewestPoints = 30;                     // of each cloud in an area
// point spacings; patches inside the area equal those of the whole cloud
constexpr double kMarginSpacings = 8.0;
constexpr double kLeastSlope = 0.12, kMostSlope = 0.9;  // tangents that count as relief
constexpr std::size_t kRegions = 8;  // regions per side, each with areas of its own

double largestShift(const Eigen::Affine3d& motion, const Eigen::AlignedBox3d& box) {
  double largest = 0.0;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    largest = std::max(largest, (motion * corner - corner).head<2>().norm());
  }
  return largest;
}

/// Slope of the lowest points around a cell in the target; 0 where a neighbour is missing.
double slopeAt(const LowestPoints& lowest, std::size_t cell) {
  const PlanGrid& grid = lowest.grid();
  const std::size_t column = cell % grid.columns, row = cell / grid.columns;
  if (column + 1 >= static_cast<std::size_t>(grid.columns) ||
      row + 1 >= static_cast<std::size_t>(grid.rows))
    return 0.0;
  const std::size_t east = cell + 1, north = cell + grid.columns;
  if (lowest.countAt(east) == 0 || lowest.countAt(north) == 0) return 0.0;
  const double here = lowest.at(cell).z();
  return std::hypot(lowest.at(east).z() - here, lowest.at(north).z() - here) / grid.cell;
}

}  // namespace

AlignmentAreas::AlignmentAreas(const CommonCells& cells, std::size_t points) {
  std::size_t count = 0, covered = 0;
  const PlanGrid& fine = cells.target.grid();
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (!cells.both(i)) continue;
    ++covered;
    count += std::max(cells.source.countAt(i), cells.target.countAt(i));
  }
  const double density =
      static_cast<double>(std::max<std::size_t>(count, 1)) /
      (static_cast<double>(std::max<std::size_t>(covered, 1)) * fine.cell * fine.cell);
  const double size = std::clamp(std::sqrt(kPointsPerArea / density), kSmallestArea, kLargestArea);
  const Eigen::AlignedBox2d box(fine.corner,
                                fine.corner + fine.cell * Eigen::Vector2d(fine.columns, fine.rows));
  grid_ = PlanGrid(box, size);
  choose(squaresOf(cells), points);
}

std::vector<AlignmentAreas::Square> AlignmentAreas::squaresOf(const CommonCells& cells) const {
  struct Sum {
    std::size_t source = 0, target = 0, cells = 0;
    double relief = 0.0;
  };
  std::vector<Sum> sums(grid_.size());
  const PlanGrid& fine = cells.target.grid();
  for (std::size_t i = 0; i < fine.size(); ++i) {
    if (!cells.both(i)) continue;
    const Eigen::Vector2d centre = fine.centreOf(i);
    const std::int64_t square = grid_.cellOf(centre.x(), centre.y());
    if (square < 0) continue;
    Sum& sum = sums[square];
    sum.source += cells.source.countAt(i);
    sum.target += cells.target.countAt(i);
    ++sum.cells;
    for (const LowestPoints* lowest : {&cells.source, &cells.target}) {
      const double slope = slopeAt(*lowest, i);
      if (slope > kLeastSlope && slope < kMostSlope) sum.relief += 1.0;
    }
  }
  std::vector<Square> squares;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (std::min(sums[i].source, sums[i].target) < kFewestPoints) continue;
    squares.push_back({i, std::max(sums[i].source, sums[i].target), sums[i].relief});
  }
  return squares;
}

/// The best area of every region first, then the second of every region, and so on.
void AlignmentAreas::choose(std::vector<Square> squares, std::size_t points) {
  const auto regionOf = [this](const Square& square) {
    const std::size_t column = square.index % grid_.columns, row = square.index / grid_.columns;
    return (row * kRegions / grid_.rows) * kRegions + column * kRegions / grid_.columns;
  };
  std::stable_sort(squares.begin(), squares.end(),
                   [](const Square& a, const Square& b) { return a.relief > b.relief; });
  std::vector<std::size_t> taken(kRegions * kRegions, 0);
  std::vector<std::pair<std::size_t, std::size_t>> order;  // round, place in squares
  for (std::size_t i = 0; i < squares.size(); ++i)
    order.emplace_back(taken[regionOf(squares[i])]++, i);
  std::sort(order.begin(), order.end());
  std::size_t sum = 0;
  for (const auto& [round, i] : order) {
    if (sum >= points) break;
    sum += squares[i].points;
    chosen_.push_back(squares[i].index);
  }
  std::sort(chosen_.begin(), chosen_.end());
}

Eigen::AlignedBox2d AlignmentAreas::boxOf(std::size_t area) const {
  const Eigen::Vector2d centre = grid_.centreOf(chosen_[area]);
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * grid_.cell);
  return {centre - half, centre + half};
}

std::vector<std::vector<Eigen::Vector3d>> AlignmentAreas::pointsOf(const WorkingPoints& points,
                                                                   double margin) const {
  // A point may belong to its own square and, with the margin, to the squares around it.
  const int reach = static_cast<int>(std::ceil(margin / grid_.cell));
  std::vector<std::int32_t> area_of(grid_.size(), -1);
  for (std::size_t a = 0; a < chosen_.size(); ++a)
    area_of[chosen_[a]] = static_cast<std::int32_t>(a);
  const PlanGrid wide({grid_.corner - Eigen::Vector2d::Constant(reach * grid_.cell),
                       grid_.corner + grid_.cell * Eigen::Vector2d(grid_.columns + reach - 0.5,
                                                                   grid_.rows + reach - 0.5)},
                      grid_.cell);
  std::vector<std::vector<std::int32_t>> near(wide.size());
  for (std::size_t a = 0; a < chosen_.size(); ++a) {
    const auto column = static_cast<int>(chosen_[a] % grid_.columns);
    const auto row = static_cast<int>(chosen_[a] / grid_.columns);
    for (int i = 0; i <= 2 * reach; ++i)
      for (int j = 0; j <= 2 * reach; ++j)
        near[static_cast<std::size_t>(row + i) * wide.columns + column + j].push_back(
            static_cast<std::int32_t>(a));
  }
  std::vector<Eigen::AlignedBox2d> boxes;
  for (std::size_t a = 0; a < chosen_.size(); ++a) {
    const Eigen::AlignedBox2d box = boxOf(a);
    boxes.emplace_back(box.min().array() - margin, box.max().array() + margin);
  }
  std::vector<std::vector<Eigen::Vector3d>> result(chosen_.size());
  for (std::size_t i = 0; i < points.count(); ++i) {
    const Eigen::Vector3d p = points[i];
    const std::int64_t cell = wide.cellOf(p.x(), p.y());
    if (cell < 0 || !std::isfinite(p.z())) continue;
    for (const std::int32_t a : near[cell])
      if (boxes[a].contains(p.head<2>())) result[a].push_back(p);
  }
  return result;
}

std::vector<AreaSurfaces> AlignmentAreas::triangulate(
    const WorkingPoints& source, const WorkingPoints& target, const Eigen::Affine3d& motion,
    const PatchAlignmentSettings& settings) const {
  const Eigen::Vector2d size(grid_.columns * grid_.cell, grid_.rows * grid_.cell);
  Eigen::AlignedBox3d box;
  box.extend(Eigen::Vector3d(grid_.corner.x(), grid_.corner.y(), 0.0));
  box.extend(Eigen::Vector3d(grid_.corner.x() + size.x(), grid_.corner.y() + size.y(), 0.0));
  const double spacing = grid_.cell / std::sqrt(kPointsPerArea);
  const double margin = std::min(kMarginSpacings * spacing, 8.0) + 1.5 * largestShift(motion, box);
  std::vector<std::vector<Eigen::Vector3d>> parts[2];
  parallelFor(2, settings.threads, [&](std::size_t side) {
    parts[side] = pointsOf(side == 0 ? source : target, margin);
  });
  std::vector<AreaSurfaces> areas(chosen_.size());
  parallelFor(2 * areas.size(), settings.threads, [&](std::size_t i) {
    AreaSurfaces& area = areas[i / 2];
    (i % 2 == 0 ? area.source : area.target) =
        SurfaceSide(std::move(parts[i % 2][i / 2]), boxOf(i / 2), settings.resolution);
  });
  return areas;
}

}  // namespace pcl_als::registration
