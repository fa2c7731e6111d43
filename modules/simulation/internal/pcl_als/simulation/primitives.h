// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace pcl_als::simulation {

/// A plane convex polygon of three to five corners; opaque, visible from both sides.
class Polygon {
 public:
  /// Corners in order, either sense, in one plane.
  explicit Polygon(const std::vector<Eigen::Vector3d>& corners);

  /// Distance along the ray to the polygon (border included); empty when the ray misses it or
  /// points away.
  std::optional<double> intersect(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const;
  const Eigen::Vector3d& normal() const { return normal_; }  ///< unit; up for a roof
  const Eigen::Vector3d& minimum() const { return minimum_; }
  const Eigen::Vector3d& maximum() const { return maximum_; }

 private:
  Eigen::Vector3d normal_, minimum_, maximum_;
  double offset_ = 0.0;  ///< normal . corner
  int sides_ = 0;
  std::array<Eigen::Vector3d, 5> inward_;  ///< normals of the sides, in the plane
  std::array<double, 5> side_offset_{};
};

/// A clump of leaves: a ball whose near surface keeps a part of the energy and transmits the rest.
struct Ball {
  Eigen::Vector3d centre;
  double radius = 0.5;

  /// Distance along the ray to the near surface; empty when the ray misses it or points away.
  std::optional<double> intersect(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const;
};

/// A level disc; opaque, visible from both sides.
struct Disc {
  Eigen::Vector3d centre;
  double radius = 1.0;

  /// Distance along the ray to the disc (border included); empty when the ray misses it or points
  /// away.
  std::optional<double> intersect(const Eigen::Vector3d& origin,
                                  const Eigen::Vector3d& direction) const;
};

}  // namespace pcl_als::simulation
