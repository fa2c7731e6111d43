// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/primitives.h>
#include <pcl_als/simulation/simulation_options.h>
#include <pcl_als/simulation/terrain.h>

namespace pcl_als::simulation {

enum class LandCover : std::uint8_t { grass, soil, road, building, tree };

/// Name in files: tree, grass, soil or built-up (road and building).
std::string_view classNameOf(LandCover cover);
/// ASPRS: 2 ground (grass, soil), 5 vegetation, 6 building, 11 road.
std::uint8_t asprsClassOf(LandCover cover);

/// Intersection of a ray with a surface.
struct SurfaceHit {
  static constexpr std::uint32_t kGround = 0xFFFFFFFF;
  double range = 0.0;               ///< metres from the ray's origin
  Eigen::Vector3d normal{0, 0, 1};  ///< unit, out of the surface
  double opacity = 1.0;             ///< share of the arriving energy that stays; 1: nothing behind
  float reflectance = 0.0F;         ///< diffuse, at 1064 nm, with texture
  LandCover cover = LandCover::grass;
  std::uint32_t object = kGround;  ///< index in polygons(), then in balls(), then
                                   ///< in targets(); or kGround
};

/// A house with its ridge along its axis, or a flat roof. Metres, local frame.
struct Building {
  Eigen::Vector2d centre{0, 0};
  double azimuth = 0.0;               ///< of the ridge, radians counter-clockwise from east
  double length = 12.0, width = 9.0;  ///< of the walls, along and across the ridge
  double overhang = 0.5;              ///< of the roof beyond the walls
  double eaves = 0.0;                 ///< height of the roof above the long walls
  double pitch = 0.0;                 ///< of the roof, radians; 0: flat
  double floor = 0.0;                 ///< lower end of the walls, under the terrain
  float roof_reflectance = 0.2F, wall_reflectance = 0.3F;
};

/// A level circular board above the ground. Local frame.
struct Target {
  Disc disc;
  float reflectance = 0.85F;  ///< white paint at 1064 nm
};

/** \brief A suburb: terrain, streets, houses and trees, with reflectances, from a seed.
 *
 * Local frame: metres east, north, up from SimulationOptions::origin. The terrain is a smooth
 * height field, roofs and walls are polygons, the crown of a tree is a cloud of semi-transparent
 * balls. All surfaces are exact: a hit lies on its surface to rounding. Grass
 * (SceneOptions::grass) is met above the terrain, at the height of a blade.
 *
 * Memory: about 10 MB per square kilometre, most of it leaves and the cover map.
 */
class Scene {
 public:
  /// Share of the energy that one clump of leaves keeps.
  static constexpr double kBallOpacity = 0.4;

  /// Covers the rectangle; surfaces outside are not simulated.
  Scene(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, const SceneOptions& options,
        std::uint64_t seed, std::vector<Target> targets = {});
  ~Scene();
  Scene(Scene&&) noexcept;

  const Terrain& terrain() const;
  const std::vector<Building>& buildings() const;
  const std::vector<Polygon>& polygons() const;  ///< roofs and walls
  const std::vector<Ball>& balls() const;
  const std::vector<Target>& targets() const;
  std::size_t treeCount() const;
  const Eigen::Vector2d& minimum() const;
  const Eigen::Vector2d& maximum() const;

  /// Surfaces along a downward ray, from near to far, up to and including the first opaque one;
  /// false (without surfaces) where the ray intersects the terrain outside the rectangle. \a
  /// direction is a unit vector at most 50 degrees from straight down; the origin is above all
  /// objects.
  bool trace(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
             std::vector<SurfaceHit>& hits) const;

  /// True when no building, tree or target is within \a radius (plan) of a ray that intersects the
  /// terrain at \a ground_range.
  bool isOpen(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double ground_range,
              double radius) const;
  /// True when no building, tree or target is within \a radius of a place.
  bool isOpen(const Eigen::Vector2d& place, double radius) const;

  LandCover groundCover(double x, double y) const;  ///< of the bare ground
  LandCover topCover(double x, double y) const;     ///< as seen from straight above

 private:
  struct State;
  std::unique_ptr<const State> state_;
};

}  // namespace pcl_als::simulation
