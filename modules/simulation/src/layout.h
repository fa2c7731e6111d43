// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/scene.h>

#include "cover_map.h"

namespace pcl_als::simulation {

struct Tree {
  Eigen::Vector2d place{0, 0};
  double height = 10.0;       ///< of the top above the ground at its place, metres
  double crown_radius = 3.0;  ///< in plan
  double crown_depth = 6.0;   ///< from top to bottom
  std::uint64_t key = 0;      ///< of its leaves
};

/// Positions of streets, houses and trees.
struct Layout {
  std::vector<Building> buildings;
  std::vector<Tree> trees;
};

/** \brief Lays out a suburb and paints its streets and drives on the cover map.
 *
 * Streets are the lines of a lattice under a smooth warp, so they bend through many directions;
 * each mesh is built up with houses along its streets, or a hall with its yard, or a wood, or left
 * open. What a mesh holds depends on the seed and the mesh alone.
 */
Layout layOut(const Terrain& terrain, const Eigen::Vector2d& minimum,
              const Eigen::Vector2d& maximum, const SceneOptions& options, std::uint64_t seed,
              CoverMap& cover);

/// Roof and wall polygons of a building, the roof's first.
std::vector<Polygon> polygonsOf(const Building& building);
int roofPolygonCount(const Building& building);

/// The clumps of leaves of a tree whose foot is at a height.
void appendBalls(const Tree& tree, double ground, std::vector<Ball>& balls);

}  // namespace pcl_als::simulation
