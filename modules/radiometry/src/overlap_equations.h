// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/radiometry/overlap_adjustment.h>

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
  int iterations = 0;
  bool regular = false, converged = false;
};

/// The equations of shared cells: reflectances eliminated, Huber's weights.
class OverlapEquations {
 public:
  OverlapEquations(const std::vector<SharedCell>& cells, double cell_size,
                   const RadiometricModel& model, const OverlapSettings& settings);

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
  Reduced reduce(const OverlapUnknowns& unknowns, const std::vector<double>& robust) const;
  std::vector<double> residuals(const OverlapUnknowns& unknowns, const Eigen::VectorXd& x,
                                const std::vector<double>& robust) const;
  struct Weighing;
  void addCell(const OverlapUnknowns& unknowns, std::size_t cell, const Weighing& weighing,
               Eigen::VectorXd& score, Eigen::MatrixXd& sensitivity) const;
  void covariances(const OverlapUnknowns& unknowns, const Weighing& weighing,
                   OverlapSolution& solution) const;
  Eigen::VectorXd designOf(const OverlapUnknowns& unknowns, const Row& row) const;

  const OverlapSettings settings_;
  std::vector<Row> rows_;                ///< cell by cell
  std::vector<std::size_t> first_;       ///< row of each cell, and the end
  std::vector<std::uint32_t> cluster_;   ///< of each cell
  std::vector<std::size_t> by_cluster_;  ///< cells, cluster by cluster
  std::size_t clusters_ = 0;
};

}  // namespace pcl_als::detail
