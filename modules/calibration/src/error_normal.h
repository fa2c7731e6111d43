// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

#include "area_normal.h"
#include "block_cholesky.h"

namespace pcl_als {

/// Sum of normal equations over areas, with the shifts of areas eliminated: the eight parameters
/// (g) and the unknowns of the shared errors (t).
struct ErrorNormal {
  static constexpr int kKnot = SharedErrors::kPerKnot;
  static constexpr int kGlobal = kSystemParameterCount;

  SystemMatrix gg = SystemMatrix::Zero();
  SystemVector right_g = SystemVector::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, kGlobal> tg;
  Eigen::VectorXd right_t;
  KnotBlocks tt;  ///< lower triangle
  double log_determinant = 0.0, explained = 0.0;

  explicit ErrorNormal(int unknowns);

  void add(const AreaNormal::Reduced& area, const std::vector<int>& knots);
  /// The product of tt and a matrix with a row for each unknown.
  Eigen::MatrixXd times(const Eigen::MatrixXd& right) const;
};

}  // namespace pcl_als
