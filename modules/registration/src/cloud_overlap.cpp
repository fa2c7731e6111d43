// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "cloud_overlap.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/parallel.h>

namespace pcl_als::registration {
namespace {

using Eigen::Affine3d;
using Eigen::Vector3d;

constexpr double kCellSpacings = 2.5;  // mean spacings of the sparser cloud per cell
constexpr double kGroups = 60.0;       // of the jackknife, approximately

struct Extent {
  Eigen::AlignedBox3d box;
  std::size_t finite = 0;
};

Extent extentOf(const PointView& view) {
  Extent extent;
  for (std::size_t i = 0; i < view.count; ++i) {
    const Vector3d p = view.position(i);
    if (!p.allFinite()) continue;
    extent.box.extend(p);
    ++extent.finite;
  }
  return extent;
}

double spacingOf(const Extent& extent) {
  const double area = extent.box.sizes().head<2>().prod();
  return std::sqrt(area / static_cast<double>(std::max<std::size_t>(extent.finite, 1)));
}

}  // namespace

/// First pass over all points: extents, reference, lowest points of cells.
bool CloudOverlap::readCells(const PointView& source, const PointView& target,
                             const PatchAlignmentSettings& settings, const Affine3d& guess) {
  Extent extents[2];
  parallelFor(2, settings.threads,
              [&](std::size_t i) { extents[i] = extentOf(i == 0 ? source : target); });
  if (std::min(extents[0].finite, extents[1].finite) < 3) return false;
  const double reach = settings.search_distance;
  Eigen::AlignedBox3d moved = extents[0].box.transformed(guess);
  const Eigen::AlignedBox2d a(moved.min().head<2>().array() - reach,
                              moved.max().head<2>().array() + reach);
  const Eigen::AlignedBox2d b(extents[1].box.min().head<2>().array() - reach,
                              extents[1].box.max().head<2>().array() + reach);
  const Eigen::AlignedBox2d common = a.intersection(b);
  if (common.isEmpty()) return false;
  reference << common.center(), extents[1].box.center().z();
  reference = reference.array().round();
  const double spacing = std::max(spacingOf(extents[0]), spacingOf(extents[1]));
  const double cell = std::max(kCellSpacings * spacing, 0.05);
  const Eigen::AlignedBox2d box(common.min() - reference.head<2>(),
                                common.max() - reference.head<2>());
  const PlanGrid grid(box, cell);
  const Affine3d to_working = Eigen::Translation3d(-reference) * guess;
  const Affine3d target_to_working(Eigen::Translation3d(-reference));
  parallelFor(2, settings.threads, [&](std::size_t i) {
    if (i == 0)
      cells.source = LowestPoints(WorkingPoints(source, to_working), grid);
    else
      cells.target = LowestPoints(WorkingPoints(target, target_to_working), grid);
  });
  return true;
}

/// Centroid, radius and area of the cells with points of both clouds.
bool CloudOverlap::measure() {
  const PlanGrid& grid = cells.target.grid();
  double count = 0.0;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!cells.both(i)) continue;
    centroid.head<2>() += grid.centreOf(i);
    centroid.z() += 0.5 * (cells.source.at(i).z() + cells.target.at(i).z());
    count += 1.0;
  }
  if (count < 3.0) return false;
  centroid /= count;
  double squares = 0.0;
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (!cells.both(i)) continue;
    squares += (grid.centreOf(i) - centroid.head<2>()).squaredNorm();
    box.extend(grid.centreOf(i));
  }
  area = count * grid.cell * grid.cell;
  radius = std::max(std::sqrt(squares / count), grid.cell);
  groups = PlanGrid(box, std::sqrt(area / kGroups));
  return true;
}

bool CloudOverlap::find(const PointView& source, const PointView& target,
                        const PatchAlignmentSettings& settings, const Affine3d& guess) {
  return readCells(source, target, settings, guess) && measure();
}

}  // namespace pcl_als::registration
