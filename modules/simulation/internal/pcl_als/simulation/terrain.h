// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als::simulation {

/** \brief A smooth height field: a uniform bicubic B-spline (twice continuously differentiable) of
 * ridges and hills, mean height near 0.
 *
 * Local frame, metres. maximumSlope() bounds the gradient everywhere, so that a steeper ray
 * intersects the surface exactly once.
 */
class Terrain {
 public:
  /// \param relief factor on the heights, 0 … 1.5; 1 gives slopes up to about 25 degrees
  /// \param mountains amplitude of two further ridges of 3.4 and 1.7 km, metres
  Terrain(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum, double relief,
          std::uint64_t seed, double mountains = 0.0);

  double height(double x, double y) const;
  /// Height and its derivatives by x and y.
  double height(double x, double y, Eigen::Vector2d& gradient) const;
  Eigen::Vector3d normal(double x, double y) const;

  /// Distance along a downward ray to the surface, metres: Newton's method kept in the bracket of
  /// the lowest and highest height; residual below 1e-9 m.
  double intersect(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;

  double maximumSlope() const { return maximum_slope_; }  ///< tangent
  double lowest() const { return lowest_; }
  double highest() const { return highest_; }

 private:
  Eigen::Vector2d minimum_;
  std::ptrdiff_t columns_ = 0, rows_ = 0;
  std::vector<double> coefficients_;
  double maximum_slope_ = 0.0, lowest_ = 0.0, highest_ = 0.0;
};

}  // namespace pcl_als::simulation
