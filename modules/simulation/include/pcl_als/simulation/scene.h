// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/primitives.h>
#include <pcl_als/simulation/simulation_options.h>
#include <pcl_als/simulation/terrain.h>

namespace pcl_als::simulation {

/// What a surface is. Names in files: tree, grass, soil, built-up (road and building).
enum class LandCover : std::uint8_t { grass, soil, road, building, tree };

std::string_view classNameOf(LandCover cover);
std::uint8_t asprsClassOf(LandCover cover);

/// One surface met by a ray.
struct SurfaceHit {
  double range = 0.0;               ///< metres from the ray's origin
  Eigen::Vector3d normal{0, 0, 1};  ///< unit, towards the ray's origin
  double opacity = 1.0;             ///< share of the arriving energy that stays; 1: nothing behind
  LandCover cover = LandCover::grass;
  float reflectance = 0.0F;  ///< diffuse, at 1064 nm, with texture
};

/// A house: a ridge along its axis, or a flat roof. Metres, local frame.
struct Building {
  Eigen::Vector2d centre{0, 0};
  double azimuth = 0.0;               ///< of the ridge, radians counter-clockwise from east
  double length = 12.0, width = 9.0;  ///< walls, along and across the ridge
  double overhang = 0.5;              ///< of the roof beyond the walls
  double eaves = 0.0;                 ///< height of the roof at the wall
  double pitch = 0.0;                 ///< of the roof, radians, 0: flat
  double floor = 0.0;                 ///< lower end of the walls, under the terrain
  float roof_reflectance = 0.3F, wall_reflectance = 0.3F;
};

/** \brief A suburb: terrain, streets, houses and trees, with reflectances, from a seed.
 *
 * Local frame: metres east, north, up from SimulationOptions::origin. Terrain is a smooth height
 * field, roofs and walls are polygons, a tree crown is a cloud of semi-transparent balls. All
 * surfaces are exact: a hit lies on its surface to rounding.
 *
 * Memory: about 3 MB per square kilometre and 10 kB per tree.
 */
class Scene {
 public:
  /// Covers the rectangle and everything a ray within 45 degrees of the vertical meets there.
  Scene(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, const SceneOptions& options,
        std::uint64_t seed);

  const Terrain& terrain() const { return terrain_; }
  const std::vector<Building>& buildings() const { return buildings_; }
  const std::vector<Polygon>& polygons() const { return polygons_; }
  const std::vector<Ball>& balls() const { return balls_; }
  std::size_t treeCount() const { return tree_count_; }
  const Eigen::Vector2d& minimum() const { return minimum_; }
  const Eigen::Vector2d& maximum() const { return maximum_; }

  /// Surfaces along a downward ray, near to far, up to and with the first opaque one; false (and no
  /// hits) where the ray misses the scene. \a direction is a unit vector at most 45 degrees from
  /// straight down.
  bool trace(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             std::vector<SurfaceHit>& hits) const;

  /// True when no building or tree is within \a radius of any point of the ray above the ground.
  bool openGround(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                  double ground_range, double radius) const;

  /// Cover of the bare ground at a place, and what is seen from straight above.
  LandCover groundCover(double x, double y) const;
  LandCover topCover(double x, double y) const;

 private:
  Terrain terrain_;
  Eigen::Vector2d minimum_, maximum_;
  std::vector<Building> buildings_;
  std::vector<Polygon> polygons_;
  std::vector<Ball> balls_;
  std::size_t tree_count_ = 0;
};

}  // namespace pcl_als::simulation
