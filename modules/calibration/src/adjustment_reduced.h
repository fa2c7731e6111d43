// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>

#include "adjustment.h"
#include "area_normal.h"

namespace pcl_als {

/// Normal equations with all shared errors eliminated.
struct Adjustment::Reduced {
  SystemMatrix normal, prior_share;
  SystemVector right;
  Eigen::Matrix<double, Eigen::Dynamic, kSystemParameterCount> elimination;  ///< N_tt^-1 N_tg
  Eigen::VectorXd eliminated_right;                                          ///< N_tt^-1 h_t
  /// N_tt^-1, columns of the error sources, and of the blocks of the systems.
  Eigen::Matrix<double, Eigen::Dynamic, kErrorSourceCount> with_sources;
  Eigen::MatrixXd with_systems;
};

/// By area.
struct Adjustment::Areas {
  std::vector<AreaNormal> normals;
  std::vector<SystemMatrix> slope_noise;  ///< information that may stem from noise
};

}  // namespace pcl_als
