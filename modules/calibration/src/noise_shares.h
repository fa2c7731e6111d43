// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/tin/tin.h>

#include "pair_observation.h"

namespace pcl_als {

/** \brief Noise that the pairs of an area share: PairObservation::sharing.
 *
 * The error of a pair is sum_p c_p e_p over its points: c = 1 for the point itself, minus the
 * weights of the interpolation for the vertices of the patch. With V the covariance of all pairs of
 * the area, sharing is the sum of |V_ij| along a row over V_ii: with u_p the sum of |c_p| over all
 * pairs, sum_p |c_p| u_p var(e_p) / variance. The diagonal matrix of these sums bounds V from above
 * (Gershgorin), so that with weights of 1 / (variance * sharing) standard deviations are never too
 * small because points occur in several pairs.
 */
class NoiseShares {
 public:
  /// \param points number of points of every surface
  explicit NoiseShares(const std::vector<std::size_t>& points);

  /// The point is one of the surface \a of_point, the patch of the surface \a of_patch.
  /// \param triangle and \param weights of the patch; \param point_variance and
  /// \param vertex_variance of the point and of one vertex along the pair's normal, m^2.
  void add(std::size_t of_point, std::int32_t point, std::size_t of_patch,
           const Tin::Triangle& triangle, const Eigen::Vector3d& weights, double point_variance,
           double vertex_variance);

  /// Sets the sharing of the observations that were added, in that order.
  void setSharing(AreaObservations& observations) const;

 private:
  struct Pair {
    std::size_t of_point, point, of_patch;
    std::array<std::size_t, 3> vertex;
    Eigen::Vector3d weights;
    double point_variance, vertex_variance;
  };
  std::vector<std::vector<double>> used_;  ///< u, by surface and point
  std::vector<Pair> pairs_;
};

}  // namespace pcl_als
