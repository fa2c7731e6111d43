// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/parameter_covariance.h>

namespace pcl_als {

Eigen::MatrixXd estimatedCovariance(const CalibrationResult& calibration, const std::string& name) {
  const std::vector<SystemParameter>& order = calibration.correlation_order;
  if (order.empty()) throw InputError(name + ": no parameter was estimated, with correlations");
  Eigen::VectorXd std(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const ParameterEstimate& estimate = calibration[order[i]];
    const std::string parameter(infoOf(order[i]).name);
    if (estimate.status != ParameterStatus::estimated)
      throw InputError(name + ": 'correlation.order' names " + parameter +
                       ", which is not estimated");
    if (!(estimate.std > 0.0) || !std::isfinite(estimate.std))
      throw InputError(name + ": the standard deviation of " + parameter + " is not known");
    std[static_cast<Eigen::Index>(i)] = estimate.std;
  }
  const Eigen::MatrixXd& correlation = calibration.correlation;
  if (!correlation.allFinite() || !CholeskyFactor(correlation).succeeded())
    throw InputError(name + ": the correlation matrix is not positive definite");
  return std.asDiagonal() * correlation * std.asDiagonal();
}

}  // namespace pcl_als
