// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/registration/patch_alignment.h>

#include "pair_search.h"
#include "plan_cells.h"

namespace pcl_als::registration {

/// The lowest points of both clouds on one grid over their common extent.
struct CommonCells {
  LowestPoints source, target;

  bool both(std::size_t cell) const { return source.countAt(cell) > 0 && target.countAt(cell) > 0; }
  CommonCells pooled() const { return {source.pooled(), target.pooled()}; }
};

/** \brief Squares of the overlap that are triangulated.
 *
 * Squares are the same in the coordinates of either cloud, so that their choice and the surfaces do
 * not depend on which cloud is the source.
 */
class AlignmentAreas {
 public:
  /// Chooses areas evenly over the overlap and by relief until they contain about \a points of both
  /// clouds.
  AlignmentAreas(const CommonCells& cells, std::size_t points);

  /// Triangulates the points of the areas and those within the margin that the \a motion requires.
  std::vector<AreaSurfaces> triangulate(const WorkingPoints& source, const WorkingPoints& target,
                                        const Eigen::Affine3d& motion,
                                        const PatchAlignmentSettings& settings) const;
  std::size_t count() const { return chosen_.size(); }

 private:
  struct Square {
    std::size_t index;   ///< in grid_
    std::size_t points;  ///< of the cloud with more points
    double relief;       ///< share of cells on slopes
  };

  std::vector<Square> squaresOf(const CommonCells& cells) const;
  void choose(std::vector<Square> squares, std::size_t points);
  Eigen::AlignedBox2d boxOf(std::size_t area) const;
  std::vector<std::vector<Eigen::Vector3d>> pointsOf(const WorkingPoints& points,
                                                     double margin) const;

  PlanGrid grid_;
  std::vector<std::size_t> chosen_;  ///< squares, ascending
};

}  // namespace pcl_als::registration
