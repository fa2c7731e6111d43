// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "bundle_problem.h"

namespace pcl_als::photogrammetry {

/** \brief Normal equations of a block at its estimate: covariances of all unknowns, redundancy
 * numbers, and what the block does not determine.
 *
 * With N = [[U, W], [W', V]] (images, features), V block-diagonal: S = U - W V^-1 W', Q_images =
 * S^-1, Q_image,feature = -S^-1 W V^-1, Q_feature = V^-1 + V^-1 W' S^-1 W V^-1. S is dense: 8 (6
 * n)^2 bytes for n images. All for unit variance factor.
 */
class BundleNormal {
 public:
  explicit BundleNormal(const BundleProblem& problem);

  /// The direction (shift, rotation or scale of the whole block) that is determined worst, as
  /// text, and its standard deviation in metres at the border of the block.
  struct Weakest {
    std::string name;
    double std = 0.0;
  };
  Weakest weakest() const;

  /// Inverts S; false where it is singular. Nothing below is available before.
  bool invert();
  Matrix6d imageCovariance(std::size_t image) const;
  Eigen::MatrixXd featureCovariance(std::size_t feature) const;
  /// Covariance of the adjusted observation (A Q A', whitened): rows x rows. Without invert(): of
  /// the feature alone, as if the images were known.
  Eigen::MatrixXd adjustedCovariance(const Observation& o, const Observation::Linear& linear) const;

  /// Correction of focal length and principal point (mm) by one step, and its covariance.
  std::pair<Eigen::Vector3d, Eigen::Matrix3d> interior() const;

 private:
  struct Block {
    Eigen::MatrixXd normal, inverse;                             ///< V, V^-1
    std::vector<std::pair<std::size_t, Eigen::MatrixXd>> mixed;  ///< W by image (6 x p)
  };
  using Interior = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  Eigen::MatrixXd crossCovariance(std::size_t image, const Block& block) const;
  Eigen::MatrixXd similarity() const;
  Interior interiorDerivative(const Observation& o) const;
  void reduce();

  const BundleProblem& problem_;
  Eigen::MatrixXd reduced_;    ///< S, then its inverse
  std::vector<Block> blocks_;  ///< by feature
  bool inverted_ = false;
};

}  // namespace pcl_als::photogrammetry
