// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Residuals of a pair of surfaces at plan positions, and how much an estimate varies over
 * the area because the surfaces are not rigid.
 *
 * An offset describes two surfaces if it is the same everywhere. If they are tilted against each
 * other it is not, and the offset of one part of the area differs from that of the next by the tilt
 * times their distance; what is true of an offset and a tilt is true of a rotation and a bend. The
 * scatter of the residuals shows this only through correlated errors, which a few dozen cells
 * determine roughly. Polynomials of the next higher degree show it directly.
 *
 * A polynomial that is not significant (95 % of the chi-squared distribution, with the covariance
 * of ClusteredRegression, which allows for errors that are correlated over the ground) counts as
 * none, so that rigid surfaces keep their standard deviations.
 */
class OverlapVariation {
 public:
  /// \param group observations of one group may have any errors in common
  void add(std::int64_t group, const Eigen::Vector2d& place, double height_difference);

  /// Mean square over the places of the significant tilt of the differences (their unit squared).
  double ofOffset() const;
  /// Mean squares over the places of the rotations about the x and the y axis of the significant
  /// bend of the differences; zero with fewer than seven groups.
  Eigen::Vector2d ofRotations() const;

 private:
  Eigen::Vector2d centre() const;

  std::vector<std::int64_t> groups_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<double> values_;
};

/// x' M x where x is significant (95 %), otherwise 0.
double significantMeanSquare(const Eigen::VectorXd& estimate, const Eigen::MatrixXd& covariance,
                             const Eigen::MatrixXd& moments);

}  // namespace pcl_als
