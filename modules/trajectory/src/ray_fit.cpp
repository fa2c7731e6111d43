// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "ray_fit.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/distributions.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/statistics.h>

#include "path_constants.h"

namespace pcl_als::detail {

double acrossOf(std::vector<double> residuals) {
  const double median = std::sqrt(chiSquaredCritical(0.5, 2.0));  // for a standard deviation of 1
  return std::max(medianInPlace(residuals) / median, kLeastAcross);
}

std::optional<RayFit> fitRays(std::vector<SensorRay>& rays, bool moving, double time) {
  RayFit fit;
  const int n = moving ? 6 : 3;
  fit.unknowns = Eigen::VectorXd::Zero(n);
  RobustSettings settings;
  settings.huber = 1.0;
  settings.scale = acrossOf;
  static_cast<RobustFit&>(fit) =
      fitRobustly(rays.size(), settings, [&](const auto& weights, auto& residuals) {
        Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
        Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          const Eigen::Matrix3d across = weights[i] / rays[i].leverage() * rays[i].across();
          const double factors[] = {1.0, rays[i].time - time};
          for (int a = 0; 3 * a < n; ++a) {
            right.segment<3>(3 * a) += factors[a] * (across * rays[i].lower);
            for (int b = 0; 3 * b < n; ++b)
              normal.block<3, 3>(3 * a, 3 * b) += factors[a] * factors[b] * across;
          }
        }
        const LdltFactor factor(normal);
        if (!factor.succeeded() || !(factor.reciprocalCondition() > kRegularLine))
          return std::optional<double>();
        fit.cofactor = factor.inverse();
        const Eigen::VectorXd change = fit.cofactor * right - fit.unknowns;
        fit.unknowns += change;
        for (std::size_t i = 0; i < rays.size(); ++i) {
          Eigen::Vector3d sensor = fit.unknowns.head<3>();
          if (moving) sensor += (rays[i].time - time) * fit.unknowns.tail<3>();
          residuals[i] = rays[i].compareWith(sensor);
        }
        return std::optional<double>(change.dot(normal * change));
      });
  if (!fit.solved() || !fit.unknowns.allFinite()) return std::nullopt;
  return fit;
}

}  // namespace pcl_als::detail
