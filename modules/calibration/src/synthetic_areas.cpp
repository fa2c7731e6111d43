// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Positions of synthetic pairs: the areas of SyntheticPairs, and control.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <pcl_als/common/errors.h>

#include "synthetic_pairs.h"

namespace pcl_als {
namespace {

using Cell = std::pair<long, long>;

/// Cells of a global grid that a strip covers, walked along and across the strip.
std::set<Cell> cellsOf(const StripGeometry& strip, double step) {
  std::set<Cell> cells;
  const Eigen::Vector2d along = strip.direction(), right(along.y(), -along.x());
  const double half = strip.halfSwath();
  const auto rows = static_cast<long>(std::ceil(strip.length() / step));
  const auto columns = static_cast<long>(std::ceil(2.0 * half / step));
  for (long row = 0; row < rows; ++row) {
    for (long column = 0; column < columns; ++column) {
      const Eigen::Vector2d place = strip.start + step * (static_cast<double>(row) + 0.5) * along +
                                    (step * (static_cast<double>(column) + 0.5) - half) * right;
      const Cell cell(std::lround(std::floor(place.x() / step)),
                      std::lround(std::floor(place.y() / step)));
      const Eigen::Vector2d middle(step * (static_cast<double>(cell.first) + 0.5),
                                   step * (static_cast<double>(cell.second) + 0.5));
      if (strip.covers(middle)) cells.insert(cell);
    }
  }
  return cells;
}

/// A grid step that limits large blocks to some hundred thousand cells, metres.
double stepFor(const std::vector<StripGeometry>& strips, double least) {
  constexpr double kMostCells = 200'000.0;
  double area = 0.0;
  for (const StripGeometry& strip : strips) area += 2.0 * strip.halfSwath() * strip.length();
  return std::max(least, std::sqrt(area / kMostCells));
}

/// An order of cells in which every leading part is spread over the block.
std::vector<Cell> scattered(std::vector<Cell> cells) {
  const auto key = [](const Cell& cell) {
    auto hash = static_cast<std::uint64_t>(cell.first) * 0x9E3779B97F4A7C15ULL ^
                static_cast<std::uint64_t>(cell.second) * 0xC2B2AE3D27D4EB4FULL;
    hash ^= hash >> 29;
    hash *= 0xBF58476D1CE4E5B9ULL;
    return hash ^ (hash >> 32);
  };
  std::sort(cells.begin(), cells.end(), [&](const Cell& a, const Cell& b) {
    return std::pair(key(a), a) < std::pair(key(b), b);
  });
  return cells;
}

/// Common cells of every pair of strips of which the second is \a first or later.
std::vector<std::vector<Cell>> overlapsOf(const std::vector<std::set<Cell>>& cells,
                                          std::size_t first) {
  std::vector<std::vector<Cell>> overlaps;
  for (std::size_t b = first; b < cells.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      std::vector<Cell> common;
      std::set_intersection(cells[a].begin(), cells[a].end(), cells[b].begin(), cells[b].end(),
                            std::back_inserter(common));
      if (!common.empty()) overlaps.push_back(scattered(std::move(common)));
    }
  }
  return overlaps;
}

}  // namespace

SyntheticPairs::Places SyntheticPairs::chooseAreas(int first, const ObservedBlock& block) const {
  const AreaSelection& selection = settings_.selection;
  const double step = stepFor(block.strips, selection.area_size);
  std::vector<std::set<Cell>> cells;
  std::map<Cell, double> points_of;
  const double side = selection.area_size + 2.0 * selection.margin;
  for (const StripGeometry& strip : block.strips) {
    cells.push_back(cellsOf(strip, step));
    for (const Cell& cell : cells.back()) points_of[cell] += side * side * strip.density;
  }
  const auto wishes = overlapsOf(cells, static_cast<std::size_t>(first));
  const auto all = static_cast<double>(block.strips.size()), old = static_cast<double>(first);
  // An added strip gets its share of the points, by the number of pairs.
  double budget = static_cast<double>(selection.point_budget) *
                  (1.0 - old * (old - 1.0) / std::max(1.0, all * (all - 1.0)));
  std::set<Cell> chosen;
  std::size_t longest = 0;
  for (const auto& wish : wishes) longest = std::max(longest, wish.size());
  for (std::size_t round = 0; round < longest && budget > 0.0; ++round) {
    for (const auto& wish : wishes) {
      if (round >= wish.size() || budget <= 0.0) continue;
      if (chosen.insert(wish[round]).second) budget -= points_of[wish[round]];
    }
  }
  const double aside = 0.5 * (step - selection.area_size);  // in the middle of its cell
  Places corners;
  for (const Cell& cell : chosen) {
    corners.emplace_back(step * static_cast<double>(cell.first) + aside,
                         step * static_cast<double>(cell.second) + aside);
  }
  return corners;
}

std::vector<Eigen::Vector2d> SyntheticPairs::spread(std::size_t count,
                                                    const std::vector<StripGeometry>& strips) {
  constexpr double kFine = 25.0;  // metres
  const double step = stepFor(strips, kFine);
  std::set<Cell> covered;
  for (const StripGeometry& strip : strips) covered.merge(cellsOf(strip, step));
  std::vector<Cell> cells = scattered({covered.begin(), covered.end()});
  cells.resize(std::min(cells.size(), std::max<std::size_t>(500, 4 * count)));
  Places free, places;
  for (const Cell& cell : cells) {
    free.emplace_back(step * (static_cast<double>(cell.first) + 0.5),
                      step * (static_cast<double>(cell.second) + 0.5));
  }
  // Each further place is the one with the largest distance from all previous ones.
  std::vector<double> distance(free.size(), std::numeric_limits<double>::infinity());
  for (std::size_t next = 0; places.size() < std::min(count, free.size());) {
    places.push_back(free[next]);
    for (std::size_t i = 0; i < free.size(); ++i) {
      distance[i] = std::min(distance[i], (free[i] - places.back()).squaredNorm());
    }
    next = static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) -
                                    distance.begin());
  }
  return places;
}

std::size_t ObservedBlock::observationCount() const {
  std::size_t count = 0;
  for (const AreaObservations& area : observations) count += area.size();
  return count;
}

void SurfaceModel::validate() const {
  const auto within = [](const char* name, double value, double low, double high) {
    if (std::isfinite(value) && value >= low && value <= high) return;
    throw UsageError(std::string(name) + " " + std::to_string(value) + " is outside [" +
                     std::to_string(low) + ", " + std::to_string(high) + "]");
  };
  within("slope of the ground (degrees)", ground_slope / kRadiansPerDegree, 0.0, 45.0);
  within("slope of steep surfaces (degrees)", steep_slope / kRadiansPerDegree, 0.0, 60.0);
  within("share of steep surfaces", steep_share, 0.0, 1.0);
  within("share of usable points", usable, 1e-3, 1.0);
}

}  // namespace pcl_als
