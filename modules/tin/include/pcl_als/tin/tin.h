// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_als {

/** \brief 2.5D Delaunay triangulation of points in plan (x, y), with heights z at the vertices.
 *
 * The topology is exact: plan coordinates are rounded to \a resolution (choose the LAS scale), and
 * all predicates are evaluated on the resulting integers without error. Points with the same
 * rounded plan position are one vertex: the first in input order represents it, the others are not
 * in the TIN. Collinear input has no triangles. Deterministic: the same points in the same order
 * give the same triangles in the same order.
 *
 * Four or more points on one circle (every square of a grid) are triangulated by a rule that
 * depends on these points alone, so the triangulation is unique: input order only decides how
 * triangles and vertices are numbered, and a TIN of a part agrees with the TIN of the whole
 * wherever certain() is true.
 *
 * Triangles are numbered along a space-filling curve: neighbours in plan are mostly close in
 * memory. Memory: 73 bytes per point, and while it is being built up to 100 more.
 *
 * \code
 * const Tin tin(points, 0.001);                      // LAS scale 1 mm
 * const std::int32_t t = tin.locate(x, y);           // the triangle under a position
 * if (t != Tin::kNone && tin.certain(t, tile_with_margin)) use(tin.triangles()[t]);
 * \endcode
 */
class Tin {
 public:
  static constexpr std::int32_t kNone = -1;

  struct Triangle {
    std::array<std::int32_t, 3> vertex;  ///< point indices, counter-clockwise seen from above
    std::array<std::int32_t, 3>
        neighbour;  ///< triangle across the edge opposite vertex[i]; kNone on the hull
  };

  /// End of a walk through the triangles.
  struct Location {
    std::int32_t triangle = kNone;  ///< kNone only when the TIN has no triangles
    /// the position is inside the triangle; otherwise a hull edge separates them
    bool inside = false;
  };

  Tin() = default;
  /// \param points x, y, z in metres. UsageError if their extent in plan exceeds 2^24 resolutions,
  /// InputError if a coordinate is not finite
  explicit Tin(std::vector<Eigen::Vector3d> points, double resolution = 0.001);

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  std::size_t mergedPoints() const { return merged_; }  ///< points at the plan position of others
  double resolution() const { return resolution_; }     ///< metres

  /// Replaces the positions of the points. UsageError unless the number of points is the same. The
  /// topology is kept if it remains a triangulation, as for corrections far below the point
  /// spacing. If more than one in a thousand of the triangles inside the hull would be inverted,
  /// the points are triangulated again (at the cost of the constructor), and the triangles are
  /// renumbered. locate() and walk() use the new positions; certain() refers to the original
  /// positions and has to be called before.
  void movePoints(std::vector<Eigen::Vector3d> points);

  /// The triangle whose plan projection contains (x, y), edges included; kNone outside the hull. On
  /// an edge or vertex it is the triangle with the lowest index. The result is exact for the points
  /// as given. Thread-safe. \a hint is the triangle at which the search starts; if it is kNone or
  /// far away, a grid of starting triangles is used.
  std::int32_t locate(double x, double y, std::int32_t hint = kNone) const;

  /// As locate(), but outside the hull gives the hull triangle at which the search ended.
  Location walk(double x, double y, std::int32_t hint = kNone) const;

  /** \brief Whether a triangle of this TIN, which was made of a part of the points, is also a
   * triangle of the TIN of all points.
   *
   * \param covered a plan box, metres. This TIN must have all points of the whole in the box, its
   * borders included; of points that coincide in plan, the first one must be the same.
   *
   * True if the circumcircle of the triangle, enlarged by two resolutions, lies in the box.
   * Conversely, every triangle of the whole TIN for which this holds is in this TIN.
   */
  bool certain(std::int32_t triangle, const Eigen::AlignedBox2d& covered) const;

 private:
  /// One triangle for each cell of a coarse plan grid, near it.
  struct StartGrid {
    Eigen::Vector2d origin = Eigen::Vector2d::Zero();
    double cells_per_metre = 0.0;
    std::int32_t columns = 0, rows = 0;
    std::vector<std::int32_t> triangle;
    std::size_t cellOf(double x, double y) const;
  };

  void buildStartGrid(const Eigen::AlignedBox2d& extent);
  std::int32_t startNear(double x, double y, std::int32_t hint) const;
  std::int32_t lowestHolder(std::int32_t triangle, const std::array<double, 3>& sides) const;
  struct Step;
  Step stepFrom(std::int32_t at, std::int32_t from, int first, double x, double y) const;
  Location wander(double x, double y, std::int32_t at) const;
  double shareOfInverted() const;

  std::vector<Eigen::Vector3d> points_;
  std::vector<Triangle> triangles_;
  StartGrid start_;
  std::size_t merged_ = 0;
  double resolution_ = 0.001;
};

}  // namespace pcl_als
