// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/tin/tin.h>

#include "exact_orientation.h"

namespace pcl_als {
namespace {

/// Points per cell of the starting grid: one byte of memory per point, a walk of two or three
/// steps.
constexpr double kPointsPerCell = 4.0;
constexpr double kHintCells = 3.0;

/// Gives every empty cell of a row the triangle of the cell before it, or of the first full one.
bool fillRow(std::int32_t* row, std::int32_t columns) {
  std::int32_t* const end = row + columns;
  std::int32_t* const first =
      std::find_if(row, end, [](std::int32_t t) { return t != Tin::kNone; });
  if (first == end) return false;
  std::fill(row, first, *first);
  for (std::int32_t* cell = first + 1; cell < end; ++cell)
    if (*cell == Tin::kNone) *cell = cell[-1];
  return true;
}

}  // namespace

void Tin::buildStartGrid(const Eigen::AlignedBox2d& extent) {
  if (triangles_.empty()) return;
  const Eigen::Vector2d size = extent.sizes();
  const double most = std::max(1.0, static_cast<double>(points_.size()) / kPointsPerCell);
  // Square cells; a very long and narrow TIN gets a single row of them.
  const double cell = std::max(std::sqrt(size.x() * size.y() / most), size.maxCoeff() / most);
  start_.origin = extent.min();
  start_.cells_per_metre = 1.0 / cell;
  start_.columns = static_cast<std::int32_t>(size.x() / cell) + 1;
  start_.rows = static_cast<std::int32_t>(size.y() / cell) + 1;
  auto& grid = start_.triangle;
  grid.assign(static_cast<std::size_t>(start_.columns) * start_.rows, kNone);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    const Eigen::Vector3d& at = points_[triangles_[t].vertex[0]];
    std::int32_t& first = grid[start_.cellOf(at.x(), at.y())];
    if (first == kNone) first = static_cast<std::int32_t>(t);
  }
  std::int32_t* filled = nullptr;
  for (std::int32_t r = 0; r < start_.rows; ++r) {
    std::int32_t* const row = &grid[static_cast<std::size_t>(r) * start_.columns];
    if (fillRow(row, start_.columns)) {
      for (std::int32_t* empty = filled == nullptr ? grid.data() : row; empty < row;
           empty += start_.columns)
        std::copy_n(row, start_.columns, empty);
      filled = row;
    } else if (filled != nullptr) {
      std::copy_n(row - start_.columns, start_.columns, row);
    }
  }
}

/// Clamped: positions outside, and corners that rounding puts there, belong to the border cells.
std::size_t Tin::StartGrid::cellOf(double x, double y) const {
  const double column = std::clamp((x - origin.x()) * cells_per_metre, 0.0, columns - 1.0);
  const double row = std::clamp((y - origin.y()) * cells_per_metre, 0.0, rows - 1.0);
  return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
}

/// The hint unless it is so far away that the grid is the shorter way.
std::int32_t Tin::startNear(double x, double y, std::int32_t hint) const {
  if (hint == kNone) return start_.triangle[start_.cellOf(x, y)];
  const Eigen::Vector3d& a = points_[triangles_[hint].vertex[0]];
  const double cells = (std::abs(a.x() - x) + std::abs(a.y() - y)) * start_.cells_per_metre;
  return cells < kHintCells ? hint : start_.triangle[start_.cellOf(x, y)];
}

/// One step of a walk: the side of the position at each edge, and the triangle across an edge that
/// separates it from the position.
struct Tin::Step {
  std::array<double, 3> side{};
  std::int32_t to = kNone;
  bool separated = false;  ///< by an edge, possibly one of the hull
};

/// The edges are tried from \a first on; the edge to the triangle \a from, where the walk came
/// from, is not tried.
inline Tin::Step Tin::stepFrom(std::int32_t at, std::int32_t from, int first, double x,
                               double y) const {
  const Triangle& t = triangles_[at];
  Step step;
  for (int k = 0; k < 3 && step.to == kNone; ++k) {
    const int i = (first + k) % 3;
    if (t.neighbour[i] == from && from != kNone) {
      step.side[i] = 1.0;
      continue;
    }
    const Eigen::Vector3d &a = points_[t.vertex[(i + 1) % 3]], &b = points_[t.vertex[(i + 2) % 3]];
    step.side[i] = tin::orientation(a.x(), a.y(), b.x(), b.y(), x, y);
    if (step.side[i] >= 0.0) continue;
    step.to = t.neighbour[i];
    step.separated = true;
  }
  return step;
}

Tin::Location Tin::walk(double x, double y, std::int32_t hint) const {
  if (triangles_.empty() || !std::isfinite(x) || !std::isfinite(y)) return {};
  std::int32_t at = startNear(x, y, hint), from = kNone;
  // In a Delaunay triangulation a walk never returns to a triangle; among moved points it may. One
  // triangle is remembered, a later one after each doubling of the number of steps (Brent, 1980).
  std::int32_t remembered = kNone;
  for (std::size_t steps = 0; at != remembered; ++steps) {
    if ((steps & (steps + 1)) == 0) remembered = at;
    const Step step = stepFrom(at, from, 0, x, y);
    if (step.to == kNone)
      return step.separated ? Location{at, false} : Location{lowestHolder(at, step.side), true};
    from = at;
    at = step.to;
  }
  return wander(x, y, at);
}

/// A walk that tries the edges of each triangle in another order, which leaves the cycles that
/// inverted triangles cause (Devillers, Pion and Teillaud, 2002). The order is a function of the
/// number of steps, so the result is reproducible. Bounded: beyond the limit the position counts as
/// in no triangle.
Tin::Location Tin::wander(double x, double y, std::int32_t at) const {
  constexpr std::uint32_t kMultiplier = 2654435769U;  // Knuth's multiplicative hash
  const auto limit =
      64 + static_cast<std::uint32_t>(4.0 * std::sqrt(static_cast<double>(triangles_.size())));
  for (std::uint32_t steps = 1; steps < limit; ++steps) {
    const int first = static_cast<int>(((steps * kMultiplier) >> 16U) % 3U);
    const Step step = stepFrom(at, kNone, first, x, y);
    if (step.to == kNone) return {at, !step.separated};
    at = step.to;
  }
  return {at, false};
}

/// Of the triangles that share the edge or vertex on which a position lies, the lowest index.
std::int32_t Tin::lowestHolder(std::int32_t triangle, const std::array<double, 3>& sides) const {
  std::int32_t lowest = triangle;
  for (int i = 0; i < 3; ++i) {
    if (sides[i] != 0.0) continue;
    const std::int32_t across = triangles_[triangle].neighbour[i];
    if (across != kNone) lowest = std::min(lowest, across);
  }
  const auto corner = [&](int i) { return sides[(i + 1) % 3] == 0.0 && sides[(i + 2) % 3] == 0.0; };
  for (int i = 0; i < 3; ++i) {
    if (!corner(i)) continue;
    const std::int32_t vertex = triangles_[triangle].vertex[i];
    for (const int turn : {1, 2}) {  // around the vertex one way, and from the hull the other
      for (std::int32_t t = triangle;;) {
        const auto& ring = triangles_[t].vertex;
        const auto k = std::find(ring.begin(), ring.end(), vertex) - ring.begin();
        t = triangles_[t].neighbour[(k + turn) % 3];
        if (t == kNone || t == triangle) break;
        lowest = std::min(lowest, t);
      }
    }
  }
  return lowest;
}

std::int32_t Tin::locate(double x, double y, std::int32_t hint) const {
  const Location found = walk(x, y, hint);
  return found.inside ? found.triangle : kNone;
}

}  // namespace pcl_als
