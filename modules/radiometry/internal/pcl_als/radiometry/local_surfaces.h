// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// Plane of the surface at a point; without one (leaves, wires, edges) the normal is NaN.
struct LocalSurface {
  Eigen::Vector3f normal =  ///< unit, upward
      Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  float roughness = 0.0F;     ///< RMS distance of the points on the plane, metres
  std::uint16_t support = 0;  ///< points on the plane
  bool found() const { return support > 0; }
};

struct LocalSurfaceSettings {
  /// Metres in plan; 0: radius with about 16 points, at least the footprint. See radiusFor().
  double radius = 0.0;
  double tolerance = 0.10;       ///< metres: largest distance of points on a plane
  int least_support = 6;         ///< points on the plane
  double least_share = 0.45;     ///< of the neighbours
  double steepest = 75.0;        ///< degrees: no planes on steeper surfaces
  std::size_t most_points = 24;  ///< nearest neighbours used

  void check() const;  ///< UsageError
};

/** \brief Robust local planes of the points of one strip.
 *
 * A plane z(x, y) is fitted by least squares to the nearest points within the radius. Where they
 * are not on one plane, planes through the point and two of its neighbours are tried, and the one
 * with the least sum of truncated squared distances is fitted again to the points on it (MSAC), so
 * that a point at a ridge, at eaves or at a kerb has the plane on which it is. A plane is rejected
 * if it contains too few of the neighbours, is too steep, or has its points on a line, or if it is
 * steep and its points form two rows with a gap between them (one on a roof, one on the ground).
 *
 * The caller chooses which points are neighbours: single and last returns of one strip. Points:
 * metres in a frame in which floats are sufficient (LocalFrame). Const functions may be called by
 * several threads. The planes depend on the points alone, not on the order of the calls. Memory: 16
 * bytes per point, 4 per grid cell.
 */
class LocalSurfaces {
 public:
  LocalSurfaces(const std::vector<Eigen::Vector3f>& points, const LocalSurfaceSettings& settings);

  LocalSurface at(const Eigen::Vector3f& point) const;
  double radius() const { return radius_; }

  /// The radius of a circle that contains 16 of the points, from the area that they cover.
  static double radiusFor(const std::vector<Eigen::Vector3f>& points);

 private:
  struct Neighbours;
  void gather(const Eigen::Vector3f& point, Neighbours& neighbours) const;
  LocalSurface robust(const Neighbours& neighbours) const;

  LocalSurfaceSettings settings_;
  double radius_;
  Eigen::Vector2f origin_ = Eigen::Vector2f::Zero();
  float cells_per_metre_ = 1.0F;
  std::int64_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> starts_;  ///< of each cell's points
  std::vector<Eigen::Vector3f> points_;
};

}  // namespace pcl_als
