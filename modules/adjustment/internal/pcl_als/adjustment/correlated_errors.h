// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Covariance of a least-squares estimate whose observations share errors that vary slowly
 * over the ground, as those of two trajectories do.
 *
 * Model of an observation at the plan position p, with the row a of the unknowns x:
 *   y = a'x + z'u(p) + e,   Cov(u(p), u(q)) = s^2 lambda D exp(-|p - q| / L),   Var(e) = s^2 / w.
 * u has one component (height) or three (east, north, up), z is the effect of each: 1, or the
 * normal of the surface. D = diag(h, h, 1) lets errors in plan be larger than those of heights. The
 * residuals of the estimate x = N^-1 A'W y are summed in cells. s^2 is integrated out and lambda, L
 * and h are averaged over a grid with the restricted likelihood (Patterson and Thompson 1971) as
 * weight, because a few dozen cells determine them only roughly. L reaches to the extent of the
 * observations: what is shared beyond is part of the estimate. The covariance is that of x as
 * estimated, N^-1 A'W Cov(y) W A N^-1, averaged.
 *
 * \code
 * CorrelatedErrors errors(1, 1);                       // a mean height
 * for (const auto& o : observations)
 *   errors.add(o.place, Row::Ones(1), Row::Ones(1), 1.0, o.height - mean);
 * const double std = std::sqrt(errors.solve().covariance(0, 0));
 * \endcode
 */
class CorrelatedErrors {
 public:
  static constexpr int kMostUnknowns = 7;
  using Row = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostUnknowns, 1>;
  using Matrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostUnknowns, kMostUnknowns>;

  /// \param unknowns 1 … 7
  /// \param components of the shared error: 1, or 3 (two in plan, one vertical)
  CorrelatedErrors(int unknowns, int components);

  /// \param place plan position, metres
  /// \param residual of the estimate, same unit for all
  void add(const Eigen::Vector2d& place, const Row& row, const Row& effect, double weight,
           double residual);

  struct Result {
    bool determined = false;  ///< false: too few cells to estimate the correlation
    Matrix covariance;        ///< of the unknowns
    std::size_t cells = 0;
    double range =
        0.0;  ///< metres: L of the highest likelihood; 0: errors of cells are independent
    /// share of the shared error in the variance of a cell, at that likelihood
    double share = 0.0;
  };
  Result solve() const;

 private:
  struct Cell {
    double count = 0.0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< sum
    Matrix effects;                                   ///< sum of w z z'
    Matrix mixed;                                     ///< sum of w z a'
    Row score;                                        ///< sum of w z v
  };
  using Cells = std::map<std::int64_t, Cell>;
  static Cells doubled(const Cells& cells, double size);
  Cells merged(double& size) const;

  int unknowns_, components_;
  Matrix normal_;
  Cells cells_;
};

}  // namespace pcl_als
