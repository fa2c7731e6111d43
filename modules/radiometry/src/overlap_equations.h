// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/adjustment/robust_iteration.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_cells.h>

namespace pcl_als::detail {

/// Which unknowns there are: terms, then gains of all strips but one of each connected group.
struct OverlapUnknowns {
  std::array<int, kRadiometricTermCount> term{-1, -1, -1};  ///< column; -1: fixed
  std::vector<int> gain;                                    ///< column by strip; -1: reference
  int count = 0;
};

/// Solution of the equations for a choice of unknowns.
struct OverlapSolution {
  Eigen::VectorXd unknowns;
  Eigen::MatrixXd covariance, formal;  ///< clustered; as if cells were independent
  double sigma0 = 0.0;
  std::size_t clusters = 0;
  RobustOutcome outcome;
};

/// The equations of shared cells: reflectances eliminated, Huber's weights.
class OverlapEquations {
 public:
  OverlapEquations(const std::vector<SharedCell>& cells, double cell_size,
                   const RadiometricModel& model, double cluster_size);

  OverlapSolution solve(const OverlapUnknowns& unknowns) const;
  std::size_t observations() const { return rows_.size(); }

 private:
  struct Row {
    std::size_t cell;
    int strip;
    double weight;
    double given;  ///< ln I, corrected by the given model
    std::array<double, kRadiometricTermCount> effect;
  };
  struct Reduced;
  Eigen::VectorXd remainders(const OverlapUnknowns& unknowns, const Eigen::VectorXd& x) const;
  void addCell(const OverlapUnknowns& unknowns, std::size_t cell, const Eigen::VectorXd& factors,
               const Eigen::VectorXd& values, Reduced& reduced) const;
  Reduced reduce(const OverlapUnknowns& unknowns, const Eigen::VectorXd& factors,
                 const Eigen::VectorXd& values) const;
  Eigen::VectorXd residuals(const Eigen::VectorXd& remainders, const Eigen::VectorXd& robust) const;
  void covariances(const OverlapUnknowns& unknowns, const RobustFit& fit,
                   OverlapSolution& solution) const;
  Eigen::VectorXd designOf(const OverlapUnknowns& unknowns, const Row& row) const;

  std::vector<Row> rows_;                ///< cell by cell
  std::vector<std::size_t> first_;       ///< row of each cell, and the end
  std::vector<std::uint32_t> cluster_;   ///< of each cell
  std::vector<std::size_t> by_cluster_;  ///< cells, cluster by cluster
  std::size_t clusters_ = 0;
};

}  // namespace pcl_als::detail
