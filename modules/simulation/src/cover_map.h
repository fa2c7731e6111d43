// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/scene.h>

namespace pcl_als::simulation {

/// Cover of the bare ground in cells of half a metre: parcels of grass and soil, then roads.
class CoverMap {
 public:
  CoverMap() = default;
  CoverMap(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, std::uint64_t seed);

  LandCover at(double x, double y) const { return cells_[indexOf(x, y)]; }
  void paintDisc(const Eigen::Vector2d& centre, double radius, LandCover cover);
  /// A rectangle with its long axis at an azimuth (radians counter-clockwise from east).
  void paintRectangle(const Eigen::Vector2d& centre, double azimuth, double length, double width,
                      LandCover cover);

 private:
  static constexpr double kCell = 0.5;
  std::size_t indexOf(double x, double y) const;
  template <typename Inside>
  void paint(const Eigen::Vector2d& centre, double reach, LandCover cover, const Inside& inside);

  Eigen::Vector2d minimum_{0, 0};
  std::ptrdiff_t columns_ = 0, rows_ = 0;
  std::vector<LandCover> cells_;
};

/// Reflectance at 1064 nm of a cover, before texture.
float baseReflectance(LandCover cover);

/// A factor near 1 (0.7 to 1.3) that varies smoothly with place over 0.7, 3 and 40 m.
double textureAt(double x, double y, std::uint64_t seed);

/// Height at which a ray meets grass, relative to the largest one: evenly distributed over the
/// blades, independent in cells of 2 cm, with blades of 0.3 to 1 that vary smoothly over 25 m.
double grassHeightAt(double x, double y, std::uint64_t seed);

}  // namespace pcl_als::simulation
